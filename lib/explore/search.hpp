#pragma once
// The gamut search: which patterns to simulate next. Ask and tell, so that the simulations may run anywhere.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimize/pareto.hpp"
#include "pattern/layout.hpp"

namespace nacre::explore {

/// A simulated pattern.
struct Evaluated {
  pattern::Pattern pattern;
  optimize::Performance performance;
  bool operator==(const Evaluated&) const = default;
};

struct SearchSettings {
  std::string algorithm = "nsga2";  ///< nsga2, nsga2-single-pixel, nsga2-rollback, random
  int budget = 300;                 ///< simulations
  int population = 20;
  int batch = 10;  ///< patterns asked for at once (one generation's offspring in NSGA-II)
  std::uint64_t seed = 1;
  std::vector<Evaluated> known;  ///< already simulated with the same parameters: part of the start, not asked again
};

/// Deterministic: patterns asked for depend on the settings and what was told only. No pattern is asked for twice.
class Search {
 public:
  virtual ~Search() = default;
  /// The next patterns to simulate; empty when the search has ended (budget spent, or no new pattern found).
  virtual std::vector<pattern::Pattern> ask() = 0;
  /// Performance of the patterns last asked for, in their order; nothing where the simulation failed.
  virtual void tell(std::span<const std::optional<optimize::Performance>> performances) = 0;
  /// Everything evaluated so far: settings.known first (each pattern once), then what was told, in order of evaluation;
  /// failed simulations are left out (they count towards the budget and are not asked for again).
  virtual const std::vector<Evaluated>& evaluated() const = 0;
};

/// nsga2: NSGA-II with the three-way mutation and no crossover; nsga2-single-pixel, nsga2-rollback: the baselines
/// of 3.2.5; random: random patterns. Searches with equal seeds and populations begin with the same random patterns
/// whatever the algorithm; `known` patterns take their places. Throws InputError for an unknown algorithm or settings
/// out of range.
std::unique_ptr<Search> make_search(const SearchSettings& settings);

}  // namespace nacre::explore
