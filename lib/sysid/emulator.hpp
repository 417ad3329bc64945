#pragma once
// What the toughness tester would say at parameters where it was not run yet, from the runs that there are: two
// features per design, log T and log peak stress, each a Gaussian process over the logarithms of the parameters.
//
// The prior mean and the linear part of the covariance carry what dimensions say of a brittle elastic body pulled
// slowly: scaling all moduli by a and all failure energies by b scales toughness by b, stress by sqrt(a b), strain by
// sqrt(b / a). How the sums split over the three materials, and everything else, is learnt. All designs share one
// covariance, so that a refit costs one factorisation whatever their number.

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "sysid/fit.hpp"

namespace nacre::sysid {

/// Index of the parameters of eta in its vector.
enum EtaIndex { kE0 = 0, kNu0 = 3, kW0 = 6, kGamma = 9, kEtaCount = 10 };

/// Natural logarithm of the ratio maximum / minimum of each range, 1 where it is searched linearly: unit coordinate
/// times span is the coordinate in which the emulator works.
std::vector<double> spans_of(std::span<const material::ParameterRange> ranges);

/// Predicted change of the features of one design.
struct FeatureChange {
  double log_toughness = 0.0;
  double log_peak = 0.0;
};

class FeatureEmulator {
 public:
  FeatureEmulator(std::vector<double> spans, std::size_t design_count);
  /// Learns from the trials, each with a prediction per design, seen from trials[centre]: only the nearest 60 are used.
  /// A failed prediction says nothing of its design.
  void learn(const std::vector<Trial>& trials, std::size_t centre);
  /// Change of the features of all designs between the centre and `point` (in unit coordinates).
  void predict(const Point& point, std::vector<FeatureChange>& changes) const;
  /// Standard deviation of that change; it does not depend on the design.
  double deviation(const Point& point) const;
  /// A point whose result is not known yet: deviations become small around it.
  void add_pending(const Point& point);

 private:
  Eigen::VectorXd coordinates(const Point& point) const;
  double covariance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  Eigen::VectorXd covariances(const Eigen::VectorXd& at) const;
  void factorise();

  std::vector<double> spans_;
  std::size_t design_count_;
  std::vector<Eigen::VectorXd> inputs_;  ///< learnt points, then pending ones
  Eigen::VectorXd centre_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd coefficients_;  ///< inputs x (2 designs), log T then log peak
  Eigen::RowVectorXd at_centre_;
};

/// Deviations of eta at trials[best] by the emulator's slopes of log T and log peak stress and the residuals of both;
/// those of Poisson's ratios are unknown when they were not searched.
std::vector<double> toughness_deviations(const FitData& data, const std::vector<Trial>& trials, std::size_t best,
                                         const std::vector<double>& spans, bool poisson_searched);

}  // namespace nacre::sysid
