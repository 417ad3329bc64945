#include "diagnosis/included_specimens.hpp"

#include <algorithm>

namespace nacre::diagnosis {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;

bool is_coupon(const SpecimenRecord& s) { return s.valid && s.test == TestKind::tensile && s.design.mixture(); }
bool is_homogeneous_modulus(const SpecimenRecord& s) {
  return s.valid && s.test == TestKind::modulus && s.design.mixture();
}
bool is_layout_modulus(const SpecimenRecord& s) { return s.valid && s.test == TestKind::modulus && s.design.layout(); }
bool is_fracture(const SpecimenRecord& s) { return s.test == TestKind::toughness; }

}  // namespace

IncludedSpecimens included_specimens(const std::vector<SpecimenRecord>& specimens, bool fracture) {
  IncludedSpecimens part{specimens};
  const bool coupons = std::ranges::any_of(specimens, is_coupon);
  const bool layouts =
      std::ranges::any_of(specimens, [](const SpecimenRecord& s) { return s.valid && s.design.layout(); });
  const auto homogeneous = std::ranges::count_if(specimens, is_homogeneous_modulus);
  const bool something_else =
      coupons || std::ranges::any_of(specimens, is_layout_modulus) || (homogeneous > 0 && !layouts);
  if (fracture || !something_else) return part;
  part.fractures_left_out = static_cast<int>(
      std::ranges::count_if(specimens, [](const SpecimenRecord& s) { return s.valid && is_fracture(s); }));
  std::erase_if(part.specimens, is_fracture);
  return part;
}

}  // namespace nacre::diagnosis
