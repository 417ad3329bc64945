#include "surrogate/network.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <mutex>
#include <string>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"

namespace nacre::surrogate {
namespace {

using MakeNetwork = Network* (*)(const NetworkSettings&);

#ifdef NACRE_NETWORK_LIBRARY
/// The maker in the library beside this build; loaded once and kept.
MakeNetwork maker() {
  static const MakeNetwork found = [] {
    void* library = ::dlopen(NACRE_NETWORK_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (!library) throw InputError::format("the networks cannot be loaded: {}", ::dlerror());
    return reinterpret_cast<MakeNetwork>(::dlsym(library, "nacre_make_network"));
  }();
  return found;
}
#else
MakeNetwork maker() {
  throw InputError("this build has no networks: install libtorch-dev and build again, or use the predictor patches");
}
#endif

std::vector<float> quarters_of(std::span<const pattern::Pattern> patterns) {
  std::vector<float> quarters;
  quarters.reserve(patterns.size() * pattern::kQuarterPixels);
  for (const pattern::Pattern& pattern : patterns) {
    for (int r = 0; r < pattern::kQuarter; ++r)
      for (int c = 0; c < pattern::kQuarter; ++c) quarters.push_back(pattern.rigid(r, c) ? 1.0f : 0.0f);
  }
  return quarters;
}

/// Mean and deviation by which targets are standardised.
struct TargetScale {
  double mean = 0.0, deviation = 1.0;
};

TargetScale scale_of(std::span<const double> values) {
  const double spread = standard_deviation(values);
  return {mean(values), spread > 0.0 ? spread : 1.0};
}

std::vector<float> standardised(std::span<const double> values, const TargetScale& scale) {
  std::vector<float> targets;
  for (const double value : values) targets.push_back(static_cast<float>((value - scale.mean) / scale.deviation));
  return targets;
}

class Ensemble final : public Predictor {
 public:
  Ensemble(std::vector<std::unique_ptr<Network>> members, const TargetScale& scale)
      : members_(std::move(members)), scale_(scale) {}

  std::vector<double> means(std::span<const pattern::Pattern> at) const override {
    std::vector<double> result;
    for (const PatternPrediction& prediction : predict(at)) result.push_back(prediction.mean);
    return result;
  }

  std::vector<PatternPrediction> predict(std::span<const pattern::Pattern> at) const override {
    const Eigen::MatrixXd values = member_predictions(at);
    const Eigen::RowVectorXd means = values.colwise().mean();
    const Eigen::RowVectorXd deviations = apart(values).colwise().norm();
    std::vector<PatternPrediction> result;
    for (Eigen::Index i = 0; i < values.cols(); ++i) result.push_back({means[i], deviations[i]});
    return result;
  }

  Eigen::MatrixXd covariance(std::span<const pattern::Pattern> at) const override {
    const Eigen::MatrixXd differences = apart(member_predictions(at));
    return differences.transpose() * differences;
  }

 private:
  /// Prediction of each pattern (column) by each member (row).
  Eigen::MatrixXd member_predictions(std::span<const pattern::Pattern> at) const {
    const std::vector<float> quarters = quarters_of(at);
    Eigen::MatrixXd values(static_cast<Eigen::Index>(members_.size()), static_cast<Eigen::Index>(at.size()));
    const std::lock_guard lock(mutex_);
    for (std::size_t m = 0; m < members_.size(); ++m) {
      const std::vector<float> predicted = members_[m]->evaluate(quarters);
      for (std::size_t i = 0; i < at.size(); ++i)
        values(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(i)) =
            scale_.mean + scale_.deviation * predicted[i];
    }
    return values;
  }

  /// Disagreement: differences from the mean over sqrt(members - 1); none where there is one member.
  static Eigen::MatrixXd apart(const Eigen::MatrixXd& values) {
    return (values.rowwise() - values.colwise().mean()) /
           std::sqrt(std::max<double>(1.0, static_cast<double>(values.rows() - 1)));
  }

  std::vector<std::unique_ptr<Network>> members_;
  TargetScale scale_;
  mutable std::mutex mutex_;
};

/// Networks trained in full lately, by content of samples and settings.
class NetworkMemory {
 public:
  std::unique_ptr<Network> trained(const NetworkSettings& settings, const std::vector<float>& quarters,
                                   const std::vector<float>& targets) {
    const std::string key = key_of(settings, quarters, targets);
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(key); found != known_.end()) return found->second->clone();
    auto network = make_network(settings);
    network->train(quarters, targets, settings.epochs);
    constexpr std::size_t kMost = 32;
    if (known_.size() >= kMost) known_.clear();
    return (known_[key] = std::move(network))->clone();
  }

 private:
  static std::string key_of(const NetworkSettings& settings, const std::vector<float>& quarters,
                            const std::vector<float>& targets) {
    std::string bytes =
        fmt::format("{} {} {} {} {} {} {} {} ", settings.channels, settings.residual_blocks, settings.dropout,
                    settings.weight_decay, settings.learning_rate, settings.epochs, settings.batch, settings.seed);
    for (const std::vector<float>* part : {&quarters, &targets})
      bytes.append(reinterpret_cast<const char*>(part->data()), part->size() * sizeof(float));
    return content_hash(bytes);
  }
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<Network>> known_;
};

}  // namespace

bool networks_available() {
#ifdef NACRE_NETWORK_LIBRARY
  return true;
#else
  return false;
#endif
}

std::unique_ptr<Network> make_network(const NetworkSettings& settings) {
  return std::unique_ptr<Network>(maker()(settings));
}

std::unique_ptr<Predictor> fit_ensemble(const Samples& samples, std::size_t settled, const EnsembleSettings& settings) {
  assert(samples.patterns.size() == samples.values.size() && !samples.values.empty());
  static NetworkMemory memory;
  const std::size_t first =
      settings.warm_start ? std::clamp(settled, std::size_t{1}, samples.values.size()) : samples.values.size();
  // One scale for both trainings, or the second would have to undo the first.
  const TargetScale scale = scale_of(samples.values.first(first));
  const std::vector<float> quarters = quarters_of(samples.patterns), targets = standardised(samples.values, scale);
  const std::vector<float> first_quarters(
      quarters.begin(), quarters.begin() + static_cast<std::ptrdiff_t>(first * pattern::kQuarterPixels));
  const std::vector<float> first_targets(targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(first));
  std::vector<std::unique_ptr<Network>> members;
  for (int m = 0; m < settings.members; ++m) {
    NetworkSettings network = settings.network;
    network.seed += static_cast<std::uint64_t>(m) * 1000003;
    members.push_back(memory.trained(network, first_quarters, first_targets));
    if (first < samples.values.size())
      members.back()->train(quarters, targets, static_cast<int>(std::ceil(settings.warm_epochs * network.epochs)));
  }
  return std::make_unique<Ensemble>(std::move(members), scale);
}

}  // namespace nacre::surrogate
