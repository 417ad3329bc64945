#include "diagnosis/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/parallel.hpp"

namespace nacre::diagnosis {
namespace {

/// Whitened projector off the anchor's free coordinates: data rows, then the prior's rows.
class Projector {
 public:
  Projector(const FittedModel& fit, const Whitener& whitener) : fit_(fit), whitener_(whitener) {
    const Eigen::MatrixXd a = fit.whitened_columns(whitener);
    q_ = a.householderQr().householderQ() * Eigen::MatrixXd::Identity(a.rows(), a.cols());
  }
  /// Residual of data against the anchor, refitted.
  Eigen::VectorXd residual(const Eigen::VectorXd& y) const { return off(fit_.whitened_residual(y, whitener_)); }
  /// Changes as columns.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& changes) const {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(changes.rows() + fit_.base_count, changes.cols());
    b.topRows(changes.rows()) = whitener_(changes);
    return b;
  }
  Eigen::MatrixXd projected(const Eigen::MatrixXd& changes) const { return off(whitened(changes)); }

 private:
  Eigen::MatrixXd off(const Eigen::MatrixXd& b) const { return b - q_ * (q_.transpose() * b); }
  const FittedModel& fit_;
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

double DrawStatistics::largest_drop() const {
  return drops.empty() ? 0.0 : *std::max_element(drops.begin(), drops.end());
}

double DrawStatistics::largest_contrast() const {
  return contrasts.empty() ? 0.0 : *std::max_element(contrasts.begin(), contrasts.end());
}

std::vector<std::size_t> parts_of_rows(const Observations& observations) {
  constexpr std::size_t kTests = 3;
  std::map<std::string, std::size_t> further;
  std::vector<std::size_t> parts;
  for (const DataRow& row : observations.rows) {
    parts.push_back(static_cast<std::size_t>(row.test));
    const bool of_coupons = row.group >= 0 && row.test == tester::TestKind::tensile;
    const bool of_own_scatter = row.scatter != static_cast<std::size_t>(row.test);
    if (!of_coupons && !of_own_scatter && row.kind != RowKind::constant) continue;
    std::string name = row.kind == RowKind::constant ? "constants"
                       : row.group < 0               ? "history"
                                                     : observations.groups[row.group].material();
    if (row.test == tester::TestKind::modulus && of_own_scatter) name = "moduli of " + name;
    if (row.test == tester::TestKind::toughness && row.group >= 0) name = "notched homogeneous specimens";
    parts.back() = further.emplace(name, kTests + further.size()).first->second;
  }
  return parts;
}

DataSource::DataSource(const Observations& observations)
    : to_combinations_(Eigen::MatrixXd::Zero(observations.size(), observations.size())),
      scatter_share_(observations.size()) {
  const CovarianceParts parts = observations.covariance_parts();
  const Eigen::MatrixXd total = parts.fixed + parts.scatter;
  for (const ReplicateScatter& scatter : observations.scatter) dof_.emplace_back(scatter.dof, scatter.assumed_dof);
  const std::vector<std::size_t> part_of = parts_of_rows(observations);
  std::map<std::size_t, std::vector<Eigen::Index>> rows_of_part;  // rows of one part share a scatter
  for (std::size_t i = 0; i < part_of.size(); ++i) rows_of_part[part_of[i]].push_back(static_cast<Eigen::Index>(i));
  Eigen::Index next = 0;
  for (const auto& [part, rows] : rows_of_part) {
    const auto count = static_cast<Eigen::Index>(rows.size());
    const Whitener whitener(total(rows, rows));
    // Whitened from both sides, the scatter is symmetric again, its eigenvalues the shares.
    const Eigen::MatrixXd half = whitener(parts.scatter(rows, rows));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> shares(whitener(half.transpose()));
    to_combinations_(Eigen::seqN(next, count), rows) =
        shares.eigenvectors().transpose() * whitener(Eigen::MatrixXd::Identity(count, count));
    scatter_share_.segment(next, count) = shares.eigenvalues();
    scatter_.insert(scatter_.end(), rows.size(), observations.rows[rows.front()].scatter);
    parts_.insert(parts_.end(), rows.size(), part);
    next += count;
  }
  worth_.resize(dof_.size());
  for (const std::size_t used : scatter_) worth_[used] = observations.scatter[used].worth;
}

FittedModel DataSource::combined(FittedModel fit) const {
  fit.predicted = combined(Eigen::MatrixXd(fit.predicted));
  fit.jacobian = combined(fit.jacobian);
  return fit;
}

Anchor DataSource::combined(Anchor anchor) const {
  anchor.fit = combined(std::move(anchor.fit));
  for (Signature& signature : anchor.signatures) {
    signature.changes = combined(signature.changes);
    if (signature.elsewhere.cols() > 0) signature.elsewhere = combined(signature.elsewhere);
  }
  for (ContrastDirection& direction : anchor.directions) direction.values = combined(Eigen::MatrixXd(direction.values));
  anchor.parts = parts_;
  return anchor;
}

ScatterFactors DataSource::draw_true_factors(RandomStream& random) const {
  ScatterFactors factors;
  for (const int worth : worth_) factors.push_back(worth > 0 ? worth / chi_square(worth, random) : 1.0);
  return factors;
}

ScatterFactors DataSource::draw_factors(RandomStream& random) const {
  ScatterFactors factors;
  for (const auto& [dof, assumed] : dof_)
    factors.push_back(dof > 0 ? (chi_square(dof, random) + assumed) / (dof + assumed) : 1.0);
  return factors;
}

Eigen::VectorXd DataSource::variances(const ScatterFactors& factors) const {
  Eigen::VectorXd variances(scatter_share_.size());
  for (Eigen::Index i = 0; i < variances.size(); ++i)
    variances[i] = 1.0 + (factors[scatter_[i]] - 1.0) * scatter_share_[i];
  return variances;
}

NoisyData DataSource::draw(const Eigen::VectorXd& truth, RandomStream& random) const {
  Eigen::VectorXd values = truth;
  const Eigen::VectorXd true_variances = variances(draw_true_factors(random));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] += std::sqrt(true_variances[i]) * random.normal();
  return {std::move(values), Whitener::independent(variances(draw_factors(random)).cwiseSqrt())};
}

DrawStatistics anchor_statistics(const Anchor& anchor, const NoisyData& data, double imitated) {
  const Projector projector(anchor.fit, data.whitener);
  const Eigen::VectorXd residual = projector.residual(data.values);
  DrawStatistics statistics;
  statistics.chi2 = residual.squaredNorm();
  for (std::size_t i = 0; i < anchor.parts.size(); ++i) {
    statistics.parts.resize(std::max(statistics.parts.size(), anchor.parts[i] + 1));
    statistics.parts[anchor.parts[i]] += std::pow(residual[i], 2);
  }
  for (const Signature& signature : anchor.signatures) {
    double best = 0.0;
    for (const Eigen::MatrixXd* changes : {&signature.changes, &signature.elsewhere}) {
      if (changes->cols() == 0) continue;
      const Eigen::MatrixXd g = projector.projected(*changes);
      for (const auto& column : g.colwise()) {
        const double length = column.squaredNorm(), along = column.dot(residual);
        if (length < 1e-12 || (signature.one_sided && along < 0.0)) continue;
        best = std::max(best, along * along / length);
      }
    }
    statistics.drops.push_back(best);
  }
  // Directions are given in the features' own units; whitened and projected they are contrasts that noise scatters with
  // unit variance.
  Eigen::MatrixXd directions(data.values.size(), static_cast<Eigen::Index>(anchor.directions.size()));
  for (Eigen::Index k = 0; k < directions.cols(); ++k) directions.col(k) = anchor.directions[k].values;
  const Eigen::MatrixXd whitened = projector.whitened(directions), g = projector.projected(directions);
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    const double length = g.col(k).norm();
    const bool visible = length > imitated * whitened.col(k).norm();
    statistics.contrasts.push_back(visible ? std::abs(g.col(k).dot(residual)) / length : 0.0);
  }
  return statistics;
}

