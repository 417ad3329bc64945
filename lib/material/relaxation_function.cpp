#include "material/relaxation_function.hpp"

#include <algorithm>
#include <cmath>

#include "material/rate_laws.hpp"

namespace nacre::material {
namespace {

/// A power is a spring at 0 and a dashpot at 1, of which a held strain has no stress.
constexpr double kLargestExponent = 0.95;

/// t^-n, times `scale`.
RelaxationFunction power_of_time(double n, double scale, TimeSpan span) {
  constexpr double kStep = 0.75, kAtRest = 1e-5, kRelaxed = 50.0;  // of log rate; of rate times time
  const int first = static_cast<int>(std::floor(std::log(kAtRest / span.longest_s) / kStep)),
            last = static_cast<int>(std::ceil(std::log(kRelaxed / span.shortest_s) / kStep));
  const double each = scale * kStep / std::tgamma(n);
  RelaxationFunction function{.rest = each * std::exp(n * kStep * first) / std::expm1(n * kStep)};
  for (int k = first; k <= last; ++k) {
    function.shares.push_back(each * std::exp(n * kStep * k));
    function.rates_per_s.push_back(std::exp(kStep * k));
  }
  function.dashpot_s = each * std::exp((n - 1.0) * kStep * (last + 1)) / -std::expm1((n - 1.0) * kStep);
  return function;
}

/// The product with 1 + share e^(-rate t) + ..., of a law's branches.
RelaxationFunction with_branches(const RelaxationFunction& before, const std::vector<double>& shares,
                                 const std::vector<double>& rates_per_s) {
  RelaxationFunction function = before;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    function.dashpot_s += before.dashpot_s * shares[i];
    function.shares.push_back(before.rest * shares[i]);
    function.rates_per_s.push_back(rates_per_s[i]);
    for (std::size_t k = 0; k < before.shares.size(); ++k) {
      function.shares.push_back(before.shares[k] * shares[i]);
      function.rates_per_s.push_back(before.rates_per_s[k] + rates_per_s[i]);
    }
  }
  return function;
}

/// The exponent of a blend: stiffness over that of the phases grows as the rate to this power.
double blend_exponent(const Phases& phases, const Extensions& extensions, double rigid_fraction) {
  const auto power = extensions.find("rate_power_law");
  if (power == extensions.end()) return 0.0;
  const Phases faster = phases_at_rate(phases, {*power}, std::exp(1.0) * kReferenceRatePerS);
  return std::log(mixture(faster, rigid_fraction).young_pa / mixture(phases, rigid_fraction).young_pa);
}

}  // namespace

double RelaxationFunction::at(double time_s) const {
  double sum = rest;
  for (std::size_t k = 0; k < shares.size(); ++k) sum += shares[k] * std::exp(-rates_per_s[k] * time_s);
  return sum;
}

RelaxationFunction relaxation_function(const Phases& phases, const Extensions& extensions, double rigid_fraction,
                                       TimeSpan span) {
  RelaxationFunction function;
  const double n = std::min(blend_exponent(phases, extensions, rigid_fraction), kLargestExponent);
  if (n > 0.0) function = power_of_time(n, held_power(n, 1.0), span);
  const LawExtensions own = branch_of_blend(extensions, rigid_fraction);
  if (own.overstress > 0.0) function = with_branches(function, {own.overstress}, {1.0 / own.relaxation_time_s});
  const double first = extension_value(extensions, "rate_prony", 0),
               second = extension_value(extensions, "rate_prony", 2);
  if (first == 0.0) return function;
  const double time_s = extension_value(extensions, "rate_prony", 1),
               other_s = time_s * extension_value(extensions, "rate_prony", 3);
  if (!(time_s > 0.0)) return function;
  if (!(other_s > 0.0)) return with_branches(function, {first}, {1.0 / time_s});
  return with_branches(function, {first, second}, {1.0 / time_s, 1.0 / other_s});
}

void FadingMemory::prepare(double dt_s) {
  constexpr double kAlike = 1e-12;  // steps of equal strain differ by rounding
  if (std::abs(dt_s - step_s_) <= kAlike * step_s_) return;
  step_s_ = dt_s;
  kept_.resize(branches_.size()), passed_.resize(branches_.size());
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const double steps = function_.rates_per_s[k] * dt_s, lost = std::expm1(-steps);
    kept_[k] = 1.0 + lost;
    passed_[k] = function_.shares[k] * (steps > 0.0 ? -lost / steps : 1.0);
  }
}

double FadingMemory::advance(double elastic_pa, double dt_s) {
  prepare(dt_s);
  const double change = elastic_pa - last_pa_;
  last_pa_ = elastic_pa;
  double stress = function_.rest * elastic_pa;
  if (dt_s > 0.0) stress += function_.dashpot_s * change / dt_s;
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    branches_[k] = kept_[k] * branches_[k] + passed_[k] * change;
    stress += branches_[k];
  }
  return stress;
}

}  // namespace nacre::material
