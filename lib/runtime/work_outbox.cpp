#include "runtime/work_outbox.hpp"

#include <utility>

namespace nacre::runtime {

void WorkOutbox::expect_one() {
  const std::lock_guard lock(mutex_);
  ++pending_;
}

void WorkOutbox::pass_on(int count) {
  const std::lock_guard lock(mutex_);
  pending_ -= count;
}

void WorkOutbox::finish(Compute compute, Result<std::string> result) {
  {
    const std::lock_guard lock(mutex_);
    finished_.push_back({std::move(compute), std::move(result)});
  }
  wake_();
}

void WorkOutbox::say(LogLevel level, std::string text) {
  {
    const std::lock_guard lock(mutex_);
    log_.push_back({level, std::move(text)});
  }
  wake_();
}

void WorkOutbox::set_standing(std::string standing) {
  const std::lock_guard lock(mutex_);
  standing_ = std::move(standing);
}

std::vector<FinishedWork> WorkOutbox::finished() {
  const std::lock_guard lock(mutex_);
  pending_ -= finished_.size();
  return std::exchange(finished_, {});
}

int WorkOutbox::pending() const {
  const std::lock_guard lock(mutex_);
  return pending_;
}

std::vector<LogLine> WorkOutbox::take_log() {
  const std::lock_guard lock(mutex_);
  return std::exchange(log_, {});
}

std::string WorkOutbox::standing() const {
  const std::lock_guard lock(mutex_);
  return standing_;
}

}  // namespace nacre::runtime
