#include "simulator_farm/batch_plan.hpp"

#include <algorithm>

namespace nacre::simulator_farm {
namespace {

/// Of one core of 2022 (docs/studies/speed.md), rounded up.
double first_guess_s(tester::TestKind test, tester::Fidelity fidelity) {
  if (test == tester::TestKind::modulus) return fidelity == tester::Fidelity::tiny ? 0.001 : 0.005;
  switch (fidelity) {
    case tester::Fidelity::tiny:
      return 0.02;
    case tester::Fidelity::preview:
      return 1.0;
    case tester::Fidelity::full:
      return 2.0;
    case tester::Fidelity::fine:
      return 16.0;
  }
  return 2.0;
}

}  // namespace

double CostEstimate::seconds(tester::TestKind test, tester::Fidelity fidelity) const {
  const auto known = seconds_.find({test, fidelity});
  return known == seconds_.end() ? first_guess_s(test, fidelity) : known->second;
}

void CostEstimate::learn(tester::TestKind test, tester::Fidelity fidelity, double seconds) {
  constexpr double kWeight = 0.1;
  const double before = this->seconds(test, fidelity);
  seconds_[{test, fidelity}] = before + kWeight * (seconds - before);
}

std::vector<std::size_t> cut_into_batches(const std::vector<double>& costs_s, double batch_s, std::size_t most) {
  std::vector<std::size_t> counts;
  double filled_s = 0.0;
  for (const double cost_s : costs_s) {
    const bool fits = !counts.empty() && counts.back() < most && filled_s + cost_s <= batch_s;
    if (!fits) {
      counts.push_back(0);
      filled_s = 0.0;
    }
    ++counts.back();
    filled_s += cost_s;
  }
  return counts;
}

void BatchWatch::listed(TaskState state, double now_s) {
  if (state == state_) return;
  if (state == TaskState::running) sign_s_ = now_s;
  state_ = state;
  since_s_ = now_s;
}

void BatchWatch::sign(const std::string& text, double now_s) {
  if (text == sign_) return;
  sign_ = text;
  sign_s_ = now_s;
}

bool BatchWatch::is_lost(double now_s, const Patience& patience) const {
  switch (state_) {
    case TaskState::waiting:
      return false;
    case TaskState::running:
      return now_s - sign_s_ >= patience.sign_s;
    case TaskState::absent:
    case TaskState::held:
      return now_s - std::max(since_s_, sign_s_) >= patience.listing_s;
  }
  return false;
}

double back_off_s(int failures) {
  constexpr double kLongest = 60.0;
  double seconds = 1.0;
  for (int i = 1; i < failures && seconds < kLongest; ++i) seconds *= 2.0;
  return std::min(seconds, kLongest);
}

}  // namespace nacre::simulator_farm
