#pragma once
// The data of a diagnosis as rows with covariance: scatter / replicates + discretisation error + emulator error.

#include <Eigen/Dense>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/features.hpp"
#include "diagnosis/fracture_discretisation.hpp"
#include "diagnosis/material_constants.hpp"
#include "diagnosis/procedure.hpp"
#include "measurement/specimen_record.hpp"
#include "measurement/surroundings.hpp"
#include "tester/loading.hpp"

namespace nacre::diagnosis {

/// One group of replicate specimens: a design under one test, one set of conditions and in the same surroundings.
/// Coupons that were unloaded on their way are a group of their own.
struct Observation {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  measurement::Surroundings surroundings = {};  ///< of the first replicate
  int machine = 0;                              ///< its number in the order of the names of all machines, from 0
  int material_number = -1;                     ///< the same among homogeneous materials; -1: none of these
  bool unloaded = false;                        ///< a coupon that was unloaded on its way
  tester::Loading pauses = {};                  ///< the programme of one with pauses; its curve ends at the turn
  std::optional<double> read_up_to = {};        ///< of unloaded ones: the strain that all replicates reach
  FeatureValues features;                       ///< means over the valid replicates
  int replicates = 0;                           ///< pieces: tests of one piece count once
  std::vector<std::string> pieces;              ///< sorted
  std::map<std::string, int> batches;           ///< pieces of each, where noted
  double print_order = 0.0;                     ///< mean, 0 when unknown
  double batch_step = 0.0;                      ///< mean number of the batch, the first is 0
  tester::Curve curve;           ///< of the replicate whose peak is the middle one; empty when none was recorded
  std::string material() const;  ///< "layout" or the name of the homogeneous material
};

/// A homogeneous specimen with a notch.
bool is_notched_bulk(const Observation& group);

/// Which statistic of the specimens a row is.
enum class RowKind {
  mean,         ///< mean of a feature over a group's replicates
  batch,        ///< change of a feature per batch step between replicates of one group, over all groups
  batch_rest,   ///< how far one batch lies off that change, again between replicates of one group
  print_order,  ///< change per specimen printed, inside batches
  scatter,      ///< log of the standard deviation of a feature between replicates of layouts
  constant,     ///< log of E of a base material in layouts over E of its homogeneous specimens, expected to be 0
};

/// One row of the data.
struct DataRow {
  int group = -1;  ///< index of the group; -1 with rows of history, which join all groups
  Feature feature = Feature::log_modulus;
  RowKind kind = RowKind::mean;
  tester::TestKind test = tester::TestKind::modulus;
  double weight = 1.0;      ///< variance of the row over that of a single specimen: 1/replicates of a mean
  std::size_t scatter = 0;  ///< the scatter of its replicates: index in Observations::scatter
  int batch = 0;            ///< with batch_rest: which batch, in the order of their numbers
  int material = 0;         ///< with constant: index in kConstantMaterials
};

/// Change of the rows of history if all specimens of one batch have a feature larger by one.
struct BatchOffset {
  std::string batch;
  Feature feature = Feature::log_modulus;
  tester::TestKind test = tester::TestKind::modulus;
  Eigen::VectorXd rows;
  bool is_off_change = false;  ///< it may lie off a steady change over the batches: there are three and more
};

/// Turns differences of features into uncorrelated ones of unit variance: multiplies by the inverse Cholesky factor of
/// the covariance.
class Whitener {
 public:
  /// Throws std::runtime_error when the matrix is not finite and positive definite: no statement about such data would
  /// mean anything.
  explicit Whitener(const Eigen::MatrixXd& covariance);
  /// Of rows that are independent, with these standard deviations.
  static Whitener independent(const Eigen::VectorXd& standard_deviations);
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& differences) const {
    if (scale_.size() > 0) return scale_.asDiagonal() * differences;
    return factor_.matrixL().solve(differences);
  }
  /// The squared length of the whitened vector.
  double chi2(const Eigen::VectorXd& differences) const { return (*this)(differences).squaredNorm(); }
  Eigen::MatrixXd covariance() const {
    if (scale_.size() > 0) return scale_.cwiseAbs2().cwiseInverse().asDiagonal();
    return factor_.reconstructedMatrix();
  }

 private:
  Whitener() = default;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd scale_;  ///< inverse standard deviations of independent rows; empty: the factor counts
};

/// Scatter of replicates of one kind: pooled over its groups, correlations shrunk towards none.
struct ReplicateScatter {
  Eigen::MatrixXd covariance;  ///< features x features
  int dof = 0;                 ///< degrees of freedom behind it; 0: assumed
  int assumed_dof = 0;         ///< further ones that are assumed
  int worth = 0;               ///< of a scatter without replicates: degrees of freedom that it is worth
  int piece_dof = 0;           ///< of pieces alone: `dof` counts each as often as it was tested
  double piece_share = 0.0;    ///< of the variance, what a piece keeps from one group to another that it is also in
};

/// The effect that makes replicates of layouts scatter more in toughness.
inline constexpr std::string_view kStrengthScatter = "strength_scatter";

