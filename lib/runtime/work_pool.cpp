#include "runtime/work_pool.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "base/parallel.hpp"
#include "runtime/work_outbox.hpp"

namespace nacre::runtime {

/// Shared with the threads, which may outlive the pool.
struct WorkPool::State {
  State(std::map<std::string, WorkFunction> known, std::function<void()> wake)
      : functions(std::move(known)), outbox(std::move(wake)) {}

  const std::map<std::string, WorkFunction> functions;
  WorkOutbox outbox;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Compute> queue;
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
      outbox.finish(std::move(compute), std::move(result));
    }
  }
};

WorkPool::WorkPool(std::map<std::string, WorkFunction> functions, int threads, std::function<void()> wake)
    : state_(std::make_shared<State>(std::move(functions), std::move(wake))) {
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
  state_->outbox.expect_one();
  const std::lock_guard lock(state_->mutex);
  state_->queue.push_back(std::move(compute));
  state_->changed.notify_one();
}

std::vector<FinishedWork> WorkPool::finished() { return state_->outbox.finished(); }

int WorkPool::pending() const { return state_->outbox.pending(); }

}  // namespace nacre::runtime
