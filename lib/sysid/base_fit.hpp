#pragma once
// Round 0 (thesis 3.2) for one material: the parameters that its own tests depend on. T grows with W at constant E;
// peak stress with sqrt(E W).

#include <optional>
#include <vector>

#include "material/ranges.hpp"
#include "measurement/summary.hpp"
#include "sysid/calibration.hpp"
#include "sysid/prediction.hpp"
#include "sysid/ratio_search.hpp"

namespace nacre::sysid {

/// Relative error of a base material's toughness at which its fit has done its task.
inline constexpr double kToughnessAim = 0.01;

/// The parameters of one material in the toughness tester.
struct MaterialTrial {
  double e_pa = 0.0, w_j_per_m3 = 0.0, gamma_per_s = 0.0;
};

struct MaterialRanges {
  material::ParameterRange e, w, gamma;
};

/// Finds W of one homogeneous material in the toughness tester, at the damping of the start. E stays at the start, the
/// measured modulus as nearly as its range allows, and W is searched until the toughness is met. Where no W meets it,
/// because T jumps across the measured value when a crack arrests, E and W are scaled together from the nearest miss:
/// at the same W / E the crack path is the same and T grows in proportion. Where that fails too, other E are tried.
/// Where a curve was measured, E moves once the toughness is met so that the peak stress agrees too: at the same W,
/// toughness hardly depends on E while stress grows with its square root.
class MaterialFit {
 public:
  MaterialFit(const measurement::Replicates& measured, const MaterialRanges& ranges, const MaterialTrial& start,
              int budget);
  std::vector<MaterialTrial> ask(int count);
  void tell(const MaterialTrial& trial, const Prediction& prediction);
  bool finished() const { return finished_; }
  /// Within kToughnessAim of the measured toughness.
  bool met() const;
  int evaluations() const { return evaluations_; }
  double error() const;
  double progress() const;
  const MaterialTrial& best() const { return best_; }
  const Prediction& best_prediction() const { return best_prediction_; }

 private:
  enum class Search { threshold, scale };
  void begin_threshold(double e_pa, double first_w);
  void begin_scale();
  bool next_search();
  bool match_peak();
  MaterialTrial trial_at(double x) const;

  measurement::Replicates measured_;
  MaterialRanges ranges_;
  MaterialTrial start_;
  int budget_ = 0;
  int evaluations_ = 0;
  Search kind_ = Search::threshold;
  std::optional<RatioSearch> search_;  ///< over W, or over the common factor on `origin_`
  MaterialTrial origin_;               ///< of the search in progress
  std::size_t modulus_ = 0;            ///< of the factors on E, the one in use
  int peak_matches_ = 0;
  bool any_ = false, finished_ = false;
  MaterialTrial best_;
  Prediction best_prediction_;
  double best_misfit_ = 0.0;
};

}  // namespace nacre::sysid
