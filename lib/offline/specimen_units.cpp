#include "offline/specimen_units.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "game/plausibility.hpp"
#include "measurement/summary.hpp"

namespace nacre::offline {
namespace {

using measurement::SpecimenRecord;

/// Two specimens of one design that differ by less were given in one unit.
constexpr double kMuchTheSame = 3.0;

std::optional<double> told_by(const SpecimenRecord& specimen) {
  if (specimen.test == tester::TestKind::modulus) return measurement::modulus_of(specimen);
  if (specimen.curve.empty()) return std::nullopt;
  return *std::ranges::max_element(specimen.curve.stress_pa);
}

bool is_vouched_for(const SpecimenRecord& specimen, std::span<const SpecimenRecord> all) {
  const std::optional<double> own = told_by(specimen);
  return own && std::ranges::any_of(all, [&](const SpecimenRecord& other) {
           if (&other == &specimen || !other.valid || other.test != specimen.test || other.design != specimen.design)
             return false;
           const std::optional<double> value = told_by(other);
           return value && *value < kMuchTheSame * *own && *own < kMuchTheSame * *value;
         });
}

}  // namespace

SpecimenUnitDoubts specimen_unit_doubts(std::span<const SpecimenRecord> specimens, const ExpectedMaterials& expected,
                                        tester::Fidelity fidelity) {
  constexpr int kShown = 3;
  game::UnitDoubts of_layouts(expected.of_layouts, fidelity), of_homogeneous(expected.of_homogeneous, fidelity);
  SpecimenUnitDoubts doubts;
  int count = 0;
  for (const SpecimenRecord& specimen : specimens) {
    if (is_vouched_for(specimen, specimens)) continue;
    const auto doubt = (specimen.design.layout() ? of_layouts : of_homogeneous).about(specimen);
    if (doubt && count++ < kShown) doubts.first.push_back(*doubt);
  }
  if (count > 0)
    doubts.caution =
        fmt::format(" Caution: {} of {} specimens are so stiff or soft that only a wrong unit explains them.", count,
                    specimens.size());
  return doubts;
}

}  // namespace nacre::offline