std::vector<DrawStatistics> bootstrap_anchor(const Anchor& anchor, const Observations& observations, double imitated,
                                             int count, std::uint64_t seed) {
  std::vector<DrawStatistics> draws(count);
  const DataSource source(observations);
  const Anchor combined = source.combined(anchor);
  parallel_for(count, [&](int i) {
    RandomStream random(seed, "anchor/" + std::to_string(i));
    draws[i] = anchor_statistics(combined, source.draw(combined.fit.predicted, random), imitated);
  });
  return draws;
}

RivalStatistics bootstrap_rival(const std::vector<FittedModel>& rivals, std::size_t truth,
                                const Observations& observations, int count, std::uint64_t seed) {
  RivalStatistics statistics{std::vector<double>(count), std::vector<double>(count)};
  const DataSource source(observations);
  std::vector<FittedModel> combined;
  for (const FittedModel& rival : rivals) combined.push_back(source.combined(rival));
  parallel_for(count, [&](int i) {
    RandomStream random(seed, "rival/" + std::to_string(truth) + "/" + std::to_string(i));
    const NoisyData data = source.draw(combined[truth].predicted, random);
    const double own = linear_refit(combined[truth], data.values, data.whitener);
    double best_other = own;
    for (std::size_t k = 0; k < combined.size(); ++k) {
      if (k != truth) best_other = std::min(best_other, linear_refit(combined[k], data.values, data.whitener));
    }
    statistics.chi2[i] = own;
    statistics.lead_of_best_other[i] = own - best_other;
  });
  return statistics;
}

