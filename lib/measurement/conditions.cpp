#include "measurement/conditions.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/surroundings.hpp"

namespace nacre::measurement {

bool same_conditions(const tester::TestConditions& tested, const tester::TestConditions& ordered) {
  const auto near = [](double a, double b, double relative) { return std::abs(a - b) <= relative * b; };
  return std::abs(tested.orientation_deg - ordered.orientation_deg) < 0.5 &&
         near(tested.strain_rate_per_s, ordered.strain_rate_per_s, kRateTolerance) &&
         near(tested.thickness_mm, ordered.thickness_mm, kThicknessTolerance);
}

bool is_standard(const tester::TestConditions& tested) {
  return same_conditions(tested, {.orientation_deg = tested.orientation_deg});
}

std::vector<SpecimenRecord> at_nominal_conditions(std::vector<SpecimenRecord> specimens) {
  std::vector<SpecimenRecord*> by_name;
  for (SpecimenRecord& specimen : specimens) by_name.push_back(&specimen);
  std::sort(by_name.begin(), by_name.end(), [](const auto* a, const auto* b) { return a->specimen < b->specimen; });
  const tester::TestConditions upright, turned{.orientation_deg = 90.0};
  std::vector<tester::TestConditions> of_pulls = {upright, turned}, of_holds;
  for (SpecimenRecord* specimen : by_name) {
    auto& nominal = surroundings_of(*specimen).held ? of_holds : of_pulls;
    const auto known = std::find_if(nominal.begin(), nominal.end(),
                                    [&](const auto& each) { return same_conditions(specimen->conditions, each); });
    if (known == nominal.end()) {
      nominal.push_back(specimen->conditions);
    } else {
      specimen->conditions = *known;
    }
  }
  return specimens;
}

}  // namespace nacre::measurement