/// Variance of log T between replicates of layouts: of their cracks, which the simulator has too, and of what scales
/// all stresses of a specimen (its thickness, its ink), which shows in the slopes before anything breaks.
struct CrackScatter {
  double of_cracks = 0.0;
  double of_specimens = 0.0;
  double growth = 0.0;          ///< of_cracks grows by so much per square of the size of `strength_scatter`
  double error_variance = 0.0;  ///< of log_sd() against the measured one
  double log_sd(double strength_scatter) const;
};

/// Factors on the replicate variances, in the order of Observations::scatter.
using ScatterFactors = std::vector<double>;

/// The covariance of two rows, split: scatter between replicates, and the rest.
struct RowCovariance {
  double fixed = 0.0, scatter = 0.0;
};

/// The same of all rows. Rows of different scatter are independent in both parts.
struct CovarianceParts {
  Eigen::MatrixXd fixed;
  Eigen::MatrixXd scatter;
};

/// The data of a measurement set: groups sorted by test, design and conditions; rows by group and feature, then those
/// of history.
struct Observations {
  CurveReading reading;      ///< of its curves, and of those that a model predicts for it
  double constant_sd = 0.0;  ///< of a row of RowKind::constant
  std::vector<Observation> groups;
  std::vector<DataRow> rows;
  Eigen::VectorXd values;  ///< per row
  /// By TestKind, and behind them coupons of one material each: soft ones are pulled farther than rigid ones, and
  /// scatter otherwise.
  std::vector<ReplicateScatter> scatter = std::vector<ReplicateScatter>(3);
  double discretisation_sd = 0.0;                  ///< per layout, of log E, independent between layouts
  FractureDiscretisation fracture_discretisation;  ///< the same of the features of a fracture test
  Eigen::MatrixXd fracture_change;                 ///< rows x 1: of fracture tests, what finer elements change at the
                                                   ///< calibration; the discretisation error is so much, more or less
  Eigen::MatrixXd discretisation_shared;           ///< rows x directions: discretisation error along each, one
                                                   ///< standard deviation; may be empty
  Eigen::MatrixXd bulk_constants;                  ///< rows x constants: of notched homogeneous specimens beside
                                                   ///< layouts, whose constants are effective ones, the same
  Eigen::MatrixXd levels;                          ///< rows x free levels of factors (factors.hpp), the same
  std::optional<CrackScatter> crack_scatter;       ///< where a row of RowKind::scatter says how much they scatter
  Eigen::VectorXd emulator_variance;               ///< per row; empty: none (emulator_covariance())
  Eigen::MatrixXd emulator_shared;                 ///< rows x directions: errors that rows of a feature have in common
  int disconnected_batches = 0;       ///< sets of batches without a common design under equal conditions; 0: no batches
  double last_batch_step = 0.0;       ///< of all specimens; 0: there is one batch, or none is known
  std::vector<std::string> machines;  ///< their names, sorted
  std::vector<std::string> materials;      ///< names of homogeneous ones, sorted
  std::vector<BatchOffset> batch_offsets;  ///< of every batch that replicates of one group tell
  int size() const { return rows.size(); }
  const Observation& group_of(int row) const { return groups[rows[row].group]; }
  bool has(tester::TestKind test) const;
  bool has_shared_discretisation() const { return discretisation_shared.rows() == size(); }
  /// Directions along which all rows go together: the shared discretisation error, and free levels.
  Eigen::MatrixXd shared_directions() const;
  /// Degrees of freedom behind the scatter of a test's replicates; 0: there are none, or no such test.
  int replicate_dof(tester::TestKind test) const { return scatter[static_cast<std::size_t>(test)].dof; }
  double replicate_sd(Feature feature, tester::TestKind test) const;
  /// Covariance of the means of two groups, because some pieces are in both.
  double piece_covariance(int i, int j) const;
  /// Covariance of two rows, but for the shared directions and the emulator. The discretisation error is the same for
  /// all specimens of one layout under one test: rotated twins share it.
  RowCovariance row_covariance(int i, int j) const;
  /// Of the emulator's error: features of one group go together as they do between specimens, whose cracks it averages.
  Eigen::MatrixXd emulator_covariance() const;
  /// Covariance of the rows. Along the shared directions all rows go together.
  CovarianceParts covariance_parts() const;
  Eigen::MatrixXd covariance() const {
    const CovarianceParts parts = covariance_parts();
    return parts.fixed + parts.scatter;
  }
  /// Variances of the rows but for what they share, which predictions contain (expected_shared()).
  Eigen::VectorXd own_variances() const;
  /// The expected error along the shared directions, given residuals (measured - predicted) at `rows`; for all rows.
  Eigen::VectorXd expected_shared(const Eigen::VectorXd& residuals_at_rows,
                                  const std::vector<Eigen::Index>& rows) const;
};

/// Groups the valid specimens: moduli and fracture tests of layouts; of homogeneous ones moduli, and coupons pulled
/// with a curve. Where moduli of both kinds are there, a row for each base material says that their constants are
/// alike, and how much voxels may differ from the bulk (thesis 3.2.4).
Observations observe(const std::vector<measurement::SpecimenRecord>& specimens, double modulus_discretisation_sd,
                     const FractureDiscretisation& fracture, const Procedure& procedure);

/// The conditions of most upright specimens of a test; the default where there are none.
tester::TestConditions usual_conditions(const Observations& observations, tester::TestKind test);

}  // namespace nacre::diagnosis
