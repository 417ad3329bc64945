#include "dashboard/background.hpp"

#include <exception>

#include "runtime/bus.hpp"

namespace nacre::dashboard {

struct Background::Task {
  Work work;
  State state;
  std::int64_t begun_us = 0;
};

std::string_view to_string(Background::Stage stage) {
  switch (stage) {
    case Background::Stage::queued:
      return "queued";
    case Background::Stage::working:
      return "working";
    case Background::Stage::ready:
      return "ready";
    case Background::Stage::failed:
      return "failed";
    case Background::Stage::unknown:
      break;
  }
  return "absent";
}

Background::Background(std::size_t kept, std::size_t longest_queue)
    : kept_(kept), longest_queue_(longest_queue), thread_([this] { run(); }) {}

Background::~Background() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  something_to_do_.notify_all();
  thread_.join();
}

bool Background::ask(const std::string& key, Work work) {
  const std::lock_guard lock(mutex_);
  const auto known = tasks_.find(key);
  if (known != tasks_.end() && known->second->state.stage != Stage::failed) return true;
  if (queue_.size() >= longest_queue_) return false;
  const auto task = std::make_shared<Task>();
  task->work = std::move(work);
  task->state.stage = Stage::queued;
  tasks_[key] = task;
  std::erase(done_, key);
  queue_.push_back(key);
  something_to_do_.notify_one();
  return true;
}

Background::State Background::state(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto known = tasks_.find(key);
  if (known == tasks_.end()) return {};
  State state = known->second->state;
  if (state.stage == Stage::working)
    state.working_s = 1e-6 * static_cast<double>(runtime::steady_us() - known->second->begun_us);
  return state;
}

void Background::forget_oldest() {
  while (done_.size() > kept_) {
    tasks_.erase(done_.front());
    done_.pop_front();
  }
}

void Background::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    something_to_do_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
    if (stopping_) return;
    const std::string key = queue_.front();
    queue_.pop_front();
    const std::shared_ptr<Task> task = tasks_.at(key);
    task->state.stage = Stage::working;
    task->begun_us = runtime::steady_us();
    lock.unlock();
    Result<std::string> result = tl::unexpected(Error{"it did not run"});
    try {
      result = task->work([&](double share) {
        const std::lock_guard told(mutex_);
        task->state.progress = share;
      });
    } catch (const std::exception& error) {
      result = tl::unexpected(Error{error.what()});
    }
    lock.lock();
    task->work = {};
    task->state.stage = result ? Stage::ready : Stage::failed;
    if (result) task->state.result = std::make_shared<const std::string>(std::move(*result));
    if (!result) task->state.problem = result.error().message;
    done_.push_back(key);
    forget_oldest();
  }
}

}  // namespace nacre::dashboard
