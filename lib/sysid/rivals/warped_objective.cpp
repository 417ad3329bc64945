#include "sysid/rivals/warped_objective.hpp"

#include <algorithm>
#include <cmath>

#include "sysid/objective.hpp"

namespace nacre::sysid {
namespace {

constexpr int kGridPoints = 64;

GridCurve on_grid(const tester::Curve& curve) {
  const tester::Curve forward = forward_part(curve);
  if (forward.size() < 2 || forward.strain.back() <= 0.0) return {};
  GridCurve grid{forward.strain.back() / (kGridPoints - 1), {}};
  for (int k = 0; k < kGridPoints; ++k) {
    // The last strain itself, not its neighbour beyond: there the curve is zero.
    const double strain = k + 1 < kGridPoints ? k * grid.step : forward.strain.back();
    grid.stress_pa.push_back(tester::stress_at(forward, strain));
  }
  return grid;
}

double stress_on(const GridCurve& curve, double strain) {
  const double position = strain / curve.step;
  const std::size_t index = position;
  if (index + 1 >= curve.stress_pa.size()) return 0.0;
  const double t = position - static_cast<double>(index);
  return (1.0 - t) * curve.stress_pa[index] + t * curve.stress_pa[index + 1];
}

/// Area between `a` and `b` whose stress is multiplied by `stress_factor` and strain by `strain_factor` (midpoint rule
/// on the finer of the two grids).
double area_between_grids(const GridCurve& a, const GridCurve& b, double stress_factor, double strain_factor) {
  const double end = std::max(a.step, b.step * strain_factor) * (kGridPoints - 1);
  const double step = end / (2 * kGridPoints);
  double sum = 0.0;
  for (int k = 0; k < 2 * kGridPoints; ++k) {
    const double strain = (k + 0.5) * step;
    sum += std::abs(stress_on(a, strain) - stress_factor * stress_on(b, strain / strain_factor));
  }
  return sum * step;
}

}  // namespace

WarpedObjective::WarpedObjective(const FitData& data) {
  for (std::size_t i = 0; i < data.measured.size(); ++i) {
    WarpedDesign design;
    design.weight = data.weights[i];
    design.measured_pa = data.measured[i].toughness_pa;
    design.measured = on_grid(data.measured[i].representative_curve);
    weight_sum_ += design.weight;
    designs_.push_back(std::move(design));
  }
}

void WarpedObjective::set_base(const FitTrial& trial) {
  for (std::size_t i = 0; i < designs_.size(); ++i) {
    const Prediction& prediction = trial.predictions[i];
    designs_[i].base_failed = !prediction.toughness_pa;
    designs_[i].base_pa = prediction.toughness_pa.value_or(0.0);
    designs_[i].base = on_grid(prediction.curve);
  }
}

double WarpedObjective::operator()(std::span<const FeatureChange> changes) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < designs_.size(); ++i) {
    const WarpedDesign& design = designs_[i];
    const bool has_curve = !design.measured.stress_pa.empty();
    double misfit = has_curve ? 2.0 : 1.0;
    if (!design.base_failed) {
      const double toughness = design.base_pa * std::exp(changes[i].log_toughness);
      misfit = std::abs(toughness - design.measured_pa) / design.measured_pa;
      if (has_curve && !design.base.stress_pa.empty()) {
        const double stress_factor = std::exp(changes[i].log_peak);
        const double strain_factor = std::exp(changes[i].log_toughness - changes[i].log_peak);
        misfit += area_between_grids(design.measured, design.base, stress_factor, strain_factor) / design.measured_pa;
      }
    }
    sum += design.weight * misfit;
  }
  return weight_sum_ > 0.0 ? sum / weight_sum_ : 0.0;
}

}  // namespace nacre::sysid
