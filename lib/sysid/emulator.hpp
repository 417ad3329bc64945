#pragma once
// Predictions of the toughness tester at parameters where it was not run yet, from the runs that there are: two
// features per design, log T and log peak stress, each a Gaussian process over the logarithms of the parameters.
//
// The prior mean and the linear part of the covariance follow from dimensional analysis of a brittle elastic body
// pulled slowly: scaling all moduli by a and all failure energies by b scales toughness by b, stress by sqrt(a b),
// strain by sqrt(b / a). How the sums split over the three materials, and everything else, is learnt. All designs share
// one covariance, so that a refit costs one factorisation whatever their number.

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "material/ranges.hpp"
#include "sysid/eta.hpp"
#include "sysid/features.hpp"
#include "sysid/fit.hpp"

namespace nacre::sysid {

/// Natural logarithm of the ratio maximum / minimum of each range, 1 where it is searched linearly: unit coordinate
/// times span is the coordinate in which the emulator works.
std::vector<double> spans_of(std::span<const material::ParameterRange> ranges);

/// Predicted change of the features of one design.
using FeatureChange = CurveFeatures;

/// Standard deviations of the emulator's prior, all of natural logarithms.
struct EmulatorPrior {
  double split_deviation = 0.3;   ///< of how a sum of sensitivities splits over the materials
  double sum_deviation = 0.1;     ///< of the sum itself: inertia, damping and large strains
  double curved_deviation = 0.2;  ///< of what is not linear
  double curved_length = 1.5;     ///< distance in log parameters over which it changes
  double noise_deviation = 0.05;  ///< elements fail one by one: T jumps by some percent
};

class FeatureEmulator {
 public:
  FeatureEmulator(std::vector<double> spans, std::size_t design_count);
  /// Learns from the trials, each with a prediction per design, seen from trials[centre]: only the nearest 60 are used.
  /// A failed prediction counts as one that met the prior's expectation exactly: all designs share one factorisation,
  /// so that none can be without an observation.
  void learn(const std::vector<FitTrial>& trials, std::size_t centre);
  /// The same with the prior that the trials themselves make most probable: how jumpy and how curved this set of
  /// designs is.
  void learn_with_prior(const std::vector<FitTrial>& trials, std::size_t centre);
  const EmulatorPrior& prior() const { return prior_; }
  /// Change of the features of all designs between the centre and `point` (in unit coordinates).
  void predict(const Point& point, std::vector<FeatureChange>& changes) const;
  /// The same, but from the centre as it was simulated to `point` as it would be without jumps: at the centre itself
  /// the centre's own jump, estimated from the neighbours.
  void predict_smooth(const Point& point, std::vector<FeatureChange>& changes) const;
  /// Standard deviation of that change; it does not depend on the design.
  double deviation(const Point& point) const;
  /// As predict_smooth(), and returns by how much that may be wrong, in any design: a standard deviation.
  double predict_with_deviation(const Point& point, std::vector<FeatureChange>& changes) const;
  /// A point whose result is not known yet: deviations become small around it.
  void add_pending(const Point& point);

 private:
  Eigen::VectorXd coordinates(const Point& point) const;
  double covariance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  Eigen::VectorXd covariances(const Eigen::VectorXd& at) const;
  void factorise();
  void take_targets(const std::vector<FitTrial>& trials, std::size_t centre);
  void solve();
  void change(const Eigen::VectorXd& at, const Eigen::VectorXd& to_inputs, const Eigen::RowVectorXd& offset,
              std::vector<FeatureChange>& changes) const;
  double log_evidence() const;

  std::vector<double> spans_;
  std::size_t design_count_;
  EmulatorPrior prior_;
  std::vector<std::size_t> used_;        ///< trials learnt from
  Eigen::MatrixXd targets_;              ///< their features less the centre's and the prior's: trials x (2 designs)
  std::vector<Eigen::VectorXd> inputs_;  ///< learnt points, then pending ones
  Eigen::VectorXd centre_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd coefficients_;  ///< inputs x (2 designs), log T then log peak
  Eigen::RowVectorXd at_centre_;
};

/// Slopes of log T (rows 0..N-1) and log peak stress (N..2N-1) of all designs with respect to the unit coordinates of
/// eta; those of Poisson's ratios are 0 unless they were searched.
Eigen::MatrixXd feature_slopes(const FeatureEmulator& emulator, const Point& at, std::size_t design_count,
                               bool poisson_searched);

/// Eta's fit around trials[best], linear: the emulator's slopes (2 designs x searched) and the residuals of both
/// features.
struct ToughnessModel {
  std::vector<std::size_t> searched;  ///< coordinates that the columns stand for
  Eigen::MatrixXd slopes;
  Eigen::VectorXd residuals, weights;  ///< weight 0: no residual
  double noise = 0.0;                  ///< variance of a residual (spread.hpp)
};
ToughnessModel toughness_model(const FitData& data, const std::vector<FitTrial>& trials, std::size_t best,
                               const std::vector<double>& spans, bool poisson_searched);

/// Deviations of eta at trials[best] by that model, and the floor that all designs share.
std::vector<double> toughness_deviations(const FitData& data, const std::vector<FitTrial>& trials, std::size_t best,
                                         const std::vector<double>& spans, bool poisson_searched,
                                         const DiscretisationFloor& floor);

}  // namespace nacre::sysid
