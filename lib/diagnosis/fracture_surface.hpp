#pragma once
// Features of fracture tests as functions of the parameters, learnt from runs around a fit: a fracture costs a second,
// a bootstrap asks for thousands.
//
// Gaussian processes (Higdon et al. 2008, doi:10.1198/016214507000000888): of each feature the mean over the
// groups and further principal components, each with a covariance of its own, since what many groups do alike is known
// better than what one does; and what these leave of each group, with one covariance for all. A covariance has an
// offset, a linear and a curved part over the logarithms of eta, one part per effect that vanishes where the effect
// does, and noise: a crack jumps from one path to another. Effects of the machine need no emulator: they are applied to
// the curves of the nearest runs.

#include <Eigen/Dense>
#include <map>
#include <vector>

#include "diagnosis/fracture_tests.hpp"

namespace nacre::diagnosis {

/// One row of the data that is a feature of a fracture group.
struct SurfaceRow {
  int row = 0;    ///< index in Observations::rows
  int group = 0;  ///< index in FractureTests::groups()
  Feature feature = Feature::log_toughness;
  bool is_bulk = false;  ///< of a notched homogeneous specimen
};

/// Covariance of the changes by one effect, between two points given by its strengths (-1 to 1; further parameters
/// behind): zero without the effect, linear and curved in its size.
double effect_covariance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const EmulatorRules& rules);

/// Error of expectations over specimens, independent between the columns of `shared`.
struct ErrorOfMean {
  Eigen::VectorXd own;     ///< variance per row, of what no other row has in common with it
  Eigen::MatrixXd shared;  ///< rows x components, one standard deviation each
  Eigen::VectorXd variance() const { return own + shared.rowwise().squaredNorm(); }
};

class FractureSurface {
 public:
  /// Learns the rows of the observations that are features of fracture tests from all runs of their `groups`
  /// (FractureTests::groups()). O(runs^3) per feature.
  FractureSurface(const Observations& observations, const std::vector<int>& groups, std::vector<FractureRun> runs,
                  const material::ToughnessParameters& centre, const EmulatorRules& rules);
  const std::vector<SurfaceRow>& rows() const { return rows_; }
  /// Features at a parameter set, measurement side included, one per row().
  Eigen::VectorXd predict(const material::ParameterSet& set) const;
  /// Change by the machine from one batch to the next, averaged over the groups.
  FeatureValues batch_step(const material::ParameterSet& set) const;
  /// Mean square error of leaving a run out, per row: over the half of the runs nearest to the centre. A run is one
  /// specimen's crack: its own scatter is in it.
  const Eigen::VectorXd& run_variance() const { return run_variance_; }
  const std::vector<FractureRun>& runs() const { return runs_; }
  /// How far runs() that are left out lie off in the rows of a feature of layouts, but for what these have in common:
  /// runs x rows.
  Eigen::MatrixXd own_errors(Feature feature) const;
  /// Error of the expectation over specimens that predict() gives at a parameter set, per row: the posterior one of the
  /// processes, scaled so that errors at runs that were left out are what they expect. Small where many runs are near.
  ErrorOfMean error_of_mean(const material::ParameterSet& set) const;

 private:
  struct SurfacePoint {
    Eigen::VectorXd log_eta;
    std::map<int, Eigen::VectorXd> effects;  ///< strengths, by index in the library
  };
  struct Kernel {
    double linear = 1.0, curved = 1.0, noise = 1.0;
    std::map<int, double> effect;  ///< amplitude by library index
    double own_share = 0.0;        ///< of an effect's variance that depends on eta
  };
  /// Numbers of a run, columns, that have one covariance: a principal component, or what is left of every row.
  struct Learnt {
    Kernel kernel;
    Eigen::RowVectorXd mean;
    Eigen::MatrixXd weights;             ///< runs x columns
    Eigen::LLT<Eigen::MatrixXd> factor;  ///< of the covariance of the runs, in units of the columns' spread
    Eigen::MatrixXd left_out;            ///< runs x columns: error at a run that is left out
    Eigen::VectorXd run_variance;        ///< its mean square over runs near the centre, per column
    Eigen::VectorXd variance_scale;      ///< of the process to these errors, per column
  };
  struct LearntFeature {
    std::vector<int> rows;  ///< indices into rows_
    Eigen::MatrixXd basis;  ///< rows x components, orthonormal
    std::vector<Learnt> components;
    Learnt rest;  ///< a column per row
  };
  SurfacePoint point_of(const material::ParameterSet& set) const;
  double covariance(const Kernel& kernel, const SurfacePoint& a, const SurfacePoint& b) const;
  Eigen::VectorXd covariance_with_runs(const Kernel& kernel, const SurfacePoint& at) const;
  Eigen::MatrixXd covariance_matrix(const Kernel& kernel, const std::vector<int>& at) const;
  /// The most probable amplitudes given the runs of the base model; targets are of unit spread.
  Kernel likeliest_kernel(const std::vector<int>& at, const Eigen::MatrixXd& targets) const;
  /// -log likelihood of the runs under a covariance, up to a constant.
  double surprise(const Kernel& kernel, const std::vector<int>& at, const Eigen::MatrixXd& targets) const;
  /// How much of the effects depends on eta, given their amplitudes and all runs.
  double likeliest_share(Kernel kernel, const Eigen::MatrixXd& targets) const;
  std::vector<int> all_runs() const;
  std::vector<int> half_nearest_to_the_centre() const;
  std::vector<int> base_runs() const;
  LearntFeature learn_feature(std::vector<int> rows, const Eigen::MatrixXd& values) const;
  Learnt learn_columns(const Eigen::MatrixXd& values) const;
  void learn_effects(Learnt& learnt, const Eigen::MatrixXd& centred) const;
  Eigen::RowVectorXd predicted(const Learnt& learnt, const SurfacePoint& at) const;
  Eigen::VectorXd variance_of_mean(const Learnt& learnt, const SurfacePoint& at) const;
  Eigen::VectorXd machine_change(const material::ParameterSet& set, const SurfacePoint& at) const;

  void learn();

  CurveReading reading_;
  std::vector<double> batch_steps_;  ///< per group
  std::vector<FractureRun> runs_;
  material::ToughnessVector centre_;
  EmulatorRules rules_;
  std::vector<SurfaceRow> rows_;
  std::vector<SurfacePoint> points_;
  std::vector<LearntFeature> learnt_;
  Eigen::VectorXd run_variance_;
};

}  // namespace nacre::diagnosis
