#include "diagnosis/effect_size.hpp"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnosis/joint_fits.hpp"
#include "diagnosis/scatter.hpp"
#include "diagnosis/shared_discretisation.hpp"

namespace nacre::diagnosis {
namespace {

/// The profile: the model refitted at each size, by coordinate of the size.
using SizeProfile = std::map<double, ProfileFit>;

double least_deviance(const SizeProfile& profile) {
  return std::ranges::min_element(profile, {},
                                  [](const SizeProfile::value_type& known) { return known.second.deviance; })
      ->second.deviance;
}

/// Fits at one more size of coordinate i, from these constants; the better of this and of any earlier fit there.
void fit_at(const Evidence& evidence, SizeProfile& profile, int i, double size, Eigen::VectorXd start) {
  start[i] = size;
  const double hopeless = least_deviance(profile) + 2.0 * evidence.settings.procedure.sizes.caught;
  ProfileFit at = fit_with_own_discretisation(evidence, profile.begin()->second.fit.effects, start, {i}, hopeless);
  const auto known = profile.find(size);
  if (known == profile.end() || at.deviance < known->second.deviance) profile[size] = std::move(at);
}

/// Tries one more size of coordinate i, from the constants of the next smaller or the next larger one of those that are
/// not far from the best, whichever is the better; from those of the other too where this is worse than both: a local
/// minimum that catches from one side seldom does from the other.
void try_size(const Evidence& evidence, SizeProfile& profile, int i, double size) {
  const FittedModel& any = profile.begin()->second.fit;
  size = std::clamp(size, any.lower[i], any.upper[i]);
  if (profile.contains(size)) return;
  const double least = least_deviance(profile);
  const ProfileFit *below = nullptr, *above = nullptr;
  for (const auto& [known, at] : profile) {
    if (at.deviance - least >= evidence.settings.procedure.sizes.caught) continue;
    if (known < size) below = &at;
    if (known > size && !above) above = &at;
  }
  const bool from_above = !below || (above && above->deviance < below->deviance);
  const ProfileFit *better = from_above ? above : below, *other = from_above ? below : above;
  fit_at(evidence, profile, i, size, better->fit.u);
  if (other && profile[size].deviance > other->deviance) fit_at(evidence, profile, i, size, other->fit.u);
}

/// Middles between neighbours of interest that differ by more than a step, and sizes beyond ends that are of interest.
std::vector<double> missing_sizes(const SizeProfile& profile, const SizeRules& rules) {
  const double least = least_deviance(profile);
  const auto& [first, first_at] = *profile.begin();
  const auto& [last, last_at] = *profile.rbegin();
  std::vector<double> missing;
  if (first_at.deviance - least < rules.of_interest)
    missing.push_back(first > 0.0 ? first / rules.beyond : rules.beyond * first);
  if (last_at.deviance - least < rules.of_interest)
    missing.push_back(last > 0.0 ? rules.beyond * last : last / rules.beyond);
  for (auto a = profile.begin(), b = std::next(a); b != profile.end(); ++a, ++b) {
    const auto [low, high] = std::minmax(a->second.deviance, b->second.deviance);
    if (low - least < rules.of_interest && high - low > rules.step) missing.push_back(0.5 * (a->first + b->first));
  }
  return missing;
}

SizeProfile profile_of(const Evidence& evidence, const FittedModel& named, int i) {
  const Procedure& rules = evidence.settings.procedure;
  SizeProfile profile;
  profile[named.u[i]] = fit_with_own_discretisation(evidence, named.effects, named.u, {i});
  // Restarted far from the fitted size too, from the initial guess of the base: other constants may hide another
  // optimum.
  for (const double size : rules.fit.sizes)
    fit_at(evidence, profile, i, std::copysign(size, named.u[i]), with_constants_at_centre(evidence.model, named.u));
  for (const double share : rules.sizes.shares) try_size(evidence, profile, i, share * named.u[i]);
  for (int round = 0; round < rules.sizes.rounds; ++round)
    for (const double size : missing_sizes(profile, rules.sizes)) try_size(evidence, profile, i, size);
  return profile;
}

/// The size below which this share of the likelihood lies; at least two sizes.
double quantile_of(const SizeProfile& profile, double share) {
  const double least = least_deviance(profile);
  std::vector<double> sizes, below = {0.0};
  double former = 0.0;
  for (const auto& [size, at] : profile) {
    const double likelihood = std::exp(-0.5 * (at.deviance - least));
    if (!sizes.empty()) below.push_back(below.back() + 0.5 * (former + likelihood) * (size - sizes.back()));
    sizes.push_back(size);
    former = likelihood;
  }
  const double wanted = share * below.back();
  const std::size_t k = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::ranges::upper_bound(below, wanted) - below.begin()), 1, sizes.size() - 1);
  return sizes[k - 1] + (sizes[k] - sizes[k - 1]) * (wanted - below[k - 1]) / (below[k] - below[k - 1]);
}

