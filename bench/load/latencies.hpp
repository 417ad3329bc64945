#pragma once
// How long single actions take, and what this process holds.

#include <chrono>
#include <string>
#include <vector>

namespace nacre::load {

class Latencies {
 public:
  /// Does `action` and notes the time that passed.
  template <class Action>
  void time(const Action& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    add(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  void add(double seconds) { seconds_.push_back(seconds); }
  /// One line: count, median, 99 %, largest, and all together.
  void print(const std::string& what) const;

 private:
  std::vector<double> seconds_;
};

/// Largest memory that this process has held in RAM so far, in words: "123 MB".
std::string peak_memory();

}  // namespace nacre::load
