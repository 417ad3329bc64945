#pragma once

#include <array>
#include <csignal>

namespace nacre::runtime {

/// While one lives, SIGINT, SIGTERM and SIGHUP are counted instead of ending the program, so that it can stop in order.
/// One at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  int count() const;
  bool any() const { return count() > 0; }

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

}  // namespace nacre::runtime
