#include "runtime/interrupts.hpp"

#include <atomic>
#include <cstddef>

namespace nacre::runtime {
namespace {

/// Written by a signal, which any thread may receive, and read by workers.
std::atomic<int> interrupt_count = 0;
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

Interrupts::Interrupts() {
  interrupt_count = 0;
  struct sigaction action {};
  action.sa_handler = [](int) { ++interrupt_count; };
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &action, &before_[i]);
}

Interrupts::~Interrupts() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
}

int Interrupts::count() const { return interrupt_count; }

}  // namespace nacre::runtime
