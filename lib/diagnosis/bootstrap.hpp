#pragma once
// Parametric bootstrap of the whole decision: data are drawn from a fitted model with the noise of the actual design
// (replicate scatter re-estimated in every draw, discretisation floor), and everything is refitted on linearised
// models.

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/signatures.hpp"

namespace nacre::diagnosis {

/// Statistics of one data set against an anchor model.
struct DrawStatistics {
  double chi2 = 0.0;              ///< of the anchor, refitted
  std::vector<double> parts;      ///< of chi2 (Anchor::parts)
  std::vector<double> drops;      ///< by how much each signature lowers it
  std::vector<double> contrasts;  ///< projected residual along each direction, in standard deviations
  double largest_drop() const;
  double largest_contrast() const;
};

/// An anchor model with the effects that may be added to it and the directions along which its residuals are compared.
struct Anchor {
  FittedModel fit;
  std::vector<Signature> signatures;
  std::vector<ContrastDirection> directions;
  std::vector<std::size_t> parts;  ///< of each row: chi2 is also computed part by part
};

/// Parts that are independent of each other, of each row: moduli, fracture tests, coupons' history, and behind them
/// coupons of one material each and the constants of layouts against those of coupons, in the order of the rows. Rows
/// of one part share a scatter.
std::vector<std::size_t> parts_of_rows(const Observations& observations);

/// Data with their noise model: the values of the rows and the covariance estimated from these data themselves.
struct NoisyData {
  Eigen::VectorXd values;
  Whitener whitener;
};

/// Draws data sets of the actual design as if a truth were exact, in combinations of rows that stay independent
/// whatever scatter the replicates of a draw suggest: those that diagonalise scatter and total covariance at once. A
/// draw costs O(rows), where the rows themselves would need a Cholesky factorisation each.
class DataSource {
 public:
  explicit DataSource(const Observations& observations);
  /// Columns over the rows, as columns over the combinations.
  Eigen::MatrixXd combined(const Eigen::MatrixXd& columns) const { return to_combinations_ * columns; }
  FittedModel combined(FittedModel fit) const;
  Anchor combined(Anchor anchor) const;
  /// Variances of the combinations where replicates scatter by these factors; 1 where all factors are 1.
  Eigen::VectorXd variances(const ScatterFactors& factors) const;
  /// `truth` over the combinations.
  NoisyData draw(const Eigen::VectorXd& truth, RandomStream& random) const;

 private:
  /// The true scatter, over the one that is assumed where there are no replicates.
  ScatterFactors draw_true_factors(RandomStream& random) const;
  /// The scatter that as many replicates may estimate, over the true one.
  ScatterFactors draw_factors(RandomStream& random) const;

  Eigen::MatrixXd to_combinations_;       ///< makes the covariance the identity and every scatter diagonal
  Eigen::VectorXd scatter_share_;         ///< of a combination's variance that is replicate scatter
  std::vector<std::size_t> scatter_;      ///< of a combination: index in Observations::scatter
  std::vector<std::size_t> parts_;        ///< of a combination
  std::vector<std::pair<int, int>> dof_;  ///< of each scatter, and how many more are assumed
  std::vector<int> worth_;                ///< of each scatter that is only assumed, degrees of freedom; else 0
};

/// Statistics of data against the anchor, by linear refits. A direction of which the anchor leaves less than the share
/// `imitated` has no contrast with it.
DrawStatistics anchor_statistics(const Anchor& anchor, const NoisyData& data, double imitated);

/// `count` draws of the statistics when the anchor is true; the same for every number of cores.
std::vector<DrawStatistics> bootstrap_anchor(const Anchor& anchor, const Observations& observations, double imitated,
                                             int count, std::uint64_t seed);

/// Statistics of rival models when `rivals[truth]` is true: chi2 of that rival, and by how much the best other one
/// beats it.
struct RivalStatistics {
  std::vector<double> chi2;
  std::vector<double> lead_of_best_other;
};
RivalStatistics bootstrap_rival(const std::vector<FittedModel>& rivals, std::size_t truth,
                                const Observations& observations, int count, std::uint64_t seed);

/// (1 + number of draws at least as large) / (1 + draws).
double exceedance(const std::vector<double>& draws, double observed);

/// The largest value that is not rare enough: whatever is larger has an exceedance of at most `level`. At least
/// 1 / `level` draws.
double threshold(std::vector<double> draws, double level);

/// Chance of a chi2 as large, of the whole or of the part that stands out most: a part that noise explains generously
/// must not hide the misfit of another one. Family-wise over whole and parts.
double omnibus_chance(const std::vector<DrawStatistics>& draws, const DrawStatistics& observed);

/// The part of chi squared that is larger than draws have it, most times over: an index into DrawStatistics::parts.
std::size_t loudest_part(const std::vector<DrawStatistics>& draws, const DrawStatistics& observed);

/// Norm of a signature after whitening (its signal-to-noise ratio), and after projection off what the anchor's
/// coordinates can imitate.
struct SignatureSize {
  double whitened = 0.0;
  double projected = 0.0;
  /// Share that the anchor imitates: 1 - projected^2 / whitened^2.
  double absorption() const { return whitened > 0.0 ? 1.0 - projected * projected / (whitened * whitened) : 1.0; }
};
SignatureSize signature_size(const FittedModel& anchor, const Eigen::VectorXd& change, const Whitener& whitener);
/// Signatures as columns, whitened and projected off the anchor's tangent space.
Eigen::MatrixXd projected_signatures(const FittedModel& anchor, const Eigen::MatrixXd& changes,
                                     const Whitener& whitener);

}  // namespace nacre::diagnosis
