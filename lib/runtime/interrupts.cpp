#include "runtime/interrupts.hpp"

#include <cstddef>

namespace nacre::runtime {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;

}  // namespace

Interrupts::Interrupts() {
  interrupt_count = 0;
  struct sigaction action {};
  action.sa_handler = [](int) { interrupt_count = interrupt_count + 1; };
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &action, &before_[i]);
}

Interrupts::~Interrupts() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
}

int Interrupts::count() const { return interrupt_count; }

}  // namespace nacre::runtime
