#include "laboratory/hidden_specimen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nacre::laboratory {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

/// Stretch s = sqrt(energy / onset) at which nothing, or a hundredth, is left of the stress.
double last_stretch(const HiddenLaw& law) {
  if (law.drawn_out_softening > 0.0) return 1.0 + law.drawn_out_softening * (std::cbrt(100.0) - 1.0);
  return 1.0 + law.linear_softening;
}

/// A field of the raster, or `otherwise` everywhere, with padded rows.
std::vector<float> padded(const Raster& raster, const std::vector<double>& field, float otherwise, std::size_t stride) {
  std::vector<float> result(stride * static_cast<std::size_t>(raster.rows), otherwise);
  if (field.empty()) return result;
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column)
      result[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)] =
          static_cast<float>(std::min<double>(field[row * raster.columns + column], std::numeric_limits<float>::max()));
  return result;
}

}  // namespace

double hidden_stiffening(const Raster& raster, std::size_t e) {
  const HiddenLaw& law = raster.law;
  if (!law.any()) return 1.0;
  double factor = law.overstress.empty() ? 1.0 : 1.0 + law.overstress[e];
  if (!law.inverse_limit.empty() && law.inverse_limit[e] > 0.0) {
    // -mu J_m / 2 ln(1 - K / J_m) <= W says how far the chains are filled when the element breaks.
    const double energy = raster.threshold_j_per_m3[e] * std::pow(last_stretch(law), 2);
    const double g = std::min(std::exp(2.0 * law.inverse_limit[e] * energy / raster.mu_pa[e]), 50.0);
    factor *= g + 2.0 * g * (g - 1.0);
  }
  return factor;
}

double mean_modulus(const Raster& raster) {
  double sum = 0.0, inverse = 0.0;
  for (std::size_t e = 0; e < raster.mu_pa.size(); ++e) {
    if (raster.mu_pa[e] == 0.0) continue;
    sum += raster.mu_pa[e];
    inverse += 1.0 / raster.mu_pa[e];
  }
  return 2.5 * std::sqrt(sum / inverse);  // E is 2 to 3 mu
}

HiddenSpecimen::HiddenSpecimen(const Raster& raster, double time_step_s)
    : stride_(static_cast<std::size_t>(raster.columns) + 32),
      only_softens_(raster.law.only_softens()),
      parts_{.flows = !raster.law.yield_pa.empty(),
             .fills = !raster.law.inverse_limit.empty(),
             .shrinks = !raster.law.eigenstrain.empty(),
             .relaxes = !raster.law.overstress.empty(),
             .spares_crush = raster.law.tension_only > 0.0} {
  const HiddenLaw& law = raster.law;
  const std::vector<double> none;
  flow_limit_ = padded(raster, none, kNever, stride_);
  for (std::size_t e = 0; e < law.yield_pa.size(); ++e) {
    if (!std::isfinite(law.yield_pa[e]) || raster.mu_pa[e] == 0.0) continue;
    const std::size_t row = e / static_cast<std::size_t>(raster.columns),
                      column = e % static_cast<std::size_t>(raster.columns);
    flow_limit_[row * stride_ + column] = static_cast<float>(0.5 * law.yield_pa[e] / raster.mu_pa[e]);
  }
  inverse_limit_ = padded(raster, law.inverse_limit, 0.0f, stride_);
  eigenstrain_ = padded(raster, law.eigenstrain, 0.0f, stride_);
  overstress_ = padded(raster, law.overstress, 0.0f, stride_);
  // What its neighbourhood fails begins to soften when that says so.
  onset_ = padded(raster, raster.neighbourhood_m > 0.0 ? none : raster.threshold_j_per_m3, kNever, stride_);
  threshold_ = onset_;
  last_energy_ = static_cast<float>(last_stretch(law) * last_stretch(law));
  for (float& threshold : threshold_) threshold *= last_energy_;
  integrity_ = padded(raster, none, 1.0f, stride_);
  const std::vector<float> zero = padded(raster, none, 0.0f, stride_);
  for (auto& point : plastic_) point.fill(zero);
  work_.fill(zero);
  for (auto& point : viscous_) point.fill(zero);
  step_ = {.relaxed = law.overstress.empty() ? 0.0f : static_cast<float>(-std::expm1(-time_step_s / law.relaxation_s)),
           .eigen_scale = 1.0f,
           .softening = {.linear = static_cast<float>(law.linear_softening),
                         .drawn_out = static_cast<float>(law.drawn_out_softening)},
           .tension_only = static_cast<float>(law.tension_only)};
}

void HiddenSpecimen::begin_to_soften(std::size_t at, float energy_j_per_m3) {
  onset_[at] = energy_j_per_m3;
  threshold_[at] = last_energy_ * energy_j_per_m3;
}

int HiddenSpecimen::advance(int row, ElementRow elements, const ElementStep& step) {
  elements.threshold = row_of(threshold_, row);
  if (only_softens_)
    return advance_softening_elements(
        elements, step, {.onset = row_of(onset_, row), .integrity = row_of(integrity_, row)}, step_.softening);
  HiddenRow hidden{};
  hidden.flow_limit = row_of(flow_limit_, row);
  hidden.inverse_limit = row_of(inverse_limit_, row);
  hidden.eigenstrain = row_of(eigenstrain_, row);
  hidden.overstress = row_of(overstress_, row);
  hidden.onset = row_of(onset_, row);
  hidden.integrity = row_of(integrity_, row);
  for (std::size_t point = 0; point < 4; ++point) {
    for (std::size_t i = 0; i < 2; ++i) hidden.plastic[point][i] = row_of(plastic_[point][i], row);
    hidden.work[point] = row_of(work_[point], row);
    for (std::size_t i = 0; i < 3; ++i) hidden.viscous[point][i] = row_of(viscous_[point][i], row);
  }
  return advance_hidden_elements(elements, step, hidden, step_, parts_);
}

}  // namespace nacre::laboratory
