#include "diagnosis/discrepancy_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

#include "base/parallel.hpp"

namespace nacre::diagnosis {
namespace {

/// Mean of `matrix`'s diagonal over the rows of each kind (feature, test, probe) is brought to `noise`'s.
Eigen::MatrixXd in_units_of(const Eigen::MatrixXd& noise, Eigen::MatrixXd matrix, const Observations& observations) {
  std::map<std::tuple<Feature, tester::TestKind, RowKind>, std::pair<double, double>> sums;
  const auto kind = [&](int i) {
    const DataRow& row = observations.rows[i];
    return std::tuple(row.feature, row.test, row.kind);
  };
  for (int i = 0; i < observations.size(); ++i)
    sums[kind(i)].first += matrix(i, i), sums[kind(i)].second += noise(i, i);
  Eigen::VectorXd scale(observations.size());
  for (int i = 0; i < observations.size(); ++i) {
    const auto& [own, wanted] = sums[kind(i)];
    scale[i] = own > 0.0 ? std::sqrt(wanted / own) : 0.0;
  }
  return scale.asDiagonal() * matrix * scale.asDiagonal();
}

/// One data set with the anchor's coordinates integrated out, under one covariance of the noise. The prior of constants
/// is Gaussian; that of an effect has the variance of its range, about the fit.
struct Marginal {
  Eigen::LLT<Eigen::MatrixXd> factor;  ///< of the covariance of the noise and of the base's prior predictions
  Eigen::VectorXd residual;            ///< from the middle of the prior, whitened
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns) const { return factor.matrixL().solve(columns); }
};

Marginal marginal(const FittedModel& base, const NoisyData& data) {
  Eigen::VectorXd residual = data.values - base.predicted;
  Eigen::MatrixXd covariance = data.whitener.covariance();
  for (const int i : base.free) {
    const Eigen::VectorXd column = base.jacobian.col(i);
    const bool is_constant = i < base.base_count;
    if (is_constant) residual -= column * (0.5 - base.u[i]);
    const double variance =
        is_constant ? std::pow(base.prior_sd[i], 2) : std::pow(base.upper[i] - base.lower[i], 2) / 12.0;
    covariance += variance * column * column.transpose();
  }
  Marginal result{covariance.llt(), {}};
  result.residual = result.whitened(residual);
  return result;
}

/// Columns whose outer products sum up to a covariance: those of its eigenvectors that are not rounding.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& covariance) {
  constexpr double kRounding = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(covariance);
  const Eigen::VectorXd& values = parts.eigenvalues();  // rising
  const Eigen::Index count = (values.array() > kRounding * values[values.size() - 1]).count();
  return parts.eigenvectors().rightCols(count) * values.tail(count).cwiseSqrt().asDiagonal();
}

struct Amplitude {
  double value = 0.0;
  double deviance = 0.0;  ///< -2 log likelihood, less the logarithmic determinant of the covariance without discrepancy
};

/// The most probable amplitude of a discrepancy, given the root of its covariance. All are tried: where rows of unlike
/// scatter meet, the likelihood may have several maxima. By the Woodbury identity, since few directions make it up.
Amplitude most_probable(const Marginal& data, const Eigen::MatrixXd& root, std::span<const double> amplitudes) {
  const Eigen::MatrixXd directions = data.whitened(root);
  const Eigen::MatrixXd products = directions.transpose() * directions;
  const Eigen::VectorXd along = directions.transpose() * data.residual;
  const auto identity = Eigen::MatrixXd::Identity(products.rows(), products.cols());
  Amplitude best{0.0, data.residual.squaredNorm()};
  for (const double amplitude : amplitudes) {
    const double square = amplitude * amplitude;
    const Eigen::LLT<Eigen::MatrixXd> factor(identity + square * products);
    const double determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    const double deviance =
        data.residual.squaredNorm() - square * factor.matrixL().solve(along).squaredNorm() + determinant;
    if (deviance < best.deviance) best = {amplitude, deviance};
  }
  return best;
}

