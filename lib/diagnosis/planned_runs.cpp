#include "diagnosis/planned_runs.hpp"

#include <algorithm>
#include <cmath>

#include "material/effect_library.hpp"
#include "sysid/eta.hpp"

namespace nacre::diagnosis {
namespace {

void move_eta(material::ToughnessParameters& parameters, double spread, double sign,
              const std::vector<double>& normal) {
  material::ToughnessVector eta = to_vector(parameters);
  for (std::size_t k = 0; k < sysid::kSearchedEta.size(); ++k)
    eta[sysid::kSearchedEta[k]] *= std::exp(sign * spread * normal[k]);
  parameters = material::toughness_from_vector(eta);
}

std::vector<double> normals(RandomStream& random) {
  std::vector<double> values(sysid::kSearchedEta.size());
  for (double& value : values) value = random.normal();
  return values;
}

}  // namespace

std::vector<material::ParameterSet> opposite_pairs(const material::ParameterSet& centre, int pairs,
                                                   const EmulatorRules& rules, RandomStream& random) {
  std::vector<material::ParameterSet> sets;
  for (int k = 0; k < pairs; ++k) {
    const std::vector<double> normal = normals(random);
    for (const double sign : {1.0, -1.0}) {
      sets.push_back(centre);
      move_eta(sets.back().toughness, rules.spread, sign, normal);
    }
  }
  return sets;
}

std::vector<const material::Effect*> fracture_effects() {
  std::vector<const material::Effect*> effects;
  for (const material::Effect& effect : material::effect_library())
    if (effect.acts_on_toughness && effect.side == material::EffectSide::material) effects.push_back(&effect);
  return effects;
}

std::optional<material::ParameterSet> with_effect(const material::ParameterSet& centre, const material::Effect& effect,
                                                  double size, const ConstantRules& constants,
                                                  const EmulatorRules& rules, RandomStream& random) {
  const std::vector<std::string> names = {std::string(effect.name)};
  const CoordinateMap map(
      Basis{.modulus = false, .toughness = true, .coupon = false, .centre = centre, .rules = constants}, names);
  const int own = map.base_count();
  if (size < 0.0 && map.lower(own) >= 0.0) return std::nullopt;
  Eigen::VectorXd u = map.coordinates(centre);
  u[own] = std::clamp(size, map.lower(own), map.upper(own));
  for (int i = own + 1; i < map.size(); ++i) u[i] = map.usual(i);
  material::ParameterSet set = map.parameters(u);
  move_eta(set.toughness, rules.jitter, 1.0, normals(random));
  return set;
}

std::vector<material::ParameterSet> planned_runs(const Basis& basis, bool with_pairs, const EmulatorRules& rules,
                                                 std::uint64_t seed) {
  std::vector<material::ParameterSet> sets = {basis.centre};
  RandomStream random(seed, "diagnosis/runs");
  if (with_pairs) std::ranges::move(opposite_pairs(basis.centre, rules.pairs, rules, random), std::back_inserter(sets));
  for (const material::Effect* effect : fracture_effects())
    for (const double sign : {1.0, -1.0})
      for (const double size : rules.effect_sizes)
        if (auto set = with_effect(basis.centre, *effect, sign * size, basis.rules, rules, random))
          sets.push_back(std::move(*set));
  return sets;
}

}  // namespace nacre::diagnosis
