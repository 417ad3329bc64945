#pragma once
// The farm's executor with an accelerator: fracture tests go to the device by the batch, all else to threads, also the
// films of what the device broke. When the device fails, threads do everything.

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "gpu/batch_tester.hpp"
#include "runtime/work_outbox.hpp"
#include "runtime/work_pool.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::simulator_farm {

/// Makes the device with so many places. Error: why there is none.
using MakeDevice = std::function<Result<std::unique_ptr<gpu::Device>>(int places)>;

struct GpuSettings {
  std::filesystem::path films;  ///< RUN/films
  int threads = 0;              ///< beside the device; 0: all allowed cores
  int most_places = 512;        ///< specimens side by side, if the device's memory bears them
  MakeDevice make_device;
};

/// Executor of the kind "simulate".
class GpuExecutor : public runtime::Executor {
 public:
  GpuExecutor(std::shared_ptr<store::SimulationCache> cache, GpuSettings settings, std::function<void()> wake);
  /// What is not over is left: it has no effects.
  ~GpuExecutor() override = default;
  bool knows(const std::string& kind) const override { return kind == "simulate"; }
  void start(runtime::Compute compute) override;
  std::vector<runtime::FinishedWork> finished() override;
  int pending() const override { return outbox_.pending() + threads_of_processor_.pending(); }
  std::vector<runtime::LogLine> take_log() override { return outbox_.take_log(); }
  std::string standing() const override { return outbox_.standing(); }

 private:
  struct Ready {
    runtime::Compute compute;
    gpu::PreparedTest test;
  };

  void prepare(const std::stop_token& stopping);
  void sort(const runtime::Compute& compute);
  void pull(const std::stop_token& stopping);
  void keep_device_busy(std::unique_ptr<gpu::Device> device, const std::stop_token& stopping);
  std::vector<gpu::NumberedTest> take_ready();
  void open_batch(std::unique_ptr<gpu::Device> device, const gpu::SpecimenImage& typical);
  void keep(const gpu::NumberedResult& over);
  void give_up_device(const std::string& reason);
  void give_to_threads(runtime::Compute compute);

  std::shared_ptr<store::SimulationCache> cache_;
  GpuSettings settings_;
  runtime::WorkPool threads_of_processor_;  ///< of the shell's thread alone
  runtime::WorkOutbox outbox_;              ///< of what is in this executor's own hands

  // Shared by the shell's thread, the preparer and the puller.
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<runtime::Compute> new_;
  std::deque<Ready> ready_;
  std::deque<runtime::Compute> for_threads_;  ///< until the shell's thread hands them over
  bool has_device_ = true;

  // Of the puller.
  std::unique_ptr<gpu::BatchTester> batch_;
  std::map<int, runtime::Compute> on_device_;
  int next_number_ = 0;

  std::jthread preparer_, puller_;  // the last members: they end before what they use
};

}  // namespace nacre::simulator_farm
