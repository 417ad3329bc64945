#include "runtime/live_display.hpp"

#include <algorithm>
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

/// Whether there is a share to show: what is complete waits for something else, which the phase says.
bool has_progress(const NodeView& view) {
  return view.progress >= 0.0 && view.progress < 1.0 && view.state == "running";
}

/// The node whose work the game waits for; `otherwise` when all wait.
const NodeView& busy_node(const std::vector<NodeView>& views, const NodeView& otherwise) {
  for (const char* name : {"validation_agent", "proposal_agent", "analyser", "virtual_lab", "simulator_farm"}) {
    const auto view = std::ranges::find(views, name, &NodeView::node);
    if (view == views.end() || view->state != "running") continue;
    if (!view->phase.starts_with("waiting") && view->phase != "idle") return *view;
  }
  return otherwise;
}

std::string remarks(const NodeView& view) {
  std::string words;
  if (const std::string left = in_words(view.eta_s); !left.empty()) words += fmt::format("  {} left", left);
  if (!view.problem.empty()) words += fmt::format("  ! {}", view.problem);
  return words;
}

}  // namespace

std::string node_line(const NodeView& view, int columns) {
  const bool is_known = has_progress(view);
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
  if (has_progress(view)) line += fmt::format(", {:.0f} %", std::floor(100.0 * view.progress));
  return line + remarks(view);
}

std::string game_line(const std::vector<NodeView>& views, int rounds) {
  const auto judge = std::ranges::find(views, "validation_agent", &NodeView::node);
  if (judge == views.end() || judge->round < 0) return "";
  const NodeView& busy = busy_node(views, *judge);
  const std::string round = judge->round == 0 && rounds > 0 ? fmt::format("preparing round 1 of {}", rounds)
                            : judge->round > rounds         ? "after the last round"
                                                            : fmt::format("round {} of {}", judge->round, rounds);
  const std::string left = time_left_in_words(busy.eta_s);
  return fmt::format("{}, {}{}", round, busy.state == "running" && !busy.phase.empty() ? busy.phase : busy.state,
                     left.empty() ? "" : ", " + left);
}

std::string time_left_of_game(const RoundClock& clock, int rounds, RoundClock::Clock::time_point now) {
  const std::optional<double> round_s = clock.round_left_s(now), game_s = clock.game_left_s(rounds, now);
  if (!round_s || !game_s) return "";
  return fmt::format("; {} of the round, {} of the game", about_in_words(*round_s), about_in_words(*game_s));
}

void LiveDisplay::erase_lines() {
  if (!drawn_.empty()) std::fprintf(out_, "\x1b[%zuA\r\x1b[J", drawn_.size());
  drawn_.clear();
}

void LiveDisplay::show(const std::vector<NodeView>& views, Clock::time_point now) {
  const auto judge = std::ranges::find(views, "validation_agent", &NodeView::node);
  if (judge != views.end()) clock_.see(judge->round, now);
  const std::string game = game_line(views, rounds_) + time_left_of_game(clock_, rounds_, now);
  if (on_terminal()) {
    std::vector<std::string> lines;
    if (!game.empty()) lines.push_back(fitted(game, columns_ - 1));
    for (const NodeView& view : views) lines.push_back(node_line(view, columns_ - 1));
    if (lines == drawn_) return;
    erase_lines();
    for (const std::string& line : lines) print_line(out_, line);
    drawn_ = std::move(lines);
  } else {
    if (!game.empty()) show_plainly("", game, now);
    for (const NodeView& view : views) show_plainly(view.node, plain_node_line(view), now);
  }
  std::fflush(out_);
}

void LiveDisplay::show_plainly(const std::string& name, const std::string& line, Clock::time_point now) {
  constexpr auto kEvery = std::chrono::seconds(10);
  const auto last = printed_.find(name);
  if (last != printed_.end() && (last->second.line == line || now - last->second.when < kEvery)) return;
  printed_[name] = {line, now};
  print_line(out_, line);
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
