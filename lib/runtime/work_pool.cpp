#include "runtime/work_pool.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "base/parallel.hpp"

namespace nacre::runtime {

/// Shared with the threads, which may outlive the pool.
struct WorkPool::State {
  std::map<std::string, WorkFunction> functions;
  std::function<void()> wake;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Compute> queue;
  std::vector<FinishedWork> finished;
  int pending = 0;
  bool stopping = false;

  Result<std::string> run(const Compute& compute) const {
    try {
      return functions.at(compute.kind)(compute.spec);
    } catch (const std::exception& problem) {
      return fail("{}", problem.what());
    } catch (...) {
      return fail("an exception of an unknown kind");
    }
  }

  void work() {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [this] { return stopping || !queue.empty(); });
      if (stopping) return;
      Compute compute = std::move(queue.front());
      queue.pop_front();
      lock.unlock();
      Result<std::string> result = run(compute);
      lock.lock();
      if (stopping) return;
      finished.push_back({std::move(compute), std::move(result)});
      wake();
    }
  }
};

WorkPool::WorkPool(std::map<std::string, WorkFunction> functions, int threads, std::function<void()> wake)
    : state_(std::make_shared<State>()) {
  state_->functions = std::move(functions);
  state_->wake = std::move(wake);
  if (state_->functions.empty()) return;
  for (int i = 0; i < (threads > 0 ? threads : allowed_cores()); ++i) {
    std::thread([state = state_] { state->work(); }).detach();
  }
}

WorkPool::~WorkPool() {
  const std::lock_guard lock(state_->mutex);
  state_->stopping = true;
  state_->changed.notify_all();
}

bool WorkPool::knows(const std::string& kind) const { return state_->functions.count(kind) != 0; }

void WorkPool::start(Compute compute) {
  const std::lock_guard lock(state_->mutex);
  state_->queue.push_back(std::move(compute));
  ++state_->pending;
  state_->changed.notify_one();
}

std::vector<FinishedWork> WorkPool::finished() {
  const std::lock_guard lock(state_->mutex);
  std::vector<FinishedWork> finished = std::exchange(state_->finished, {});
  state_->pending -= static_cast<int>(finished.size());
  return finished;
}

int WorkPool::pending() const {
  const std::lock_guard lock(state_->mutex);
  return state_->pending;
}

}  // namespace nacre::runtime
