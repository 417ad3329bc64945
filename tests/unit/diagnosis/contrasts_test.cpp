#include "diagnosis/contrasts.hpp"

#include <gtest/gtest.h>

#include "diagnosis/observations.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

std::vector<std::string> names_of(const std::vector<ContrastDirection>& directions) {
  std::vector<std::string> names;
  for (const ContrastDirection& direction : directions) names.push_back(direction.name);
  return names;
}

/// Twelve layouts upright and five of them turned, beside coupons of eight mixtures.
std::vector<measurement::SpecimenRecord> layouts_and_coupons() {
  std::vector<measurement::SpecimenRecord> specimens = synthetic_specimens({}, synthetic_truth());
  const auto coupons = synthetic_coupons(synthetic_truth(), {1e-3}, 3, 0.01, 5);
  specimens.insert(specimens.end(), coupons.begin(), coupons.end());
  return specimens;
}

TEST(EvenDirections, AreThoseOfConditionsThatVary) {
  std::vector<measurement::SpecimenRecord> specimens = layouts_and_coupons();
  EXPECT_EQ(names_of(even_directions(observe(specimens, 0.0, {}, {}))), std::vector<std::string>{"orientation"});
  for (int i = 0; i < 3; ++i) specimens[i].conditions.thickness_mm = 1.6;
  EXPECT_EQ(names_of(even_directions(observe(specimens, 0.0, {}, {}))),
            (std::vector<std::string>{"orientation", "thickness"}));
}

// Coupons count beside layouts: turned ones that are no softer speak against a cause that acts on everything turned.
TEST(EvenDirections, AreTheSameOnLayoutsAndCouponsAndNothingOnStrains) {
  const Observations observations = observe(layouts_and_coupons(), 0.0, {}, {});
  const ContrastDirection turned = even_directions(observations).front();
  double upright = 0.0;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    const bool scales =
        row.kind == RowKind::mean && (row.feature == Feature::log_modulus || is_curve_stress(row.feature));
    if (!scales) {
      EXPECT_EQ(turned.values[i], 0.0) << to_string(row.feature);
      continue;
    }
    const bool is_turned = observations.group_of(i).conditions.orientation_deg == 90.0;
    EXPECT_EQ(turned.values[i] > 0.0, is_turned) << to_string(row.feature);
    if (is_turned) continue;
    if (upright == 0.0) upright = turned.values[i];
    EXPECT_DOUBLE_EQ(turned.values[i], upright) << to_string(row.feature);
  }
  EXPECT_NEAR(turned.values.norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace nacre::diagnosis
