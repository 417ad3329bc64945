#include "diagnosis/bootstrap.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace nacre::diagnosis {
namespace {

/// Whitened projector off the anchor's free coordinates: data rows, then the prior's rows.
class Projector {
 public:
  Projector(const Fit& fit, const Whitener& whitener) : fit_(fit), whitener_(whitener) {
    const Eigen::MatrixXd a = fit.whitened_columns(whitener);
    q_ = a.householderQr().householderQ() * Eigen::MatrixXd::Identity(a.rows(), a.cols());
  }
  /// Residual of data against the anchor, refitted.
  Eigen::VectorXd residual(const Eigen::VectorXd& y) const { return off(fit_.whitened_residual(y, whitener_)); }
  Eigen::VectorXd whitened(const Eigen::VectorXd& change) const {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(change.size() + fit_.base_count);
    b.head(change.size()) = whitener_(change);
    return b;
  }
  Eigen::VectorXd projected(const Eigen::VectorXd& change) const { return off(whitened(change)); }

 private:
  Eigen::VectorXd off(const Eigen::VectorXd& b) const { return b - q_ * (q_.transpose() * b); }
  const Fit& fit_;
  const Whitener& whitener_;
  Eigen::MatrixXd q_;
};

/// Chi-square variate with `dof` degrees of freedom.
double chi_square(int dof, RandomStream& random) {
  double sum = 0.0;
  for (int i = 0; i < dof; ++i) sum += std::pow(random.normal(), 2);
  return sum;
}

}  // namespace

double DrawStatistics::largest_drop() const { return drops.empty() ? 0.0 : *std::max_element(drops.begin(), drops.end()); }

double DrawStatistics::largest_contrast() const {
  return contrasts.empty() ? 0.0 : *std::max_element(contrasts.begin(), contrasts.end());
}

DataSource::DataSource(const Observations& observations)
    : parts_(observations.covariance_parts()), factor_(parts_.total({1.0, 1.0, 1.0}).llt().matrixL()) {
  for (std::size_t t = 0; t < dof_.size(); ++t) dof_[t] = observations.scatter[t].dof;
}

NoisyData DataSource::draw(const Eigen::VectorXd& truth, RandomStream& random) const {
  Eigen::VectorXd noise(truth.size());
  for (double& value : noise) value = random.normal();
  ScatterFactors factors;
  for (std::size_t t = 0; t < dof_.size(); ++t) factors[t] = dof_[t] > 0 ? chi_square(dof_[t], random) / dof_[t] : 1.0;
  return {truth + factor_ * noise, Whitener(parts_.total(factors))};
}

DrawStatistics anchor_statistics(const Anchor& anchor, const NoisyData& data) {
  const Projector projector(anchor.fit, data.whitener);
  const Eigen::VectorXd residual = projector.residual(data.values);
  DrawStatistics statistics;
  statistics.chi2 = residual.squaredNorm();
  for (const Signature& signature : anchor.signatures) {
    double best = 0.0;
    for (const Eigen::VectorXd& change : signature.changes) {
      const Eigen::VectorXd g = projector.projected(change);
      const double length = g.squaredNorm(), along = g.dot(residual);
      if (length < 1e-12 || (signature.one_sided && along < 0.0)) continue;
      best = std::max(best, along * along / length);
    }
    statistics.drops.push_back(best);
  }
  for (const ContrastDirection& direction : anchor.directions) {
    // The direction is given in the features' own units; whitened and projected it is the contrast that noise scatters with unit variance.
    const Eigen::VectorXd g = projector.projected(direction.values);
    const double length = g.norm();
    // What the anchor imitates almost entirely says nothing about it.
    const bool visible = length > 0.1 * projector.whitened(direction.values).norm();
    statistics.contrasts.push_back(visible ? std::abs(g.dot(residual)) / length : 0.0);
  }
  return statistics;
}

std::vector<DrawStatistics> bootstrap_anchor(const Anchor& anchor, const Observations& observations, int count, std::uint64_t seed) {
  std::vector<DrawStatistics> draws(static_cast<std::size_t>(count));
  const DataSource source(observations);
  parallel_for(count, [&](int i) {
    RandomStream random(seed, "anchor/" + std::to_string(i));
    draws[static_cast<std::size_t>(i)] = anchor_statistics(anchor, source.draw(anchor.fit.predicted, random));
  });
  return draws;
}

RivalStatistics bootstrap_rival(const std::vector<Fit>& rivals, std::size_t truth, const Observations& observations, int count,
                                std::uint64_t seed) {
  RivalStatistics statistics{std::vector<double>(static_cast<std::size_t>(count)), std::vector<double>(static_cast<std::size_t>(count))};
  const DataSource source(observations);
  parallel_for(count, [&](int i) {
    RandomStream random(seed, "rival/" + std::to_string(truth) + "/" + std::to_string(i));
    const NoisyData data = source.draw(rivals[truth].predicted, random);
    const double own = linear_refit(rivals[truth], data.values, data.whitener);
    double best_other = own;
    for (std::size_t k = 0; k < rivals.size(); ++k) {
      if (k != truth) best_other = std::min(best_other, linear_refit(rivals[k], data.values, data.whitener));
    }
    statistics.chi2[static_cast<std::size_t>(i)] = own;
    statistics.lead_of_best_other[static_cast<std::size_t>(i)] = own - best_other;
  });
  return statistics;
}

double exceedance(const std::vector<double>& draws, double observed) {
  const auto larger = std::count_if(draws.begin(), draws.end(), [&](double draw) { return draw >= observed; });
  return (1.0 + static_cast<double>(larger)) / (1.0 + static_cast<double>(draws.size()));
}

SignatureSize signature_size(const Fit& anchor, const Eigen::VectorXd& change, const Whitener& whitener) {
  const Projector projector(anchor, whitener);
  return {projector.whitened(change).norm(), projector.projected(change).norm()};
}

Eigen::MatrixXd projected_signatures(const Fit& anchor, const std::vector<Eigen::VectorXd>& changes, const Whitener& whitener) {
  const Projector projector(anchor, whitener);
  Eigen::MatrixXd columns(anchor.predicted.size() + anchor.base_count, static_cast<Eigen::Index>(changes.size()));
  for (std::size_t k = 0; k < changes.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = projector.projected(changes[k]);
  return columns;
}

}  // namespace nacre::diagnosis
