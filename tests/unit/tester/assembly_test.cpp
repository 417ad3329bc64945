#include "tester/assembly.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "material/mixture.hpp"
#include "pattern/coupons.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/modulus.hpp"

namespace nacre::tester {
namespace {

using fem::Grid;
using fem::Phase;

const material::ParameterSet kDefaults = material::thesis_parameters();

/// Without any symmetry, so that no mix-up of axes goes unseen.
pattern::Layout lopsided_layout() {
  RandomStream random(1, "assembly_test");
  pattern::Layout layout;
  for (int row = 0; row < pattern::kSide; ++row)
    for (int column = 0; column < pattern::kSide; ++column) layout.set(row, column, random.uniform() < 0.6);
  return layout;
}

Grid assembled(const pattern::Design& design, const material::Extensions& extensions = {}, int refinement = 1,
               double orientation_deg = 0.0, AssemblyTarget target = AssemblyTarget::toughness) {
  material::ParameterSet parameters = kDefaults;
  parameters.extensions = extensions;
  return assemble(design, parameters, {.orientation_deg = orientation_deg}, target, 2, 1, refinement);
}

Phase phase_at(const Grid& grid, int row, int column) { return grid.phase[grid.index(row, column)]; }
double young_at(const Grid& grid, int row, int column) { return grid.young_pa[grid.index(row, column)]; }

bool same(const Grid& a, const Grid& b) {
  return a.columns == b.columns && a.rows == b.rows && a.element_size_m == b.element_size_m && a.phase == b.phase &&
         a.young_pa == b.young_pa && a.poisson == b.poisson && a.threshold_j_per_m3 == b.threshold_j_per_m3;
}

TEST(Assembly, EvenElementsAreThePixelsFromTheBottomLeft) {
  const pattern::Layout layout = lopsided_layout();
  const Grid grid = assembled(layout);
  for (int j = 0; j < pattern::kSide; ++j)
    for (int i = 0; i < 2 * pattern::kSide; ++i)
      EXPECT_EQ(phase_at(grid, 2 * j, 2 * i),
                layout.rigid(pattern::kSide - 1 - j, i % pattern::kSide) ? Phase::rigid : Phase::soft);
}

TEST(Assembly, OddElementsAreInterfaceUnlessAllPixelsTheyTouchAgree) {
  const pattern::Layout layout = lopsided_layout();
  const Grid grid = assembled(layout);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      bool any_soft = false, any_rigid = false;
      for (const int j : {row / 2, (row + 1) / 2})
        for (const int i : {column / 2, (column + 1) / 2})
          (layout.rigid(pattern::kSide - 1 - j % pattern::kSide, i % pattern::kSide) ? any_rigid : any_soft) = true;
      const Phase expected = any_soft && any_rigid ? Phase::interface : any_rigid ? Phase::rigid : Phase::soft;
      EXPECT_EQ(phase_at(grid, row, column), expected);
    }
}

TEST(Assembly, TilesRepeat) {
  const Grid grid = assembled(lopsided_layout());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < kElementsPerUnit; ++column)
      EXPECT_EQ(phase_at(grid, row, column), phase_at(grid, row, column + kElementsPerUnit));
}

TEST(Assembly, TargetsTakeTheirOwnParameters) {
  const Grid modulus = assembled(pattern::Mixture{1.0}, {}, 1, 0.0, AssemblyTarget::modulus);
  const Grid toughness = assembled(pattern::Mixture{1.0});
  EXPECT_EQ(modulus.young_pa.front(), kDefaults.modulus.e_vw_pa);
  EXPECT_TRUE(std::isinf(modulus.threshold_j_per_m3.front()));
  EXPECT_EQ(toughness.young_pa.front(), kDefaults.toughness.e_vw_pa);
  EXPECT_EQ(toughness.threshold_j_per_m3.front(), kDefaults.toughness.w_vw_j_per_m3);
}

TEST(Assembly, RefinementKeepsTheGeometryAndTheFractureEnergy) {
  const pattern::Layout layout = lopsided_layout();
  const Grid coarse = assembled(layout), fine = assembled(layout, {}, 2);
  EXPECT_EQ(fine.columns, 2 * coarse.columns);
  EXPECT_EQ(fine.element_size_m, coarse.element_size_m / 2);
  for (int row = 0; row < fine.rows; ++row)
    for (int column = 0; column < fine.columns; ++column) {
      const auto e = static_cast<std::size_t>(fine.index(row, column));
      const auto c = static_cast<std::size_t>(coarse.index(row / 2, column / 2));
      EXPECT_EQ(fine.phase[e], coarse.phase[c]);
      EXPECT_EQ(fine.young_pa[e], coarse.young_pa[c]);
      EXPECT_EQ(fine.threshold_j_per_m3[e], 2 * coarse.threshold_j_per_m3[c]);
    }
}

