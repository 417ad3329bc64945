#pragma once
// The record of every search: patterns asked for, their performances, and the budget that is left.

#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

class Ledger {
 public:
  explicit Ledger(const SearchSettings& settings);
  /// Whether the pattern is known, was asked for before or stands in the batch that is being put together.
  bool seen(const pattern::Pattern& pattern) const { return seen_.contains(pattern.bits()); }
  /// Patterns that the batch may still take; none while performances are awaited.
  int room() const;
  /// Adds an unseen pattern to the batch.
  void add(const pattern::Pattern& pattern);
  /// Adds an evaluated pattern to the batch: one more specimen of it is wanted.
  void add_again(const pattern::Pattern& pattern);
  /// The batch is handed out; asserts that the last one was told.
  std::vector<pattern::Pattern> hand_out();
  /// What was told of the last batch (Search::tell); asserts that there is one of this size. Returns the new samples. A
  /// further specimen enters into the mean of its pattern.
  std::span<const Evaluated> record(std::span<const std::optional<optimize::Performance>> performances,
                                    std::span<const Sampling> samplings = {});
  const std::vector<Evaluated>& evaluated() const { return evaluated_; }
  int asked() const { return asked_; }

 private:
  int budget_, batch_size_;
  int asked_ = 0;
  bool awaiting_ = false;
  std::vector<pattern::Pattern> batch_;
  std::unordered_set<std::uint64_t> seen_;  ///< the 55 bits themselves: exact, unlike Eq. 2.12
  std::vector<Evaluated> evaluated_;
};

}  // namespace nacre::explore
