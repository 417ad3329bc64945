// Part of Network (network.hpp): the networks by libtorch; the only file that includes it.

#include <malloc.h>
#include <torch/torch.h>

#include <algorithm>
#include <mutex>

#include "surrogate/network.hpp"

namespace nacre::surrogate {
namespace {

constexpr std::int64_t kSide = pattern::kQuarter;

/// Convolution 3 x 3 that keeps the size. Zeros beyond the edge: they tell the network where in the pattern it looks.
torch::nn::Conv2d convolution(int from, int to) {
  return torch::nn::Conv2d(torch::nn::Conv2dOptions(from, to, 3).padding(1).bias(false));
}

/// Two convolutions around which the input is led.
struct ResidualBlockImpl : torch::nn::Module {
  explicit ResidualBlockImpl(int channels)
      : first(register_module("first", convolution(channels, channels))),
        second(register_module("second", convolution(channels, channels))),
        first_norm(register_module("first_norm", torch::nn::BatchNorm2d(channels))),
        second_norm(register_module("second_norm", torch::nn::BatchNorm2d(channels))) {}
  torch::Tensor forward(const torch::Tensor& x) {
    return torch::relu(x + second_norm(second(torch::relu(first_norm(first(x))))));
  }
  torch::nn::Conv2d first, second;
  torch::nn::BatchNorm2d first_norm, second_norm;
};
TORCH_MODULE(ResidualBlock);

/// Figure 2-10B: stem, residual blocks, global average, dropout, fully connected.
struct ResidualNetImpl : torch::nn::Module {
  explicit ResidualNetImpl(const NetworkSettings& settings)
      : stem(register_module("stem", convolution(1, settings.channels))),
        stem_norm(register_module("stem_norm", torch::nn::BatchNorm2d(settings.channels))),
        dropout(register_module("dropout", torch::nn::Dropout(settings.dropout))),
        last(register_module("last", torch::nn::Linear(settings.channels, 1))) {
    for (int b = 0; b < settings.residual_blocks; ++b) blocks->push_back(ResidualBlock(settings.channels));
    register_module("blocks", blocks);
  }
  torch::Tensor forward(const torch::Tensor& quarters) {
    const torch::Tensor features = blocks->forward(torch::relu(stem_norm(stem(quarters))));
    return last(dropout(features.mean({2, 3}))).squeeze(1);
  }
  torch::nn::Conv2d stem;
  torch::nn::BatchNorm2d stem_norm;
  torch::nn::Sequential blocks;
  torch::nn::Dropout dropout;
  torch::nn::Linear last;
};
TORCH_MODULE(ResidualNet);

/// libtorch draws from one generator of the process: whoever draws holds this.
std::mutex& generator_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Once per process. Activations of some megabytes are otherwise mapped and faulted in anew by every operation, which
/// makes everything several times slower; and results are the same bits only on one thread.
void prepare_process() {
  static const bool done = [] {
    constexpr int kMegabyte = 1 << 20;
    ::mallopt(M_MMAP_THRESHOLD, 1024 * kMegabyte);
    ::mallopt(M_TRIM_THRESHOLD, 512 * kMegabyte);
    ::mallopt(M_TOP_PAD, 64 * kMegabyte);
    at::set_num_threads(1);
    return true;
  }();
  (void)done;
}

class TorchNetwork final : public Network {
 public:
  explicit TorchNetwork(const NetworkSettings& settings)
      : settings_(settings), device_(torch::cuda::is_available() ? torch::kCUDA : torch::kCPU) {
    prepare_process();
    const std::lock_guard lock(generator_mutex());
    torch::manual_seed(settings.seed);
    net_ = ResidualNet(settings);
    net_->to(device_);
  }

  void train(const std::vector<float>& quarters, const std::vector<float>& targets, int epochs) override {
    const std::lock_guard lock(generator_mutex());
    torch::manual_seed(settings_.seed + 7919 * static_cast<std::uint64_t>(++trainings_));
    const torch::Tensor inputs = tensor_of(quarters);
    const torch::Tensor wanted = torch::tensor(targets).to(device_);
    torch::optim::Adam optimizer(
        net_->parameters(), torch::optim::AdamOptions(settings_.learning_rate).weight_decay(settings_.weight_decay));
    net_->train();
    for (int epoch = 0; epoch < epochs; ++epoch) {
      const torch::Tensor order = torch::randperm(inputs.size(0)).to(device_);
      for (const torch::Tensor& part : order.split(settings_.batch)) {
        if (part.size(0) < 2) continue;  // batch normalisation needs two
        optimizer.zero_grad();
        torch::mse_loss(net_(inputs.index_select(0, part)), wanted.index_select(0, part)).backward();
        optimizer.step();
      }
    }
  }

  std::vector<float> evaluate(const std::vector<float>& quarters) override {
    const torch::NoGradGuard no_gradients;
    net_->eval();
    const torch::Tensor inputs = tensor_of(quarters);
    std::vector<float> values;
    constexpr std::int64_t kAtOnce = 1024;
    for (std::int64_t begin = 0; begin < inputs.size(0); begin += kAtOnce) {
      const torch::Tensor some = inputs.slice(0, begin, std::min(begin + kAtOnce, inputs.size(0)));
      const torch::Tensor result = net_(some).to(torch::kCPU).contiguous();
      values.insert(values.end(), result.data_ptr<float>(), result.data_ptr<float>() + result.numel());
    }
    return values;
  }

  std::unique_ptr<Network> clone() const override {
    auto copy = std::make_unique<TorchNetwork>(settings_);
    copy->trainings_ = trainings_;
    const torch::NoGradGuard no_gradients;
    copy_tensors(net_->named_parameters(), copy->net_->named_parameters());
    copy_tensors(net_->named_buffers(), copy->net_->named_buffers());
    return copy;
  }

 private:
  using Tensors = torch::OrderedDict<std::string, torch::Tensor>;
  static void copy_tensors(const Tensors& from, Tensors to) {
    for (const auto& item : from) to[item.key()].copy_(item.value());
  }

  torch::Tensor tensor_of(const std::vector<float>& quarters) const {
    const auto count = static_cast<std::int64_t>(quarters.size()) / (kSide * kSide);
    return torch::tensor(quarters).reshape({count, 1, kSide, kSide}).to(device_) * 2.0 - 1.0;
  }

  NetworkSettings settings_;
  torch::Device device_;
  ResidualNet net_{nullptr};
  int trainings_ = 0;
};

}  // namespace
}  // namespace nacre::surrogate

extern "C" nacre::surrogate::Network* nacre_make_network(const nacre::surrogate::NetworkSettings& settings) {
  return new nacre::surrogate::TorchNetwork(settings);
}