TEST(Assembly, MixturesHaveNoInterfaceElements) {
  const Grid grid = assembled(pattern::Mixture{0.8});
  const material::Constants expected = material::mixture(material::phases_of(kDefaults.toughness), 0.8);
  EXPECT_EQ(std::count(grid.young_pa.begin(), grid.young_pa.end(), expected.young_pa), grid.element_count());
  EXPECT_EQ(std::count(grid.phase.begin(), grid.phase.end(), Phase::rigid), grid.element_count());
}

TEST(Extensions, EachAtZeroIsTheBaseModelToTheBit) {
  const pattern::Layout layout = lopsided_layout();
  for (const material::Effect& effect : material::effect_library()) {
    const material::Extensions zero = {{std::string(effect.name), std::vector<double>(effect.parameters.size(), 0.0)}};
    for (const double orientation : {0.0, 90.0})
      for (const int refinement : {1, 2})
        EXPECT_TRUE(
            same(assembled(layout, zero, refinement, orientation), assembled(layout, {}, refinement, orientation)))
            << effect.name;
  }
}

TEST(InterfaceAnisotropy, StiffensInterfacesAlongXAndWeakensThoseAlongY) {
  const Grid base = assembled(lopsided_layout()),
             grid = assembled(lopsided_layout(), {{"interface_anisotropy", {0.25}}});
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const bool is_interface = phase_at(base, row, column) == Phase::interface;
      const bool between_x = column % 2 == 1 && row % 2 == 0, between_y = column % 2 == 0 && row % 2 == 1;
      const double factor = !is_interface ? 1.0 : between_x ? 1.25 : between_y ? 0.75 : 1.0;
      const auto e = static_cast<std::size_t>(grid.index(row, column));
      EXPECT_EQ(grid.young_pa[e], factor * base.young_pa[e]);
      EXPECT_EQ(grid.threshold_j_per_m3[e], factor * base.threshold_j_per_m3[e]);
    }
}

TEST(Orientation, ExchangesThePrintersAxesAlone) {
  const pattern::Layout layout = lopsided_layout();
  const material::Extensions one_way = {{"interface_anisotropy", {0.3}}},
                             other_way = {{"interface_anisotropy", {-0.3}}};
  EXPECT_TRUE(same(assembled(layout, one_way, 1, 90.0), assembled(layout, other_way, 1, 0.0)));
  EXPECT_FALSE(same(assembled(layout, one_way, 1, 90.0), assembled(layout, one_way, 1, 0.0)));
}

// As `nacre fabricate` prints them: a laminate's layers stay as they were to the pull.
TEST(Orientation, MakesNoDifferenceInTheBaseModel) {
  RandomStream random(3, "assembly_test");
  const pattern::Pattern pattern = pattern::random_pattern(random);
  EXPECT_TRUE(same(assembled(pattern, {}, 1, 90.0), assembled(pattern, {}, 1, 0.0)));
  const pattern::Layout laminate = pattern::laminate(pattern::LayerDirection::along_y, 2, 2);
  EXPECT_TRUE(same(assembled(laminate, {}, 1, 90.0), assembled(laminate, {}, 1, 0.0)));
}

// Transposing the layout and exchanging the interface's axes transposes one unit of the specimen.
TEST(Orientation, ExchangingAllAxesTransposesTheUnit) {
  const pattern::Layout layout = lopsided_layout();
  const auto unit = [](const pattern::Layout& l, double anisotropy) {
    material::ParameterSet parameters = kDefaults;
    parameters.extensions = {{"interface_anisotropy", {anisotropy}}};
    return assemble(l, parameters, {}, AssemblyTarget::toughness, 1, 1);
  };
  // Rows count from the bottom, so that the grid's diagonal is the layout's other one: transpose, and turn by half.
  const Grid a = unit(layout, 0.2), b = unit(layout.transposed().rotated().rotated(), -0.2);
  for (int row = 0; row < a.rows; ++row)
    for (int column = 0; column < a.columns; ++column) {
      EXPECT_EQ(phase_at(a, row, column), phase_at(b, column, row));
      EXPECT_EQ(young_at(a, row, column), young_at(b, column, row));
    }
}

/// Mean of the rigid fraction, from log E between soft, interface and rigid.
double mean_fraction(const Grid& grid) {
  const double soft = std::log(kDefaults.toughness.e_tb_pa), middle = std::log(kDefaults.toughness.e_if_pa),
               rigid = std::log(kDefaults.toughness.e_vw_pa);
  double sum = 0.0;
  for (const double young : grid.young_pa) {
    const double level = std::log(young);
    sum += level < middle ? 0.5 * (level - soft) / (middle - soft) : 0.5 + 0.5 * (level - middle) / (rigid - middle);
  }
  return sum / grid.element_count();
}

