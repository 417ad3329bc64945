#pragma once
// The nodes of a run as a person watches them: one line per node, refreshed on a terminal, printed again elsewhere.

#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "runtime/round_clock.hpp"

namespace nacre::runtime {

/// What is known of a node.
struct NodeView {
  std::string node;
  std::string state = "starting";  ///< starting, running, restarting, finished, stopped, failed
  std::string phase;
  int round = -1;          ///< -1: none yet
  double progress = -1.0;  ///< 0..1 of the phase, -1 unknown
  double eta_s = -1.0;     ///< seconds left in the phase, -1 unknown
  int restarts = 0;
  std::string problem;
};

/// One line about a node, at most `columns` characters: name, round, bar, phase, time left, problem.
std::string node_line(const NodeView& view, int columns);

/// The same for files and pipes, without the bar: what changes little is worth no new line.
std::string plain_node_line(const NodeView& view);

/// One line about the game of `rounds` rounds: "round 1 of 3, searching, about 4 min left". The step and its time left
/// are those of the first node, in the order of a round, that neither waits for another one nor is idle. Empty before
/// the validation agent has reported.
std::string game_line(const std::vector<NodeView>& views, int rounds);

/// What is left of the round and of the game, behind game_line(): "; about 7 min of the round, about 18 min of the
/// game". Empty where the rounds so far do not tell.
std::string time_left_of_game(const RoundClock& clock, int rounds, RoundClock::Clock::time_point now);

/// Shows the game and its nodes on a stream. On a terminal the lines are refreshed in place; elsewhere a line is
/// printed when it changed and the last one is ten seconds old. Messages go above the lines.
class LiveDisplay {
 public:
  using Clock = std::chrono::steady_clock;
  /// `columns`: of the terminal, 0 for a file or pipe; `rounds`: of the game.
  LiveDisplay(std::FILE* out, int columns, int rounds) : out_(out), columns_(columns), rounds_(rounds) {}

  bool on_terminal() const { return columns_ > 0; }
  void show(const std::vector<NodeView>& views, Clock::time_point now);
  /// A line for a person.
  void say(const std::string& line);

 private:
  struct Printed {
    std::string line;
    Clock::time_point when;
  };
  void erase_lines();
  void show_plainly(const std::string& name, const std::string& line, Clock::time_point now);

  std::FILE* out_;
  int columns_;
  int rounds_;
  RoundClock clock_;
  std::vector<std::string> drawn_;
  std::map<std::string, Printed> printed_;  ///< by node; "" the game
};

}  // namespace nacre::runtime
