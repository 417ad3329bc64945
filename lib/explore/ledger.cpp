#include "explore/ledger.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nacre::explore {

Ledger::Ledger(const SearchSettings& settings) : budget_(settings.budget), batch_size_(settings.batch) {
  for (const Evaluated& sample : settings.known) {
    if (seen_.insert(sample.pattern.bits()).second) evaluated_.push_back(sample);
  }
}

int Ledger::room() const {
  if (awaiting_) return 0;
  const int in_batch = batch_.size();
  return std::min(batch_size_, budget_ - asked_) - in_batch;
}

void Ledger::add(const pattern::Pattern& pattern) {
  assert(!awaiting_ && room() > 0);
  [[maybe_unused]] const bool is_new = seen_.insert(pattern.bits()).second;
  assert(is_new);
  batch_.push_back(pattern);
}

std::vector<pattern::Pattern> Ledger::hand_out() {
  assert(!awaiting_ && "ask() before the last batch was told");
  asked_ += batch_.size();
  awaiting_ = !batch_.empty();
  return batch_;
}

std::span<const Evaluated> Ledger::record(std::span<const std::optional<optimize::Performance>> performances) {
  assert(awaiting_ && "tell() without a batch that was asked for");
  assert(performances.size() == batch_.size() && "tell() needs a performance for every pattern of the batch");
  const std::size_t before = evaluated_.size();
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    if (!performances[i]) continue;
    assert(std::isfinite(performances[i]->modulus_pa) && std::isfinite(performances[i]->toughness_pa));
    evaluated_.push_back({batch_[i], *performances[i]});
  }
  batch_.clear();
  awaiting_ = false;
  return std::span<const Evaluated>(evaluated_).subspan(before);
}

}  // namespace nacre::explore
