#include "explore/ledger.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nacre::explore {
namespace {

/// The mean over one specimen more, and its standard error from the scatter of all (updated sums of squares).
void take_specimen(Evaluated& sample, double toughness_pa) {
  Sampling& sampling = sample.sampling;
  const double n = sampling.specimens, apart = toughness_pa - sample.performance.toughness_pa;
  const double squares =
      n * (n - 1.0) * sampling.toughness_se_pa * sampling.toughness_se_pa + n / (n + 1.0) * apart * apart;
  sample.performance.toughness_pa += apart / (n + 1.0);
  sampling.toughness_se_pa = std::sqrt(squares / (n * (n + 1.0)));
  ++sampling.specimens;
}

}  // namespace

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

void Ledger::add_again(const pattern::Pattern& pattern) {
  assert(!awaiting_ && room() > 0 && seen(pattern));
  batch_.push_back(pattern);
}

std::vector<pattern::Pattern> Ledger::hand_out() {
  assert(!awaiting_ && "ask() before the last batch was told");
  asked_ += batch_.size();
  awaiting_ = !batch_.empty();
  return batch_;
}

std::span<const Evaluated> Ledger::record(std::span<const std::optional<optimize::Performance>> performances,
                                          std::span<const Sampling> samplings) {
  assert(awaiting_ && "tell() without a batch that was asked for");
  assert(performances.size() == batch_.size() && "tell() needs a performance for every pattern of the batch");
  assert((samplings.empty() || samplings.size() == batch_.size()) && "specimens of every pattern");
  const std::size_t before = evaluated_.size();
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    if (!performances[i]) continue;
    assert(std::isfinite(performances[i]->modulus_pa) && std::isfinite(performances[i]->toughness_pa));
    const auto known = std::find_if(evaluated_.begin(), evaluated_.begin() + static_cast<std::ptrdiff_t>(before),
                                    [&](const Evaluated& sample) { return sample.pattern == batch_[i]; });
    if (known != evaluated_.begin() + static_cast<std::ptrdiff_t>(before))
      take_specimen(*known, performances[i]->toughness_pa);
    else
      evaluated_.push_back({batch_[i], *performances[i], samplings.empty() ? Sampling{} : samplings[i]});
  }
  batch_.clear();
  awaiting_ = false;
  return std::span<const Evaluated>(evaluated_).subspan(before);
}

}  // namespace nacre::explore
