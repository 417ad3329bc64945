#pragma once
// The nodes of a run as a person watches them: one line per node, redrawn on a terminal, said again elsewhere.

#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

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

/// Shows views on a stream. On a terminal the lines are redrawn in place; elsewhere a node's line is printed when it
/// changed and the last one is ten seconds old. Messages go above the lines.
class LiveDisplay {
 public:
  using Clock = std::chrono::steady_clock;
  /// `columns`: of the terminal, 0 for a file or pipe.
  LiveDisplay(std::FILE* out, int columns) : out_(out), columns_(columns) {}

  bool on_terminal() const { return columns_ > 0; }
  void show(const std::vector<NodeView>& views, Clock::time_point now);
  /// A line for a person.
  void say(const std::string& line);

 private:
  struct Said {
    std::string line;
    Clock::time_point when;
  };
  void erase_lines();

  std::FILE* out_;
  int columns_;
  std::vector<std::string> drawn_;
  std::map<std::string, Said> said_;
};

}  // namespace nacre::runtime
