#include "simulator_farm/batch_task.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "base/files.hpp"
#include "simulator_farm/batch_file.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "simulator_farm/spool.hpp"

namespace nacre::simulator_farm {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// HOST-PID.
std::string own_name() {
  char host[65] = "unknown";
  ::gethostname(host, sizeof host - 1);
  return fmt::format("{}-{}", host, ::getpid());
}

/// Writes into the batch's sign file every few seconds until it dies: how many tests are done, and a count.
class SignOfLife {
 public:
  explicit SignOfLife(fs::path file) : file_(std::move(file)), thread_([this] { run(); }) {}
  ~SignOfLife() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  void report_done(int count) { done_ = count; }

 private:
  void run() {
    constexpr auto kPeriod = std::chrono::seconds(5);
    std::unique_lock lock(mutex_);
    for (int beat = 0; !ending_; ++beat) {
      std::ofstream(file_) << own_name() << ' ' << done_ << ' ' << beat << '\n';
      changed_.wait_for(lock, kPeriod);
    }
  }

  fs::path file_;
  std::atomic<int> done_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ending_ = false;
  std::thread thread_;
};

BatchRecord simulated(store::SimulationCache& cache, const fs::path& films, const std::string& spec) {
  const auto began = Clock::now();
  simulate_work(cache, films, spec);
  const std::string key = asked_in(spec).key;
  return {.key = key,
          .response = cache.find(key).value(),
          .breaks = cache.find_breaks(key),
          .seconds = std::chrono::duration<double>(Clock::now() - began).count()};
}

/// The batch's bytes; nothing when it is over or done, by another task that was given it too.
std::optional<std::string> still_wanted(const Spool& spool, const std::string& batch) {
  if (fs::exists(spool.result(batch)) || !fs::exists(spool.batch_file(batch))) return std::nullopt;
  return read_file(spool.batch_file(batch));
}

}  // namespace

int run_batch_task(const fs::path& folder, const std::string& wave, int task) {
  const Spool spool(folder);
  const auto batch = spool.batch_of(wave, task);
  const auto bytes = batch ? still_wanted(spool, *batch) : std::nullopt;
  if (!bytes) {
    fmt::print("task {} of {}: nothing is left to do\n", task, wave);
    return 0;
  }
  const auto tests = read_batch(*bytes);
  if (!tests) {
    fmt::print(stderr, "{}: {}\n", spool.batch_file(*batch).string(), tests.error().message);
    return 1;
  }
  SignOfLife sign(spool.sign(*batch));
  store::SimulationCache cache(":memory:");
  std::vector<BatchRecord> records;
  for (const std::string& spec : tests->specs) {
    records.push_back(simulated(cache, tests->films, spec));
    sign.report_done(records.size());
  }
  if (!still_wanted(spool, *batch)) return 0;
  write_file_atomically(spool.result(*batch), write_batch_result(*batch, records));
  fmt::print("task {} of {}: {} tests done\n", task, wave, records.size());
  return 0;
}

}  // namespace nacre::simulator_farm
