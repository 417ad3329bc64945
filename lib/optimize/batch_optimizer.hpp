#pragma once
// The interface of all optimisers: minimisation over the unit cube by ask and tell, in batches.

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "thesis/constants.hpp"

namespace nacre::optimize {

using Point = std::vector<double>;  ///< coordinates in [0, 1]

/// An evaluated point; no value when the evaluation failed.
struct Evaluation {
  Point point;
  std::optional<double> value;
};

struct BatchOptimizerSettings {
  int dimension = 0;
  int budget = 0;                         ///< evaluations in all, the start included
  int batch = thesis::kCalibrationBatch;  ///< points asked for at once
  std::uint64_t seed = 1;
  std::vector<Point> starts;  ///< points to begin with, best guess first (may be empty)
  double value_deviation =
      0.0;               ///< known standard deviation of a value: repeatability of the testers, scatter of replicates
  int first_points = 0;  ///< space-filling points after the starts, of methods that have a model; 0: 2 dimension + 1
};

/// Deterministic: the points asked for depend on the settings and the values told so far only.
class BatchOptimizer {
 public:
  virtual ~BatchOptimizer() = default;
  /// The next points, at most settings.batch; empty when the budget is spent or nothing more can be gained.
  virtual std::vector<Point> ask() = 0;
  /// The values of the points last asked for, in their order.
  virtual void tell(const std::vector<std::optional<double>>& values) = 0;
  /// Best evaluation so far; nothing before the first success.
  virtual std::optional<Evaluation> best() const = 0;
  /// Goes on where a search with the same settings stopped: `told` is everything that one was told, in order, in whole
  /// batches. Call it first. Throws InputError when these settings would not have asked for those points; Bayesian
  /// optimisation, which would have to refit all its models, checks only the points from before its first model.
  virtual void resume(const std::vector<Evaluation>& told);
};

/// The algorithms of make_optimizer().
enum class Algorithm {
  bayesian,      ///< make_bayesian_optimizer
  trust_region,  ///< make_nlopt_optimizer: BOBYQA's quadratic models, with Nelder-Mead in turn
  random,        ///< uniform in the cube
  direct_l,      ///< NLopt's DIRECT-L
  crs2,          ///< NLopt's controlled random search with local mutation
  cma_es,        ///< covariance matrix adaptation, restarted with twice the population when it has collapsed
};
std::string_view to_string(Algorithm algorithm);
Result<Algorithm> algorithm_from_string(std::string_view name);
std::unique_ptr<BatchOptimizer> make_optimizer(Algorithm algorithm, const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