/// The least chi2 that `count` effects reach on these data, added one by one along their signatures.
double best_chi2(const Marginal& data, const std::vector<Signature>& signatures, int count) {
  Eigen::VectorXd residual = data.residual;
  std::vector<Eigen::VectorXd> taken;
  for (int step = 0; step < count; ++step) {
    double best = 0.0;
    Eigen::VectorXd along_best;
    for (const Signature& signature : signatures) {
      const Eigen::MatrixXd whitened = data.whitened(signature.changes);
      for (Eigen::Index i = 0; i < whitened.cols(); ++i) {
        Eigen::VectorXd g = whitened.col(i);
        for (const Eigen::VectorXd& other : taken) g -= other * other.dot(g);
        const double length = g.norm(), along = length > 1e-6 ? g.dot(residual) / length : 0.0;
        if ((signature.one_sided && along < 0.0) || along * along <= best) continue;
        best = along * along;
        along_best = g / length;
      }
    }
    if (best == 0.0) break;
    residual -= along_best * along_best.dot(residual);
    taken.push_back(along_best);
  }
  return residual.squaredNorm();
}

}  // namespace

Eigen::MatrixXd discrepancy_covariance(const Observations& observations,
                                       const std::vector<ContrastDirection>& directions, const Eigen::MatrixXd& noise,
                                       double along_contrasts) {
  Eigen::MatrixXd along = Eigen::MatrixXd::Zero(observations.size(), observations.size()), own = along;
  for (const ContrastDirection& direction : directions) along += direction.values * direction.values.transpose();
  for (int i = 0; i < observations.size(); ++i) {
    for (int j = 0; j < observations.size(); ++j) {
      const DataRow &a = observations.rows[i], &b = observations.rows[j];
      const bool same_kind = a.feature == b.feature && a.test == b.test && a.kind == b.kind;
      if (same_kind && a.kind == RowKind::mean && observations.group_of(i).design == observations.group_of(j).design)
        own(i, j) = 1.0;
    }
  }
  return along_contrasts * in_units_of(noise, std::move(along), observations) +
         (1.0 - along_contrasts) * in_units_of(noise, std::move(own), observations);
}

DiscrepancyTest tested_against_discrepancy(const Evidence& evidence, const Anchor& by_rows_anchor, double chi2,
                                           int count) {
  const Observations& observations = evidence.observations;
  const NameRules& rules = evidence.settings.procedure.names;
  const DataSource source(observations);
  const Anchor anchor = source.combined(by_rows_anchor);
  const Eigen::MatrixXd by_rows = source.combined(discrepancy_covariance(
      observations, by_rows_anchor.directions, observations.covariance(), rules.along_contrasts));
  const Eigen::MatrixXd unit = source.combined(by_rows.transpose());
  const NoisyData data{source.combined(Eigen::MatrixXd(observations.values)),
                       Whitener::independent(Eigen::VectorXd::Ones(observations.size()))};
  const Eigen::MatrixXd root = root_of(unit);
  const Amplitude own = most_probable(marginal(anchor.fit, data), root, rules.amplitudes);
  DiscrepancyTest discrepancy{own.value, own.deviance - chi2, 1.0};
  const int draws = std::min(rules.discrepancy_draws, evidence.settings.bootstraps);
  std::vector<double> leads(draws);
  const Eigen::MatrixXd spread =
      own.value * Eigen::MatrixXd((unit + 1e-9 * unit.trace() / static_cast<double>(unit.rows()) *
                                              Eigen::MatrixXd::Identity(unit.rows(), unit.cols()))
                                      .llt()
                                      .matrixL());
  parallel_for(draws, [&](int i) {
    RandomStream random(evidence.settings.seed + 4, "outsider/" + std::to_string(i));
    Eigen::VectorXd cause(observations.size());
    for (double& value : cause) value = random.normal();
    const Marginal drawn = marginal(anchor.fit, source.draw(anchor.fit.predicted + spread * cause, random));
    leads[i] = most_probable(drawn, root, rules.amplitudes).deviance - best_chi2(drawn, anchor.signatures, count);
  });
  discrepancy.p = exceedance(leads, discrepancy.lead);
  return discrepancy;
}

}  // namespace nacre::diagnosis