struct SizeInterval {
  double low = 0.0, middle = 0.0, high = 0.0;
};

SizeInterval by_likelihood(const Evidence& evidence, const FittedModel& named, int i) {
  const SizeProfile profile = profile_of(evidence, named, i);
  const double middle = quantile_of(profile, 0.5),
               widened = student(dof_behind(evidence.observations, named.jacobian.col(i)));
  return {middle + widened * (quantile_of(profile, 0.05) - middle), middle,
          middle + widened * (quantile_of(profile, 0.95) - middle)};
}

SizeInterval by_covariance(const Evidence& evidence, FittedModel named, int i) {
  named.free_all();
  const Whitener whitener(evidence.observations.covariance());
  const double half = 1.645 * student(dof_behind(evidence.observations, named.jacobian.col(i))) *
                      std::sqrt(named.variance(i, whitener));
  return {named.u[i] - half, named.u[i], named.u[i] + half};
}

FittedNumber in_units(const CoordinateMap& map, int i, const SizeInterval& u) {
  // A limit falls as its effect grows stronger.
  const double a = map.value(i, std::max(u.low, map.lower(i))), b = map.value(i, std::min(u.high, map.upper(i)));
  return {map.value(i, u.middle), std::min(a, b), std::max(a, b)};
}

/// Numbers that follow from the parameters of effect k, with 90 % intervals to first order.
std::vector<FittedNumber> derived_numbers(const Evidence& evidence, FittedModel named, std::size_t k) {
  named.free_all();
  const CoordinateMap map = evidence.model.map(named.effects);
  const material::Effect& effect = *material::find_effect(named.effects[k]);
  const int first = map.first_coordinate(k), count = map.count_of(effect);
  const auto number = [&](const material::DerivedNumber& derived, const Eigen::VectorXd& u) {
    std::vector<double> parameters;
    for (int p = 0; p < count; ++p) parameters.push_back(map.value(first + p, u[first + p]));
    return derived.of(parameters);
  };
  const Eigen::JacobiSVD<Eigen::MatrixXd> columns(named.whitened_columns(Whitener(evidence.observations.covariance())),
                                                  Eigen::ComputeThinV);
  constexpr double kStep = 1e-5, kOpen = 1e-3;
  std::vector<FittedNumber> numbers;
  for (const material::DerivedNumber& derived : effect.derived) {
    const double value = number(derived, named.u);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(named.u.size());
    for (int i = first; i < first + count; ++i)
      slope[i] = (number(derived, named.u + kStep * Eigen::VectorXd::Unit(named.u.size(), i)) - value) / kStep;
    // Directions that the data leave open count only where the number goes along with them.
    const Eigen::VectorXd along = columns.matrixV().transpose() * slope;
    double variance = 0.0;
    for (Eigen::Index j = 0; j < along.size(); ++j)
      if (std::abs(along[j]) > kOpen * slope.norm()) variance += std::pow(along[j] / columns.singularValues()[j], 2);
    const double half =
        1.645 * student(dof_behind(evidence.observations, named.jacobian.col(first))) * std::sqrt(variance);
    numbers.push_back({value, std::max(0.0, value - half), value + half});  // none is negative
  }
  return numbers;
}

}  // namespace

NamedModel measure_size(const Evidence& evidence, const FittedModel& named) {
  const CoordinateMap map = evidence.model.map(named.effects);
  NamedModel model;
  Eigen::VectorXd middles = named.u;
  std::vector<int> held;
  for (std::size_t k = 0; k < named.effects.size(); ++k) {
    const material::Effect& effect = *material::find_effect(named.effects[k]);
    const int i = map.first_coordinate(k);
    const bool moves_elements =
        evidence.observations.has_shared_discretisation() && effect.side == material::EffectSide::material;
    const SizeInterval interval =
        moves_elements ? by_likelihood(evidence, named, i) : by_covariance(evidence, named, i);
    const FittedNumber size = in_units(map, i, interval);
    model.effects.push_back({std::string(effect.name), std::string(effect.family), size.value, size.interval_low,
                             size.interval_high, std::string(effect.parameters.front().unit)});
    for (int p = 1; p < map.count_of(effect); ++p)
      model.effects.back().further.push_back(in_units(map, i + p, by_covariance(evidence, named, i + p)));
    model.effects.back().derived = derived_numbers(evidence, named, k);
    const Observations& observations = evidence.observations;
    if (effect.one_for_each == "material") model.effects.back().each = observations.materials;
    if (effect.one_for_each == "machine" && !observations.machines.empty())
      model.effects.back().each.assign(observations.machines.begin() + 1, observations.machines.end());
    middles[i] = interval.middle;
    held.push_back(i);
  }
  model.fit = fit_with_own_discretisation(evidence, named.effects, middles, held).fit;
  return model;
}

}  // namespace nacre::diagnosis
