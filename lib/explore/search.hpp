#pragma once
// The gamut search: which patterns to simulate next. Ask and tell, so that the simulations may run anywhere.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimize/pareto.hpp"
#include "pattern/layout.hpp"
#include "surrogate/predictor.hpp"
#include "thesis/constants.hpp"

namespace nacre::explore {

/// Specimens of one pattern, whose mean is its toughness.
struct Sampling {
  int specimens = 1;
  double toughness_se_pa = 0.0;  ///< standard error of the mean; 0: not known
  bool operator==(const Sampling&) const = default;
};

/// A simulated pattern.
struct Evaluated {
  pattern::Pattern pattern;
  optimize::Performance performance;
  Sampling sampling = {};
  bool operator==(const Evaluated&) const = default;
};

/// Performances of samples, in their order.
std::vector<optimize::Performance> performances_of(std::span<const Evaluated> samples);

/// How `learned` learns and chooses. The defaults are what docs/studies/search.md found best; `thesis_learning()` is
/// the form of 2.3.3.
struct LearnedSettings {
  std::string predictor = "patches";   ///< patches: Gaussian process on neighbourhoods; networks: residual networks
  std::string choice = "improvement";  ///< improvement: expected hypervolume improvement; rank: non-dominated sorting
  int barred_start = 40;         ///< patterns with rigid bars that follow the random ones (none with `former` samples,
                                 ///< nor where `known` ones are as many as both)
  int barred_candidates = 2000;  ///< of them that every batch may be chosen from, added to those that the search visits
  int generations = 60;          ///< of the search on the predictor
  int population = 100;          ///< of that search
  double optimism = 0.0;         ///< deviations added to predictions while searching on the predictor
  int members = 3;               ///< networks per property; their disagreement is the uncertainty
  bool warm_start = true;        ///< networks go on from those of fewer samples; else from nothing every time
  double weight_decay = thesis::kToughnessWeightDecay;  ///< of the networks for toughness
  double dropout = 0.2;                                 ///< of the networks for toughness
  int most_samples = 5000;        ///< that `patches` learns from; of more, half the best by rank, half of the others
                                  ///< (networks learn from all)
  double floor_deviations = 0.5;  ///< toughness lower than so many robust deviations below its trend over the
                                  ///< rigid fraction counts as just that; 0: as it is
  int specimens = 1;  ///< of one pattern that may be asked for, one by one: a pattern asked for again stands for a
                      ///< further specimen. More than 1: T is an expectation, and every test has noise
  int apart = 1;  ///< flips of free pixels between any two patterns that a batch is chosen from, as far as there are
                  ///< enough of them; 1: they differ
  bool operator==(const LearnedSettings&) const = default;
};

/// `key=value` of all of them, separated by spaces.
std::string to_text(const LearnedSettings& settings);

/// Young's modulus of patterns, exactly as a simulation would compute it, in Pa; empty where that fails.
using ModulusOf = std::function<std::vector<std::optional<double>>(std::span<const pattern::Pattern>)>;

/// Elastic quantities of any pattern for far less than a fracture simulation (mechanics.hpp). A search does without
/// those that are empty.
struct Mechanics {
  ModulusOf modulus_of = {};              ///< computed for the finalists of a batch (hundreds)
  surrogate::Features cell_modulus = {};  ///< computed for all that a batch's search visits (thousands): one column
  surrogate::Features cell_loads = {};    ///< the same; distribution of the energy, in logarithms
};

struct SearchSettings {
  std::string algorithm = "nsga2";   ///< one of algorithms()
  int budget = 300;                  ///< simulations
  int population = 20;               ///< random patterns to begin with, and NSGA-II's population
  int batch = thesis::kSearchBatch;  ///< patterns asked for at once (one generation's offspring in NSGA-II)
  std::uint64_t seed = 1;
  std::vector<Evaluated> known =
      {};  ///< already simulated with the same parameters: part of the start, not asked again
  std::vector<Evaluated> former =
      {};                        ///< simulated with other parameters or at another fidelity; `learned` learns from them
  LearnedSettings learned = {};  ///< of `learned` alone
  Mechanics mechanics = {};      ///< for `learned`
};

/// Everything that the next batch of a model-based search depends on.
struct BatchRequest {
  SearchSettings settings;             ///< with `known` left empty: it stands in `evaluated`
  std::vector<Evaluated> evaluated;    ///< in order of evaluation
  std::vector<pattern::Pattern> lost;  ///< asked for, but the simulation failed
  int count = 0;                       ///< patterns wanted, at most
};

/// Deterministic: patterns asked for depend on the settings and the told performances only. No pattern is asked for
/// twice, unless LearnedSettings::specimens allows it.
class Search {
 public:
  virtual ~Search() = default;
  /// The next patterns to simulate; empty when the search has ended (budget spent, or no new pattern found).
  virtual std::vector<pattern::Pattern> ask() = 0;
  /// Performance of the patterns last asked for, in their order; nothing where the simulation failed. Where a T is not
  /// that of one specimen, of how many it is the mean: for all patterns, or for none.
  virtual void tell(std::span<const std::optional<optimize::Performance>> performances,
                    std::span<const Sampling> samplings = {}) = 0;
  /// Everything evaluated so far: settings.known first (each pattern once), then what was told, in order of evaluation;
  /// failed simulations are left out (they count towards the budget and are not asked for again).
  virtual const std::vector<Evaluated>& evaluated() const = 0;

  /// The request behind the next ask() when that would take longer than a moment; empty when it would not. Who must not
  /// wait has batch_for() computed elsewhere and calls ask_with() with the batch.
  virtual std::optional<BatchRequest> batch_request() const { return std::nullopt; }
  /// ask() with the batch of batch_request(). Also for going on: batches that were asked for before an interruption
  /// need not be computed again. A search without batch requests throws InputError when its own batch is another one,
  /// and asks for as many patterns as it would.
  virtual std::vector<pattern::Pattern> ask_with(std::span<const pattern::Pattern> batch);
};

/// The patterns to simulate next, for the request of a search. A pure function; takes seconds.
std::vector<pattern::Pattern> batch_for(const BatchRequest& batch_request);

/// Names of the algorithms: nsga2 (NSGA-II with the three-way mutation and no crossover); nsga2-single-pixel,
/// nsga2-rollback (the baselines of 3.2.5); random; learned (2.3.3); tsemo, dgemo, nehvi, morbo and egbo (Bayesian
/// optimisation).
const std::vector<std::string>& algorithms();

/// Searches with equal seeds and populations begin with the same random patterns whatever the algorithm; `known`
/// patterns take their places. Throws InputError for an unknown algorithm or settings out of range.
std::unique_ptr<Search> make_search(const SearchSettings& settings);

}  // namespace nacre::explore
