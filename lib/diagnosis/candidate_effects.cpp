#include "diagnosis/candidate_effects.hpp"

#include <algorithm>

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

}  // namespace

bool is_identified_by_moduli(const material::Effect& effect) {
  return effect.side == material::EffectSide::measurement || effect.name == "interface_anisotropy" ||
         effect.name == "droplet_mixing" || effect.name == "rigid_overprint";
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

std::optional<TooFew> too_few(std::span<const Observation> groups, const NoiseRules& rules) {
  const TooFew few{.layouts = static_cast<int>(std::ranges::count_if(
                       groups, [](const Observation& g) { return g.design.layout() != nullptr; })),
                   .coupons = static_cast<int>(std::ranges::count(groups, TestKind::tensile, &Observation::test)),
                   .layouts_needed = rules.fewest_groups,
                   .coupons_needed = rules.fewest_coupons};
  if (few.layouts >= few.layouts_needed || few.coupons >= few.coupons_needed) return std::nullopt;
  return few;
}

}  // namespace nacre::diagnosis
