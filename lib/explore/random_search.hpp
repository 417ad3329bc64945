#pragma once
// Random patterns of the design space (Table 3.2).

#include <memory>

#include "base/random.hpp"
#include "explore/ledger.hpp"
#include "explore/search.hpp"

namespace nacre::explore {

/// The random patterns that a search begins with: `population` of them less the known ones, stratified as in Table 3.2
/// and the same for every algorithm with this seed.
std::vector<pattern::Pattern> starting_patterns(const SearchSettings& settings);

/// An unseen random pattern of the design space.
pattern::Pattern unseen_random_pattern(const Ledger& ledger, RandomStream& random);

/// Random patterns until the budget is spent.
std::unique_ptr<Search> make_random_search(const SearchSettings& settings);

}  // namespace nacre::explore
