#include "simulator_farm/gpu_executor.hpp"

#include <fmt/format.h>

#include <utility>

#include "simulator_farm/simulate_work.hpp"
#include "store/kept_simulation.hpp"

namespace nacre::simulator_farm {
namespace {

/// Specimens that wait mounted, so that a place does not stay empty.
constexpr std::size_t kMostReady = 64;

}  // namespace

GpuExecutor::GpuExecutor(std::shared_ptr<store::SimulationCache> cache, GpuSettings settings,
                         std::function<void()> wake)
    : cache_(std::move(cache)),
      settings_(std::move(settings)),
      threads_of_processor_(work_functions(cache_, settings_.films), settings_.threads, wake),
      outbox_(std::move(wake)),
      preparer_([this](const std::stop_token& stopping) { prepare(stopping); }),
      puller_([this](const std::stop_token& stopping) { pull(stopping); }) {}

void GpuExecutor::start(runtime::Compute compute) {
  outbox_.expect_one();
  {
    const std::lock_guard lock(mutex_);
    new_.push_back(std::move(compute));
  }
  changed_.notify_all();
}

std::vector<runtime::FinishedWork> GpuExecutor::finished() {
  std::deque<runtime::Compute> for_threads;
  {
    const std::lock_guard lock(mutex_);
    for_threads = std::exchange(for_threads_, {});
  }
  outbox_.pass_on(for_threads.size());
  for (runtime::Compute& compute : for_threads) threads_of_processor_.start(std::move(compute));
  std::vector<runtime::FinishedWork> all = outbox_.finished();
  for (runtime::FinishedWork& work : threads_of_processor_.finished()) all.push_back(std::move(work));
  return all;
}

void GpuExecutor::give_to_threads(runtime::Compute compute) {
  {
    const std::lock_guard lock(mutex_);
    for_threads_.push_back(std::move(compute));
  }
  outbox_.wake();
}

/// Sorts test requests, and mounts specimens for the device a little ahead of it.
void GpuExecutor::prepare(const std::stop_token& stopping) {
  while (true) {
    runtime::Compute compute;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stopping, [&] { return !new_.empty() && (ready_.size() < kMostReady || !has_device_); });
      if (stopping.stop_requested()) return;
      compute = std::move(new_.front());
      new_.pop_front();
      if (!has_device_) {
        lock.unlock();
        give_to_threads(std::move(compute));
        continue;
      }
    }
    try {
      sort(compute);
    } catch (const std::exception& problem) {
      outbox_.finish(std::move(compute), fail("{}", problem.what()));
    }
  }
}

void GpuExecutor::sort(const runtime::Compute& compute) {
  const AskedSimulation asked = asked_in(compute.spec);
  // The film of a specimen whose numbers are known is made by threads. So is a pure soft specimen, which may have to be
  // pulled again with a shorter step.
  const bool pure_soft = asked.simulation.design.rigid_fraction() == 0.0;
  if (asked.test != tester::TestKind::toughness || pure_soft || has_numbers(*cache_, asked))
    return give_to_threads(compute);
  Result<gpu::PreparedTest> test = gpu::PreparedTest::of(tester::fracture_test(asked.simulation));
  // What cannot be pulled is refused in the words of the tester.
  if (!test) return give_to_threads(compute);
  {
    std::unique_lock lock(mutex_);
    if (!has_device_) {  // lost meanwhile
      lock.unlock();
      return give_to_threads(compute);
    }
    ready_.push_back({compute, *std::move(test)});
  }
  changed_.notify_all();
}

/// The device's own thread. Whatever goes wrong on it, threads of the processor go on.
void GpuExecutor::pull(const std::stop_token& stopping) {
  try {
    Result<std::unique_ptr<gpu::Device>> device = settings_.make_device(settings_.most_places);
    if (!device) return give_up_device(device.error().message);
    keep_device_busy(*std::move(device), stopping);
  } catch (const std::exception& problem) {
    give_up_device(problem.what());
  }
}

void GpuExecutor::keep_device_busy(std::unique_ptr<gpu::Device> device, const std::stop_token& stopping) {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stopping, [&] { return !ready_.empty() || !on_device_.empty(); });
      if (stopping.stop_requested()) return;
    }
    for (gpu::NumberedTest& next : take_ready()) {
      if (!batch_) open_batch(std::move(device), next.test.image());  // without the lock: it takes the device seconds
      batch_->add(std::move(next));
    }
    outbox_.set_standing(fmt::format("{} on the device", batch_->pending()));
    changed_.notify_all();  // there is room for more that is ready
    for (const gpu::NumberedResult& over : batch_->turn()) keep(over);
  }
}

/// The test requests are kept with those on the device before anything can fail: give_up_device() looks there.
std::vector<gpu::NumberedTest> GpuExecutor::take_ready() {
  std::vector<gpu::NumberedTest> tests;
  const std::lock_guard lock(mutex_);
  for (; !ready_.empty(); ready_.pop_front()) {
    on_device_.emplace(next_number_, std::move(ready_.front().compute));
    tests.push_back({next_number_++, std::move(ready_.front().test)});
  }
  return tests;
}

void GpuExecutor::open_batch(std::unique_ptr<gpu::Device> device, const gpu::SpecimenImage& typical) {
  const int places = gpu::places_for(*device, typical, settings_.most_places);
  batch_ = std::make_unique<gpu::BatchTester>(std::move(device), places);
  outbox_.say(runtime::LogLevel::info,
              fmt::format("fracture tests run on {}, up to {} side by side", batch_->device().name(), places));
}

void GpuExecutor::keep(const gpu::NumberedResult& over) {
  runtime::Compute compute = std::move(on_device_.extract(over.number).mapped());
  try {
    const AskedSimulation asked = asked_in(compute.spec);
    // The crack too, requested or not: threads that simulate it later would get another fracture.
    keep_response(*cache_, asked.key, store::kept(over.result), over.result ? &over.result->breaks : nullptr);
    // What is left to threads is the film; or the crack, where the numbers are theirs.
    if (!is_known(*cache_, settings_.films, asked)) return give_to_threads(std::move(compute));
    // The response is made of what is kept, as for threads; nothing is left to simulate.
    std::string response = simulate_work(*cache_, settings_.films, compute.spec);
    outbox_.finish(std::move(compute), std::move(response));
  } catch (const std::exception& problem) {
    outbox_.finish(std::move(compute), fail("{}", problem.what()));
  }
}

void GpuExecutor::give_up_device(const std::string& reason) {
  outbox_.say(runtime::LogLevel::warning,
              fmt::format("the device cannot be used, threads of the processor go on: {}", reason));
  {
    const std::lock_guard lock(mutex_);
    has_device_ = false;
    for (auto& [number, compute] : on_device_) for_threads_.push_back(std::move(compute));
    for (Ready& each : ready_) for_threads_.push_back(std::move(each.compute));
    ready_.clear();
  }
  outbox_.set_standing("without the device");
  on_device_.clear();
  batch_.reset();
  changed_.notify_all();
  outbox_.wake();
}

}  // namespace nacre::simulator_farm
