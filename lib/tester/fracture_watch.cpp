#include "tester/fracture_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "thesis/constants.hpp"

namespace nacre::tester {
namespace {

/// Young's modulus in the middle (geometric mean) of the Voigt and Reuss bounds of the specimen, Pa.
double typical_modulus_pa(const fem::Grid& grid) {
  double sum = 0.0, sum_of_inverses = 0.0;
  for (int element = 0; element < grid.element_count(); ++element) {
    if (grid.phase[element] == fem::Phase::empty) continue;
    sum += grid.young_pa[element];
    sum_of_inverses += 1.0 / grid.young_pa[element];
  }
  return std::sqrt(sum / sum_of_inverses);
}

/// Steps in which an elastic wave runs once from grip to grip, through material of the typical modulus.
int transit_steps(const FractureTest& test) {
  const double wave_m_per_s = std::sqrt(typical_modulus_pa(test.grid) / test.settings.density_kg_per_m3);
  const double height_m = test.grid.rows * test.grid.element_size_m;
  const double steps = std::ceil(height_m / (wave_m_per_s * test.settings.time_step_s));
  return static_cast<int>(std::min(steps, static_cast<double>(thesis::kStepLimit)));
}

}  // namespace

FractureWatch::FractureWatch(const FractureTest& test)
    : strain_limit_(test.strain_limit),
      limit_is_no_failure_(test.limit_is_no_failure),
      record_({.strain_per_step = test.settings.strain_rate_per_s * test.settings.time_step_s,
               .steps_per_sample = test.steps_per_sample,
               .transit_steps = transit_steps(test),
               .strain_limit = test.strain_limit}) {
  result_.element_count = test.grid.element_count();
}

bool FractureWatch::add(double strain, double stress_pa, std::int64_t steps) {
  record_.add(strain, stress_pa);
  result_.steps = steps;
  result_.failure_strain = strain;
  if (record_.separated()) {
    result_.end = EndReason::stress_drop;
  } else if (strain >= strain_limit_) {
    result_.end = limit_is_no_failure_ ? EndReason::no_failure : EndReason::strain_limit;
  } else if (steps >= thesis::kStepLimit) {
    result_.end = EndReason::step_limit;
  } else {
    return false;
  }
  return true;
}

void FractureWatch::add_breaks(std::vector<int> elements) {
  std::sort(elements.begin(), elements.end());
  for (const int element : elements) result_.breaks.push_back({element, result_.failure_strain});
}

Result<ToughnessResult> FractureWatch::take() {
  if (result_.end == EndReason::step_limit)
    return fail("toughness tester: no end after {} steps, at strain {:.3g}: so stiff a law needs shorter steps",
                thesis::kStepLimit.value, result_.failure_strain);
  result_.toughness_pa = record_.toughness_pa();
  result_.peak_stress_pa = record_.peak_stress_pa();
  result_.curve = record_.take_curve();
  return std::move(result_);
}

}  // namespace nacre::tester
