// The accelerator: the passes of step.hpp as kernels, a chunk of steps as one graph.

#include <cuda_runtime.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "gpu/device.hpp"
#include "gpu/step.hpp"

namespace nacre::gpu {
namespace {

constexpr int kElementThreads = 256;

void check(cudaError_t status, const char* what) {
  if (status != cudaSuccess) throw DeviceLost(std::string(what) + ": " + cudaGetErrorString(status));
}

/// Memory of the device, or of the host within the device's reach.
template <class T, bool OnHost = false>
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t count) : count_(count) {
    const std::size_t bytes = count * sizeof(T);
    check(OnHost ? cudaMallocHost(&data_, bytes) : cudaMalloc(&data_, bytes), "memory");
  }
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(count_, other.count_);
    return *this;
  }
  ~Buffer() { OnHost ? cudaFreeHost(data_) : cudaFree(data_); }
  T* get() const { return static_cast<T*>(data_); }
  std::size_t size() const { return count_; }

 private:
  void* data_ = nullptr;
  std::size_t count_ = 0;
};

/// The place of this block of threads, its strain set for the step; by all threads of the block.
__device__ void take_place(const Specimen* places, std::int64_t now, Specimen& mine) {
  const auto* from = reinterpret_cast<const std::int32_t*>(places + blockIdx.y);
  auto* to = reinterpret_cast<std::int32_t*>(&mine);
  for (int i = threadIdx.x; i < static_cast<int>(sizeof(Specimen) / 4); i += blockDim.x) to[i] = from[i];
  __syncthreads();
  if (threadIdx.x == 0) mine.state.strain = strain_at(mine, now - mine.begun_at);
  __syncthreads();
}

__global__ void __launch_bounds__(kElementThreads)
    element_pass(const Specimen* places, const std::int64_t* now, int in_chunk, std::int32_t* inverted) {
  __shared__ Specimen mine;
  if (!places[blockIdx.y].occupied) return;
  const std::int64_t step = *now + in_chunk;
  take_place(places, step, mine);
  const int element = blockIdx.x * kElementThreads + threadIdx.x;
  if (element >= mine.state.columns * mine.state.rows) return;
  step_element(mine, step - mine.begun_at, element / mine.state.columns, element % mine.state.columns,
               inverted[blockIdx.y]);
}

__global__ void __launch_bounds__(kTileThreads)
    node_pass(const Specimen* places, const std::int64_t* now, int in_chunk, Reactions* reactions) {
  __shared__ Specimen mine;
  __shared__ Tile tile;
  if (!places[blockIdx.y].occupied) return;
  const std::int64_t at = *now + in_chunk;
  take_place(places, at, mine);
  const int index = blockIdx.x, thread = threadIdx.x;
  if (index >= tiles_of(mine)) return;
  const std::int64_t step = at - mine.begun_at;
  gather_velocities(mine, step, index, thread, tile);
  if (index == 0 && thread < kShares) share_reactions(mine, thread, tile);
  __syncthreads();
  damp_and_move(mine, step, index, thread, tile);
  if (index == 0 && thread == 0) reactions[blockIdx.y].bottom[in_chunk] = reaction(tile, 0);
  if (index == 0 && thread == 1) reactions[blockIdx.y].top[in_chunk] = reaction(tile, 1);
}

__global__ void end_chunk(std::int64_t* now) { *now += kChunkSteps; }

class CudaDevice : public Device {
 public:
  explicit CudaDevice(int places)
      : count_(places),
        specimens_(static_cast<std::size_t>(places)),
        reactions_(static_cast<std::size_t>(places)),
        inverted_(static_cast<std::size_t>(places)),
        now_(1),
        seen_reactions_(static_cast<std::size_t>(places)),
        seen_inverted_(static_cast<std::size_t>(places)),
        places_(static_cast<std::size_t>(places)) {
    check(cudaStreamCreate(&stream_), "stream");
    check(cudaMemset(specimens_.get(), 0, specimens_.size() * sizeof(Specimen)), "memory");
    check(cudaMemset(now_.get(), 0, sizeof(std::int64_t)), "memory");
    check(cudaGetDeviceProperties(&properties_, 0), "device");
  }
  ~CudaDevice() override {
    if (graph_) cudaGraphExecDestroy(graph_);
    cudaStreamDestroy(stream_);
  }

  std::string name() const override { return properties_.name; }
  std::size_t free_bytes() const override {
    std::size_t free = 0, total = 0;
    check(cudaMemGetInfo(&free, &total), "memory");
    return free;
  }

