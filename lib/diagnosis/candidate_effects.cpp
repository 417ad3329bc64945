#include "diagnosis/candidate_effects.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

}  // namespace

bool is_identified_by_moduli(const material::Effect& effect) {
  return effect.side == material::EffectSide::measurement || effect.name == "interface_anisotropy" ||
         effect.name == "droplet_mixing" || effect.name == "rigid_overprint" || effect.name == "blend_law";
}

bool have_rate_law(std::span<const std::string> effects) {
  return std::ranges::any_of(effects,
                             [](const std::string& name) { return material::find_effect(name)->family == "rate"; });
}

bool is_modulus_of_layout(const Observations& observations, Eigen::Index row) {
  const DataRow& each = observations.rows[row];
  return each.kind == RowKind::mean && each.test == TestKind::modulus &&
         observations.group_of(row).design.layout() != nullptr;
}

bool has_signature(const material::Effect& effect, const Eigen::VectorXd& change, const Observations& observations,
                   std::span<const Eigen::Index> rows) {
  constexpr double kRounding = 1e-9;
  return std::ranges::any_of(rows, [&](Eigen::Index row) {
    return change[row] > kRounding && (is_identified_by_moduli(effect) || !is_modulus_of_layout(observations, row));
  });
}

bool is_other_constants(const material::Effect& effect, const Observations& observations) {
  return effect.form == "power_law" && std::ranges::all_of(observations.groups, [&](const Observation& group) {
           const bool shows_time = group.pauses.has_pauses() || group.unloaded;
           return !shows_time &&
                  group.conditions.strain_rate_per_s == observations.groups.front().conditions.strain_rate_per_s;
         });
}

bool only_moduli_of_layouts_tell(const Observations& observations) {
  std::map<std::string, tester::TestConditions> first;
  for (const Observation& group : observations.groups) {
    if (group.test != TestKind::modulus) return false;
    if (group.design.layout()) continue;
    const auto [place, is_new] = first.try_emplace(group.material(), group.conditions);
    if (!is_new && !(place->second == group.conditions)) return false;
  }
  return true;
}

}  // namespace nacre::diagnosis
