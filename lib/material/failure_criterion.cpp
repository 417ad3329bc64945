#include "material/failure_criterion.hpp"

#include <fmt/format.h>

#include "base/name_table.hpp"

namespace nacre::material {
namespace {

constexpr NameTable<CriterionKind, 3> kCriteria = {{{CriterionKind::element, "element"},
                                                    {CriterionKind::neighbourhood, "neighbourhood"},
                                                    {CriterionKind::crack_band, "crack_band"}}};

/// Of a neighbourhood in unrefined elements, and of a tail.
constexpr double kLargestRadius = 20.0, kSmallestSoftening = 0.1, kLargestSoftening = 30.0;

}  // namespace

std::string_view to_string(CriterionKind kind) { return name_in(kCriteria, kind); }
Result<CriterionKind> criterion_from_string(std::string_view name) { return value_in(kCriteria, "criterion", name); }

FailureCriterion base_criterion() { return {.kind = CriterionKind::crack_band}; }

double base_strength_cv() { return 0.10; }

std::string criterion_fault(const FailureCriterion& criterion) {
  if (to_string(criterion.kind) == "?") return fmt::format("criterion {} is none", static_cast<int>(criterion.kind));
  const double radius = criterion.radius_m / thesis::kElementSize;
  if (criterion.kind == CriterionKind::neighbourhood && !(radius > 0.0 && radius <= kLargestRadius))
    return fmt::format("radius of the neighbourhood {} m, expected above 0, at most {}", criterion.radius_m,
                       kLargestRadius * thesis::kElementSize);
  if (criterion.kind == CriterionKind::crack_band &&
      !(criterion.softening >= kSmallestSoftening && criterion.softening <= kLargestSoftening))
    return fmt::format("softening of the crack band {}, expected {} to {}", criterion.softening, kSmallestSoftening,
                       kLargestSoftening);
  return "";
}

bool is_strength_cv(double value) {
  return value == 0.0 || (value >= kSmallestStrengthCv && value <= kLargestStrengthCv);
}

}  // namespace nacre::material