  void load(int place, const SpecimenImage& image) override {
    Place& p = places_[place];
    const std::size_t numbers = image.device_numbers() + image.elements;
    if (p.memory.size() < numbers) {
      check(cudaStreamSynchronize(stream_), "steps");
      p.memory = Buffer<float>(numbers);
    }
    p.specimen = image.bind(p.memory.get());
    p.specimen.failed_at = reinterpret_cast<std::int32_t*>(p.memory.get() + image.device_numbers());
    p.specimen.begun_at = steps_;
    p.specimen.occupied = true;
    p.elements = image.elements;
    const std::size_t block = image.block.size();
    check(cudaMemcpyAsync(p.memory.get(), image.block.data(), block * sizeof(float), cudaMemcpyHostToDevice, stream_),
          "specimen");
    check(cudaMemsetAsync(p.memory.get() + block, 0, (image.device_numbers() - block) * sizeof(float), stream_),
          "specimen");
    check(cudaMemsetAsync(p.specimen.failed_at, 0xff, image.elements * sizeof(std::int32_t), stream_), "specimen");
    check(cudaMemsetAsync(inverted_.get() + place, 0xff, sizeof(std::int32_t), stream_), "specimen");
    write_place(place);
    const fem::ExtendedState<float>& s = p.specimen.state;
    demand_blocks((s.columns * s.rows + kElementThreads - 1) / kElementThreads, tiles_of(p.specimen));
  }
  void unload(int place) override {
    places_[place].specimen.occupied = false;
    write_place(place);
  }

  void advance() override {
    // No more rows of blocks than places in use, in steps of two, so that few graphs are made.
    const auto last =
        std::find_if(places_.rbegin(), places_.rend(), [](const Place& p) { return p.specimen.occupied; });
    demand_places(static_cast<int>(std::bit_ceil(static_cast<unsigned>(places_.rend() - last))));
    if (!graph_) capture();
    check(cudaGraphLaunch(graph_, stream_), "steps");
    steps_ += kChunkSteps;
    check(cudaMemcpyAsync(seen_reactions_.get(), reactions_.get(), reactions_.size() * sizeof(Reactions),
                          cudaMemcpyDeviceToHost, stream_),
          "reactions");
    check(cudaMemcpyAsync(seen_inverted_.get(), inverted_.get(), inverted_.size() * sizeof(std::int32_t),
                          cudaMemcpyDeviceToHost, stream_),
          "reactions");
  }
  std::vector<PlaceReport> reports() override {
    check(cudaStreamSynchronize(stream_), "steps");
    std::vector<PlaceReport> reports;
    for (int i = 0; i < count_; ++i) reports.push_back({seen_reactions_.get()[i], seen_inverted_.get()[i]});
    return reports;
  }
  std::vector<std::int32_t> failed_at(int place) override {
    const Place& p = places_[place];
    std::vector<std::int32_t> padded(p.elements);
    check(cudaMemcpyAsync(padded.data(), p.specimen.failed_at, padded.size() * sizeof(std::int32_t),
                          cudaMemcpyDeviceToHost, stream_),
          "specimen");
    check(cudaStreamSynchronize(stream_), "specimen");
    return by_element(p.specimen.state, padded);
  }

 private:
  struct Place {
    Buffer<float> memory;
    Specimen specimen;
    std::size_t elements = 0;
  };

  void write_place(int place) {
    check(cudaMemcpyAsync(specimens_.get() + place, &places_[place].specimen, sizeof(Specimen), cudaMemcpyHostToDevice,
                          stream_),
          "specimen");
  }
  /// A graph is made for specimens of a size; a larger one needs another.
  void demand_blocks(int elements, int tiles) {
    if (elements <= element_blocks_ && tiles <= tiles_) return;
    element_blocks_ = std::max(element_blocks_, elements);
    tiles_ = std::max(tiles_, tiles);
    drop_graph();
  }
  void demand_places(int places) {
    places = std::min(places, count_);
    if (std::exchange(place_blocks_, places) != places) drop_graph();
  }
  void drop_graph() {
    if (graph_) check(cudaGraphExecDestroy(std::exchange(graph_, nullptr)), "graph");
  }
  void capture() {
    const unsigned places = static_cast<unsigned>(place_blocks_);
    check(cudaStreamBeginCapture(stream_, cudaStreamCaptureModeThreadLocal), "graph");
    for (int k = 0; k < kChunkSteps; ++k) {
      element_pass<<<dim3(static_cast<unsigned>(element_blocks_), places), kElementThreads, 0, stream_>>>(
          specimens_.get(), now_.get(), k, inverted_.get());
      node_pass<<<dim3(static_cast<unsigned>(tiles_), places), kTileThreads, 0, stream_>>>(specimens_.get(), now_.get(),
                                                                                           k, reactions_.get());
    }
    end_chunk<<<1, 1, 0, stream_>>>(now_.get());
    cudaGraph_t graph = nullptr;
    check(cudaStreamEndCapture(stream_, &graph), "graph");
    const cudaError_t made = cudaGraphInstantiate(&graph_, graph, 0);
    cudaGraphDestroy(graph);
    check(made, "graph");
  }

  int count_ = 0;
  int element_blocks_ = 0, tiles_ = 0, place_blocks_ = 0;  ///< that the graph is made for
  Buffer<Specimen> specimens_;
  Buffer<Reactions> reactions_;
  Buffer<std::int32_t> inverted_;
  Buffer<std::int64_t> now_;
  Buffer<Reactions, true> seen_reactions_;
  Buffer<std::int32_t, true> seen_inverted_;
  std::vector<Place> places_;
  cudaDeviceProp properties_{};
  cudaStream_t stream_ = nullptr;
  cudaGraphExec_t graph_ = nullptr;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Device> make_cuda_device(int places) {
  int count = 0;
  check(cudaGetDeviceCount(&count), "devices");
  if (count == 0) throw DeviceLost("none was found");
  return std::make_unique<CudaDevice>(places);
}

}  // namespace nacre::gpu
