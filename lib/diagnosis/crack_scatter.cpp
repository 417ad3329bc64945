#include "diagnosis/crack_scatter.hpp"

#include <algorithm>
#include <cmath>

#include "base/square.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

/// A pooled variance, and degrees of freedom behind it.
struct PooledVariance {
  double variance = 0.0;
  int dof = 0;
};

PooledVariance variance_of_log_toughness(const std::vector<RefinedLayout>& layouts) {
  double squares = 0.0;
  int dof = 0;
  for (const RefinedLayout& layout : layouts) {
    std::vector<double> values;
    for (const FeatureValues& specimen : layout.coarse)
      if (const auto& value = value_of(specimen, Feature::log_toughness)) values.push_back(*value);
    if (values.empty()) continue;
    const Eigen::Map<const Eigen::ArrayXd> all(values.data(), static_cast<Eigen::Index>(values.size()));
    squares += (all - all.mean()).square().sum();
    dof += static_cast<int>(values.size()) - 1;
  }
  return {dof > 0 ? squares / dof : 0.0, dof};
}

double strength_scatter_of(const FractureRun& run) {
  return material::extension_value(run.parameters.extensions, kStrengthScatter);
}

/// Further variance of log T per square of that coefficient of variation: the errors of the emulator itself are in the
/// runs of the base model as well.
double growth_of(const FractureSurface& surface) {
  const Eigen::MatrixXd errors = surface.own_errors(Feature::log_toughness);
  if (errors.cols() == 0) return 0.0;
  const Eigen::VectorXd squares = errors.cwiseAbs2().rowwise().mean();
  double base = 0.0, base_runs = 0.0, excess = 0.0, variation = 0.0;
  for (std::size_t k = 0; k < surface.runs().size(); ++k) {
    if (!simulated_side(surface.runs()[k].parameters).extensions.empty()) continue;
    base += squares[static_cast<Eigen::Index>(k)], base_runs += 1.0;
  }
  for (std::size_t k = 0; k < surface.runs().size(); ++k) {
    const double own = strength_scatter_of(surface.runs()[k]);
    if (own <= 0.0) continue;
    excess += squares[static_cast<Eigen::Index>(k)] - base / std::max(base_runs, 1.0);
    variation += square(own);
  }
  return variation > 0.0 ? std::max(excess / variation, 0.0) : 0.0;
}

}  // namespace

std::optional<CrackScatter> crack_scatter(const Observations& observations, const std::vector<RefinedLayout>& refined,
                                          const FractureSurface& surface, const NoiseRules& rules) {
  const PooledVariance simulated = variance_of_log_toughness(refined);
  const int measured_dof = observations.replicate_dof(TestKind::toughness);
  if (std::min(simulated.dof, measured_dof) < rules.enough_dof || simulated.variance <= 0.0) return std::nullopt;
  // 1/dof each, 1/2 dof of normal deviations: those of cracks have heavier tails.
  return CrackScatter{.of_cracks = simulated.variance,
                      .of_specimens = square(observations.replicate_sd(Feature::log_tangent_30, TestKind::toughness)),
                      .growth = growth_of(surface),
                      .error_variance = 1.0 / simulated.dof + 1.0 / measured_dof + square(rules.crack_scatter_sd)};
}

void put_crack_scatter(Observations& observations, const CrackScatter& scatter) {
  observations.crack_scatter = scatter;
  observations.rows.push_back({.feature = Feature::log_toughness,
                               .kind = RowKind::scatter,
                               .test = TestKind::toughness,
                               .scatter = static_cast<std::size_t>(TestKind::toughness)});
  const Eigen::Index size = observations.size();
  observations.values.conservativeResize(size);
  observations.values[size - 1] = std::log(observations.replicate_sd(Feature::log_toughness, TestKind::toughness));
  for (BatchOffset& offset : observations.batch_offsets) {
    offset.rows.conservativeResize(size);
    offset.rows[size - 1] = 0.0;
  }
}

}  // namespace nacre::diagnosis