TEST(DropletMixing, LeavesTheBaseModelContinuously) {
  const pattern::Layout layout = lopsided_layout();
  const Grid base = assembled(layout);
  double last = 0.0;
  for (const double pixels : {1e-7, 1e-5, 1e-3, 1e-1}) {
    const Grid grid = assembled(layout, {{"droplet_mixing", {pixels}}});
    double largest = 0.0;
    for (std::size_t e = 0; e < grid.young_pa.size(); ++e)
      largest = std::max(largest, std::abs(std::log(grid.young_pa[e] / base.young_pa[e])));
    EXPECT_LT(largest, 10.0 * pixels);
    EXPECT_GT(largest, last);  // and it does leave it, from the first
    last = largest;
  }
}

TEST(DropletMixing, KeepsTheAmountOfMaterial) {
  const pattern::Layout layout = lopsided_layout();
  const double before = mean_fraction(assembled(layout));
  for (const double pixels : {0.1, 0.5, 1.0, 2.3, 4.0})
    // Where every element is one cell of mixed material, so that its stiffness tells its fraction.
    for (const int refinement : {2, 4})
      EXPECT_NEAR(mean_fraction(assembled(layout, {{"droplet_mixing", {pixels}}}, refinement)), before, 1e-12);
}

TEST(DropletMixing, ChangesTheModulusAsItDoesOnAFinerMesh) {
  RandomStream random(5, "mixing patterns");
  for (const pattern::Pattern& each : pattern::stratified_patterns(4, random)) {
    const auto log_modulus = [&](double pixels, int refinement) {
      material::ParameterSet parameters = kDefaults;
      if (pixels > 0.0) parameters.extensions["droplet_mixing"] = {pixels};
      return std::log(
          test_modulus({each, parameters, {}, Fidelity::tiny}, {.refinement = refinement}).value().modulus_pa);
    };
    // Over 12 patterns -0.6 +- 1.5 % apart; 17 +- 7 % when each element took the law of mixtures at its mean fraction.
    const double coarse = log_modulus(0.6, 1) - log_modulus(0.0, 1), fine = log_modulus(0.6, 2) - log_modulus(0.0, 2);
    EXPECT_NEAR(coarse, fine, 0.06) << each.key();
  }
}

TEST(DropletMixing, FadesFineStructureAndLeavesCoarseStructure) {
  const auto spread = [](const pattern::Layout& layout) {
    const Grid grid = assembled(layout, {{"droplet_mixing", {1.0}}});
    const auto [low, high] = std::minmax_element(grid.young_pa.begin(), grid.young_pa.end());
    return std::log(*high / *low);
  };
  const double whole = std::log(kDefaults.toughness.e_vw_pa / kDefaults.toughness.e_tb_pa);
  EXPECT_LT(spread(pattern::checkerboard(1)), 0.4 * whole);
  EXPECT_NEAR(spread(pattern::checkerboard(5)), whole, 1e-9);
}

TEST(DropletMixing, LeavesUniformRegionsAlone) {
  pattern::Layout rigid;
  for (int row = 0; row < pattern::kSide; ++row)
    for (int column = 0; column < pattern::kSide; ++column) rigid.set(row, column, true);
  const Grid grid = assembled(rigid, {{"droplet_mixing", {2.0}}});
  for (const double young : grid.young_pa) EXPECT_NEAR(young / kDefaults.toughness.e_vw_pa, 1.0, 1e-12);
}

/// Over the edges of the unit, and with everything that acts on a layout.
TEST(Assembly, APartHasTheNumbersOfTheWhole) {
  material::ParameterSet parameters = kDefaults;
  parameters.extensions = {{"droplet_mixing", {0.6}}, {"rigid_overprint", {0.2}}, {"interface_anisotropy", {0.3}}};
  const pattern::Layout layout = lopsided_layout();
  const Grid whole = assemble(layout, parameters, {}, AssemblyTarget::toughness, 1, 1);
  constexpr int kFirst = -3, kCount = 47;
  const Grid part = assemble_elastic_part(layout, parameters, AssemblyTarget::toughness, kFirst, kCount);
  for (int row = 0; row < kCount; ++row)
    for (int column = 0; column < kCount; ++column) {
      const auto wrapped = [](int i) { return (i + kFirst + kElementsPerUnit) % kElementsPerUnit; };
      const auto at = static_cast<std::size_t>(part.index(row, column));
      const auto of = static_cast<std::size_t>(whole.index(wrapped(row), wrapped(column)));
      ASSERT_EQ(part.young_pa[at], whole.young_pa[of]) << row << ", " << column;
      ASSERT_EQ(part.poisson[at], whole.poisson[of]);
      ASSERT_EQ(part.threshold_j_per_m3[at], whole.threshold_j_per_m3[of]);
      ASSERT_EQ(part.phase[at], whole.phase[of]);
    }
}

}  // namespace
}  // namespace nacre::tester