double exceedance(const std::vector<double>& draws, double observed) {
  const auto larger = std::count_if(draws.begin(), draws.end(), [&](double draw) { return draw >= observed; });
  return (1.0 + static_cast<double>(larger)) / (1.0 + static_cast<double>(draws.size()));
}

double threshold(std::vector<double> draws, double level) {
  const auto allowed = static_cast<std::size_t>(level * static_cast<double>(draws.size() + 1)) - 1;
  std::ranges::sort(draws, std::greater<>());
  return draws[allowed];
}

double omnibus_chance(const std::vector<DrawStatistics>& draws, const DrawStatistics& observed) {
  std::vector<double> least(draws.size(), 1.0);
  double least_observed = 1.0;
  const auto join = [&](const auto& value) {
    std::vector<double> sorted;
    for (const DrawStatistics& draw : draws) sorted.push_back(value(draw));
    std::ranges::sort(sorted);
    const auto share_above = [&](double x) {
      return static_cast<double>(sorted.end() - std::ranges::lower_bound(sorted, x)) /
             static_cast<double>(sorted.size());
    };
    for (std::size_t i = 0; i < draws.size(); ++i) least[i] = std::min(least[i], share_above(value(draws[i])));
    least_observed = std::min(least_observed, share_above(value(observed)));
  };
  join([](const DrawStatistics& d) { return d.chi2; });
  for (std::size_t k = 0; k < observed.parts.size(); ++k) join([k](const DrawStatistics& d) { return d.parts[k]; });
  // The smaller, the rarer.
  for (double& chance : least) chance = -chance;
  return exceedance(least, -least_observed);
}

std::size_t loudest_part(const std::vector<DrawStatistics>& draws, const DrawStatistics& observed) {
  std::size_t loudest = 0;
  double most = 0.0;
  for (std::size_t k = 0; k < observed.parts.size(); ++k) {
    double sum = 0.0;
    for (const DrawStatistics& draw : draws) sum += draw.parts[k];
    const double times = sum > 0.0 ? observed.parts[k] * static_cast<double>(draws.size()) / sum : 0.0;
    if (times > most) most = times, loudest = k;
  }
  return loudest;
}

SignatureSize signature_size(const FittedModel& anchor, const Eigen::VectorXd& change, const Whitener& whitener) {
  const Projector projector(anchor, whitener);
  return {projector.whitened(change).norm(), projector.projected(change).norm()};
}

Eigen::MatrixXd projected_signatures(const FittedModel& anchor, const Eigen::MatrixXd& changes,
                                     const Whitener& whitener) {
  return Projector(anchor, whitener).projected(changes);
}

}  // namespace nacre::diagnosis
