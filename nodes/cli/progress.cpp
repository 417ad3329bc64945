#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>

#include "runtime/terminal.hpp"

namespace nacre::cli {
namespace {

/// Work must not end because nobody can read how far it is: fmt::print would throw.
void say(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

Progress::Progress(std::string task, std::int64_t total)
    : task_(std::move(task)), total_(total), columns_(runtime::terminal_columns(STDERR_FILENO)) {}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (is_drawn_) say("\r\x1b[K");
  is_drawn_ = false;
}

void Progress::advance(std::int64_t count) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  share_ = static_cast<double>(done_) / static_cast<double>(total_);
  show();
}

void Progress::set(std::int64_t done) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  share_ = static_cast<double>(done_) / static_cast<double>(total_);
  show();
}

void Progress::set_share(double share, const std::string& note) {
  const std::lock_guard lock(mutex_);
  share_ = share;
  note_ = note;
  show();
}

std::string Progress::line() const {
  constexpr int kCells = 24;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - begun_).count();
  const std::string left = share_ > 0.0 ? runtime::in_words(elapsed_s * (1.0 - share_) / share_) : "";
  const std::string count = total_ > 0 ? fmt::format("{}/{}", done_, total_) : fmt::format("{:.0f} %", 100.0 * share_);
  return fmt::format("{} {}{}{}{}", task_, columns_ > 0 ? runtime::bar(share_, kCells) + " " : "", count,
                     left.empty() ? "" : ", " + left + " left", note_.empty() ? "" : ", " + note_);
}

void Progress::show() {
  constexpr auto kRealisation = std::chrono::milliseconds(100);
  constexpr auto kPlainLine = std::chrono::seconds(5);
  const Clock::time_point now = Clock::now();
  if (now - shown_ < (columns_ > 0 ? Clock::duration(kRealisation) : Clock::duration(kPlainLine))) return;
  shown_ = now;
  if (columns_ > 0) {
    say(fmt::format("\r{}\x1b[K", runtime::fitted(line(), columns_ - 1)));
    is_drawn_ = true;
  } else {
    say(line() + "\n");
  }
}

}  // namespace nacre::cli
