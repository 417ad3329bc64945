#include "diagnosis/simulated_fracture.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "measurement/specimen_record.hpp"
#include "pattern/coupons.hpp"
#include "sysid/eta.hpp"

namespace nacre::diagnosis {
namespace {

PossibleTest notched_rigid_specimen() {
  return {.way = {AddedTest::notched},
          .design = pattern::Mixture{1.0},
          .test = tester::TestKind::toughness,
          .conditions = {}};
}

// A homogeneous specimen is as stiff as its material, and as strong and tough as the energy that it takes up.
TEST(FractureSlopes, OfAHomogeneousSpecimenAreThoseOfItsMaterial) {
  constexpr double kLarger = 0.1;
  const std::vector<std::string> effects = {"rigid_yield"};
  const CoordinateMap map(
      Basis{.modulus = true, .toughness = true, .coupon = false, .centre = material::default_parameters()}, effects);
  const Eigen::VectorXd u = map.coordinates(material::default_parameters());
  const FractureSlopes slopes =
      fracture_slopes(notched_rigid_specimen(), map, u, kLarger, {.fidelity = tester::Fidelity::tiny});
  ASSERT_EQ(slopes.by_coordinate.cols(), u.size());
  const auto of_constant = [&](Feature feature, Eigen::Index constant) {
    return slopes.own_constants(static_cast<Eigen::Index>(feature), constant) / kLarger;
  };
  constexpr Eigen::Index kSoftE = 0, kRigidE = 1, kSoftW = 3, kRigidW = 4;  // sysid::kSearchedEta
  const double by_e = of_constant(Feature::log_tangent_30, kRigidE) + of_constant(Feature::log_tangent_30, kSoftE);
  EXPECT_NEAR(by_e, 1.0, 0.1) << "stiffness goes with E";
  const double of_w = of_constant(Feature::log_toughness, kRigidW) + of_constant(Feature::log_toughness, kSoftW);
  EXPECT_NEAR(of_w, 1.0, 0.4) << "toughness goes with W";
  EXPECT_NEAR(of_constant(Feature::log_tangent_10, kRigidW), 0.0, 0.1) << "which stiffness does not";
}

TEST(FractureSlopes, ConstantsOfModuliDoNotActOnFracture) {
  const CoordinateMap map(
      Basis{.modulus = true, .toughness = true, .coupon = false, .centre = material::default_parameters()}, {});
  const Eigen::VectorXd u = map.coordinates(material::default_parameters());
  const FractureSlopes slopes =
      fracture_slopes(notched_rigid_specimen(), map, u, 0.1, {.fidelity = tester::Fidelity::tiny});
  const auto moduli = u.size() - static_cast<Eigen::Index>(sysid::kSearchedEta.size());
  ASSERT_GT(moduli, 0);
  EXPECT_TRUE(slopes.by_coordinate.leftCols(moduli).isZero());
  EXPECT_FALSE(slopes.by_coordinate.rightCols(u.size() - moduli).isZero());
}

measurement::SpecimenRecord broken(const pattern::Design& design) {
  measurement::SpecimenRecord specimen;
  specimen.design = design;
  specimen.specimen = design.name();
  specimen.test = tester::TestKind::toughness;
  specimen.toughness_pa = 1e5;
  return specimen;
}

TEST(PossibleTests, BesideFractureTestsAreHomogeneousSpecimensWithANotch) {
  const Observations observations =
      observe({broken(pattern::checkerboard(2)), broken(pattern::Mixture{1.0})}, 0.0, {}, {});
  std::vector<std::string> notched;
  for (const PossibleTest& test : possible_tests(observations, {}))
    if (test.way.kind == AddedTest::notched) {
      notched.push_back(test.design.name());
      EXPECT_FALSE(is_told_by_modulus(test));
    }
  std::ranges::sort(notched);
  EXPECT_EQ(notched, (std::vector<std::string>{"interface", "mix:0.75", "soft"})) << "the rigid one is measured";
}

}  // namespace
}  // namespace nacre::diagnosis
