#pragma once
// Model-based search: fit to all samples, choose a batch, repeat.

#include <memory>

#include "explore/search.hpp"

namespace nacre::explore {

/// A search that fits models to all samples before every batch (batch_for()): random patterns first, like every search,
/// then batch after batch until the budget is spent or no new pattern is found.
std::unique_ptr<Search> make_model_search(const SearchSettings& settings);

/// Seed of everything random in the choice of a batch: another one for every batch.
std::uint64_t batch_seed(const BatchRequest& batch_request);

/// Candidates that may still be asked for.
std::vector<Evaluated> unseen(std::vector<Evaluated> candidates, const BatchRequest& batch_request);

/// Up to `count` candidates, one by one for the largest growth of the hypervolume of `evaluated` and those chosen,
/// their predictions taken as exact.
std::vector<pattern::Pattern> largest_growth(std::span<const Evaluated> candidates,
                                             std::span<const Evaluated> evaluated, int count);

}  // namespace nacre::explore
