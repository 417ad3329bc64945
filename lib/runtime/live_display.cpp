#include "runtime/live_display.hpp"

#include <cmath>

#include <fmt/format.h>

#include "runtime/terminal.hpp"

namespace nacre::runtime {
namespace {

constexpr int kNameColumns = 16;  // validation_agent
constexpr int kBarCells = 16;

std::string round_in_words(const NodeView& view) {
  return view.round < 0 ? std::string() : fmt::format("round {}", view.round);
}

/// What it does, or why it does nothing.
std::string activity(const NodeView& view) {
  std::string words = view.state == "running" && !view.phase.empty() ? view.phase : view.state;
  if (view.restarts > 0) words += fmt::format(", restarted {} x", view.restarts);
  return words;
}

std::string remarks(const NodeView& view) {
  std::string words;
  if (const std::string left = in_words(view.eta_s); !left.empty()) words += fmt::format("  {} left", left);
  if (!view.problem.empty()) words += fmt::format("  ! {}", view.problem);
  return words;
}

}  // namespace

std::string node_line(const NodeView& view, int columns) {
  const bool is_known = view.progress >= 0.0 && view.state == "running";
  const std::string percent = is_known ? fmt::format("{:3.0f} %", std::floor(100.0 * view.progress)) : "";
  return fitted(fmt::format("{:<{}}  {:<9} {} {:>5}  {}{}", view.node, kNameColumns, round_in_words(view),
                            is_known ? bar(view.progress, kBarCells) : std::string(kBarCells + 2, ' '), percent,
                            activity(view), remarks(view)),
                columns);
}

std::string plain_node_line(const NodeView& view) {
  std::string line = view.node + ":";
  if (view.round >= 0) line += " " + round_in_words(view) + ",";
  line += " " + activity(view);
  if (view.progress >= 0.0 && view.state == "running")
    line += fmt::format(" {:.0f} %", std::floor(100.0 * view.progress));
  return line + remarks(view);
}

void LiveDisplay::erase_lines() {
  if (!drawn_.empty()) std::fprintf(out_, "\x1b[%zuA\r\x1b[J", drawn_.size());
  drawn_.clear();
}

void LiveDisplay::show(const std::vector<NodeView>& views, Clock::time_point now) {
  if (on_terminal()) {
    std::vector<std::string> lines;
    for (const NodeView& view : views) lines.push_back(node_line(view, columns_ - 1));
    if (lines == drawn_) return;
    erase_lines();
    for (const std::string& line : lines) print_line(out_, line);
    drawn_ = std::move(lines);
  } else {
    constexpr auto kEvery = std::chrono::seconds(10);
    for (const NodeView& view : views) {
      const std::string line = plain_node_line(view);
      const auto last = said_.find(view.node);
      if (last != said_.end() && (last->second.line == line || now - last->second.when < kEvery)) continue;
      said_[view.node] = {line, now};
      print_line(out_, line);
    }
  }
  std::fflush(out_);
}

void LiveDisplay::say(const std::string& line) {
  const std::vector<std::string> lines = drawn_;
  erase_lines();
  print_line(out_, line);
  for (const std::string& again : lines) print_line(out_, again);
  drawn_ = lines;
  std::fflush(out_);
}

}  // namespace nacre::runtime
