#pragma once
// The seam between calibration and the optimiser it uses: minimisation over the unit cube by ask and tell, in batches.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace nacre::optimize {

using Point = std::vector<double>;  ///< coordinates in [0, 1]

/// An evaluated point; no value when the evaluation failed.
struct Evaluation {
  Point point;
  std::optional<double> value;
};

struct BatchOptimizerSettings {
  int dimension = 0;
  int budget = 0;  ///< evaluations in all, the start included
  int batch = 3;   ///< points asked for at once
  std::uint64_t seed = 1;
  std::vector<Point> starts;  ///< points to begin with, best guess first (may be empty)
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
};

/// Local searches of NLopt (BOBYQA and Nelder-Mead in turn): first the starts, then a search from the best of them; one
/// that ends or finds nothing new gives way to the next, from the best point so far with half the step. NLopt calls
/// back instead of being asked, so each ask() runs the search anew on the values recorded so far until it wants an
/// unknown point; the rest of the batch is what it would want next if that point were as good as its nearest neighbour.
/// The whole budget is used and no point is asked for twice. Failed evaluations count, and are worse than all others to
/// the search. Throws InputError for settings out of range.
std::unique_ptr<BatchOptimizer> make_nlopt_optimizer(const BatchOptimizerSettings& settings);

}  // namespace nacre::optimize
