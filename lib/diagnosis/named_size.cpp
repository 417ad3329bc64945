#include "diagnosis/named_size.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nacre::diagnosis {
namespace {

/// Rows with the numerics of one model in place of those of the base and all its rivals.
Observations with_numerics_of(const Evidence& evidence, const Fit& fit) {
  Observations observations = evidence.observations;
  if (observations.numerics_shared.rows() == observations.size()) {
    observations.numerics_shared =
        evidence.settings.floor.mesh_amplitude * evidence.model.mesh_change(evidence.model.map(fit.effects), fit.u);
  }
  return observations;
}

}  // namespace

Fit fit_for_size(const Evidence& evidence, const Fit& named) {
  return fit_model(evidence.model, with_numerics_of(evidence, named), named.effects, named.u);
}

std::vector<NamedEffect> named_effects(const Evidence& evidence, Fit fit) {
  const CoordinateMap map = evidence.model.map(fit.effects);
  const Whitener whitener(with_numerics_of(evidence, fit).covariance());
  const int dof = evidence.observations.replicate_dof();
  const double student =
      dof > 0 ? 1.645 * (1.0 + 0.93 / dof) : 2.0;  // Cornish-Fisher, within 1 % from 4 degrees of freedom on
  fit.free.resize(static_cast<std::size_t>(map.size()));
  std::iota(fit.free.begin(), fit.free.end(), 0);
  std::vector<NamedEffect> named;
  for (std::size_t k = 0; k < fit.effects.size(); ++k) {
    const material::Effect& effect = *material::find_effect(fit.effects[k]);
    const int i = map.first_coordinate(k);
    const double half = student * std::sqrt(fit.variance(i, whitener));
    // A limit falls as its effect grows stronger.
    const double a = map.value(i, std::max(fit.u[i] - half, map.lower(i))), b = map.value(i, fit.u[i] + half);
    named.push_back({fit.effects[k], std::string(effect.family), map.value(i, fit.u[i]), std::min(a, b), std::max(a, b),
                     std::string(effect.parameters.front().unit)});
  }
  return named;
}

}  // namespace nacre::diagnosis
