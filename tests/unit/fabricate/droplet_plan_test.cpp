#include "fabricate/droplet_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/result.hpp"
#include "pattern/coupons.hpp"

namespace nacre::fabricate {
namespace {

const pattern::Layout kPublished = *pattern::layout_from_key("577fffe9fffdef");

TEST(InterfaceDroplets, AreThoseOfTable21) {
  // a_x 3, 4 -> centre 1, 2 and interface 1; a_y 5, 6 -> centre 3, 2 and interface 1, 2; continued: 7 -> 3 and 2.
  const std::map<int, std::pair<int, int>> centre_and_interface = {
      {3, {1, 1}}, {4, {2, 1}}, {5, {3, 1}}, {6, {2, 2}}, {7, {3, 2}}};
  for (const auto& [pixel, parts] : centre_and_interface) {
    EXPECT_EQ(interface_droplets(pixel), parts.second);
    EXPECT_EQ(pixel - 2 * interface_droplets(pixel), parts.first);
  }
}

TEST(DropletAxis, ADropletBelongsToThePixelThatItsCentreLiesIn) {
  for (const int dpi : {300, 600, 1200, 720}) {
    const DropletAxis axis(dpi, 52000, 260);
    for (int droplet = 0; droplet < axis.droplets(); ++droplet) {
      const double from_middle_mm = (droplet + 0.5) * 25.4 / dpi - 26.0;
      EXPECT_EQ(axis.place(droplet).own, std::floor(from_middle_mm / 0.26)) << dpi << " dpi, droplet " << droplet;
    }
  }
}

TEST(DropletAxis, PixelsOfThePrinterAreThreeOrFourBySixOrSevenDroplets) {
  const auto sizes_at = [](int dpi) {
    const DropletAxis axis(dpi, 104000, 260);
    std::set<int> sizes;
    for (int pixel = -200; pixel < 200; ++pixel) sizes.insert(axis.begin_of(pixel + 1) - axis.begin_of(pixel));
    return sizes;
  };
  EXPECT_EQ(sizes_at(300), (std::set{3, 4}));
  EXPECT_EQ(sizes_at(600), (std::set{6, 7}));
}

TEST(DropletAxis, AnInterfaceReachesEquallyIntoBothNeighboursAndEndsAtTheEdge) {
  const DropletAxis axis(600, 52000, 260);
  for (int pixel = -100; pixel < 100; ++pixel) {
    const int begin = axis.begin_of(pixel), end = axis.begin_of(pixel + 1), width = interface_droplets(end - begin);
    for (int droplet = begin; droplet < end; ++droplet) {
      int neighbour = pixel;
      if (droplet < begin + width && pixel > -100) neighbour = pixel - 1;
      if (droplet >= end - width && pixel < 99) neighbour = pixel + 1;
      EXPECT_EQ(axis.place(droplet), (AxisPlace{pixel, neighbour})) << droplet;
    }
  }
}

TEST(DropletPlan, AFullSpecimenHasTheDropletsOfItsSize) {
  const DropletPlan plan({.design = kPublished}, {});
  EXPECT_EQ(plan.columns(), std::lround(52 / 25.4 * 300));
  EXPECT_EQ(plan.rows(), std::lround(104 / 25.4 * 600));
  EXPECT_EQ(plan.layers(), std::lround(3.2 / 25.4 * 800));
  EXPECT_TRUE(plan.is_like_before(1));
  const DropletPlan turned({.design = kPublished, .orientation_deg = 90.0}, {});
  EXPECT_EQ(turned.columns(), std::lround(104 / 25.4 * 300));
  EXPECT_EQ(turned.rows(), std::lround(52 / 25.4 * 600));
}

/// Whether pixel (row, column) of the unit is rigid, counted from the specimen's upper left corner: a toughness
/// specimen holds whole units.
bool rigid_in_specimen(const pattern::Layout& layout, int pixel_x, int pixel_y) {
  return layout.rigid(pixel_y % pattern::kSide, pixel_x % pattern::kSide);
}

/// The rules of 2.2.3 written out once more, from pixel boundaries alone.
class Rules {
 public:
  Rules(const DropletPlan& plan, const pattern::Layout& layout) : plan_(plan), layout_(layout) {}

  Droplet expected(int column, int row) const {
    const Along x = along(plan_.x(), 200, column), y = along(plan_.y(), 400, row);
    const bool own = rigid_in_specimen(layout_, x.pixel, y.pixel);
    std::set<bool> covered;
    for (const int px : {x.pixel, x.other}) {
      for (const int py : {y.pixel, y.other}) covered.insert(rigid_in_specimen(layout_, px, py));
    }
    if (covered.size() == 1) return own ? Droplet::rigid : Droplet::soft;
    const int i = std::min(x.pixel, x.other), j = std::min(y.pixel, y.other);
    const bool type_2 = x.pixel == x.other;
    const int parity = type_2 ? j + column : i + row;
    return parity % 2 == 0 ? Droplet::rigid : Droplet::soft;
  }

 private:
  struct Along {
    int pixel, other;
  };
  static Along along(const DropletAxis& axis, int pixels, int droplet) {
    const double position_mm = axis.centre_mm(droplet);
    const int pixel = static_cast<int>(position_mm / 0.26);
    const int begin = axis.begin_of(pixel - pixels / 2), end = axis.begin_of(pixel + 1 - pixels / 2);
    const int width = (end - begin) <= 5 ? 1 : 2;
    if (droplet - begin < width && pixel > 0) return {pixel, pixel - 1};
    if (end - 1 - droplet < width && pixel < pixels - 1) return {pixel, pixel + 1};
    return {pixel, pixel};
  }
  const DropletPlan& plan_;
  const pattern::Layout& layout_;
};

TEST(DropletPlan, EveryDropletFollowsTheRulesOfInterfaceEngineering) {
  for (const pattern::Layout& layout :
       {kPublished, pattern::checkerboard(1), pattern::laminate(pattern::LayerDirection::along_x, 2, 3)}) {
    const DropletPlan plan({.design = layout}, {});
    const Slice slice = plan.slice(0);
    const Rules rules(plan, layout);
    int wrong = 0;
    for (int row = 0; row < slice.rows; ++row) {
      for (int column = 0; column < slice.columns; ++column) {
        if (slice.at(column, row) == Droplet::none) continue;  // the notch
        wrong += slice.at(column, row) != rules.expected(column, row);
      }
    }
    EXPECT_EQ(wrong, 0);
  }
}

TEST(DropletPlan, WithoutEngineeringEveryDropletHasTheMaterialOfItsPixel) {
  const DropletPlan plan({.design = kPublished, .interface = Interface::sharp}, {});
  const Slice slice = plan.slice(50);
  for (int row = 0; row < slice.rows; row += 3) {
    for (int column = 0; column < slice.columns; ++column) {
      if (slice.at(column, row) == Droplet::none) continue;
      const bool rigid = rigid_in_specimen(kPublished, static_cast<int>(plan.x().centre_mm(column) / 0.26),
                                           static_cast<int>(plan.y().centre_mm(row) / 0.26));
      ASSERT_EQ(slice.at(column, row), rigid ? Droplet::rigid : Droplet::soft) << column << " " << row;
    }
  }
}

TEST(DropletPlan, InterfaceAreasBetweenUnlikePixelsAreHalfRigid) {
  const DropletPlan plan({.design = pattern::checkerboard(1)}, {});
  const Slice slice = plan.slice(0);
  std::map<Area, DropletCount> by_area;
  for (int row = 0; row < slice.rows; ++row) {
    for (int column = 0; column < slice.columns; ++column)
      ++by_area[plan.area(column, row)][static_cast<std::size_t>(slice.at(column, row))];
  }
  ASSERT_EQ(by_area.size(), 4U);
  for (const Area area : {Area::type_1, Area::type_2, Area::type_3})
    EXPECT_NEAR(rigid_fraction(by_area[area]), 0.5, 0.01) << "type " << static_cast<int>(area);
}

TEST(DropletPlan, RigidFractionIsThatOfThePatternWithinItsInterfaces) {
  const DropletPlan sharp({.design = kPublished, .interface = Interface::sharp}, {});
  EXPECT_NEAR(rigid_fraction(count_droplets(sharp.slice(0))), kPublished.rigid_fraction(), 2e-3);
  const DropletPlan engineered({.design = kPublished}, {});
  EXPECT_NEAR(rigid_fraction(count_droplets(engineered.slice(0))), kPublished.rigid_fraction(), 0.03);
}

TEST(DropletPlan, PureMaterialsAreOneMaterial) {
  const auto rigid = count_droplets(DropletPlan({.design = pattern::Mixture{1.0}}, {}).slice(3));
  EXPECT_EQ(rigid[1], 0);
  EXPECT_GT(rigid[2], 0);
  const auto soft = count_droplets(DropletPlan({.design = pattern::Mixture{0.0}}, {}).slice(3));
  EXPECT_EQ(soft[2], 0);
  EXPECT_EQ(soft[1], rigid[2]);
}

TEST(DropletPlan, AMixtureIsRandomWithItsFractionInEveryLayerAndTheSameForASeed) {
  const SpecimenPlan mixture{.design = pattern::Mixture{0.65}, .seed = 7};
  const DropletPlan plan(mixture, {});
  EXPECT_FALSE(plan.is_like_before(1));
  std::int64_t alike = 0, unlike_in_a_row = 0, pairs = 0;
  const Slice lower = plan.slice(10), upper = plan.slice(11);
  for (const Slice* slice : {&lower, &upper}) {
    const DropletCount count = count_droplets(*slice);
    EXPECT_NEAR(rigid_fraction(count), 0.65, 5 * std::sqrt(0.65 * 0.35 / 1.5e6));
  }
  for (std::size_t i = 0; i + 1 < lower.droplets.size(); ++i) {
    if (lower.droplets[i] == Droplet::none || lower.droplets[i + 1] == Droplet::none) continue;
    ++pairs;
    alike += lower.droplets[i] == upper.droplets[i];
    unlike_in_a_row += lower.droplets[i] != lower.droplets[i + 1];
  }
  // Independent of the layer above and of the neighbouring droplet.
  EXPECT_NEAR(double(alike) / pairs, 0.65 * 0.65 + 0.35 * 0.35, 0.003);
  EXPECT_NEAR(double(unlike_in_a_row) / pairs, 2 * 0.65 * 0.35, 0.003);
  EXPECT_EQ(DropletPlan(mixture, {}).slice(10), lower);
  SpecimenPlan other = mixture;
  other.seed = 8;
  EXPECT_NE(DropletPlan(other, {}).slice(10), lower);
}

TEST(DropletPlan, ATurnedTwinIsTheTurnedSpecimenOnTheSameDroplets) {
  // Square droplets and no engineering: turning commutes with printing.
  const Printer square{.dpi_x = 600, .dpi_y = 600, .dpi_z = 600};
  const pattern::Layout layout = pattern::laminate(pattern::LayerDirection::along_x, 3, 2);
  const Slice upright = DropletPlan({.design = layout, .interface = Interface::sharp}, square).slice(0);
  const Slice turned =
      DropletPlan({.design = layout, .orientation_deg = 90.0, .interface = Interface::sharp}, square).slice(0);
  ASSERT_EQ(turned.columns, upright.rows);
  ASSERT_EQ(turned.rows, upright.columns);
  int unlike = 0;
  for (int row = 0; row < upright.rows; ++row) {
    for (int column = 0; column < upright.columns; ++column)
      unlike += turned.at(row, upright.columns - 1 - column) != upright.at(column, row);
  }
  // Pixel edges fall between droplets symmetrically only to within the row at each edge.
  EXPECT_LT(unlike, 0.01 * upright.rows * upright.columns);
}

TEST(DropletPlan, EngineeringStaysWithThePrintersAxes) {
  // Layers along x meet along y only: type 2, alternating columns. Turned, they meet along x: type 1, alternating rows.
  const pattern::Layout layout = pattern::laminate(pattern::LayerDirection::along_x, 5, 5);
  for (const double orientation : {0.0, 90.0}) {
    const DropletPlan plan({.design = layout, .orientation_deg = orientation}, {});
    const Slice slice = plan.slice(0);
    const bool turned = orientation == 90.0;
    int compared = 0;
    for (int k = 0; k < 500; ++k) {
      // A droplet at an interface, and the next one across the alternation.
      const int row = turned ? 400 + k : plan.y().begin_of(5), column = turned ? plan.x().begin_of(5) : k;
      if (plan.area(column, row) != (turned ? Area::type_1 : Area::type_2)) continue;
      const int next_row = turned ? row + 1 : row, next_column = turned ? column : column + 1;
      if (plan.area(next_column, next_row) != plan.area(column, row)) continue;
      EXPECT_NE(slice.at(column, row), slice.at(next_column, next_row)) << orientation << " " << k;
      ++compared;
    }
    EXPECT_GT(compared, 10);  // upright: the few pixels that are four droplets wide
  }
}

TEST(DropletPlan, TheNotchIsVoidAFifthOfTheWidthDeepAtMidLength) {
  const DropletPlan plan({.design = kPublished}, {});
  const Slice slice = plan.slice(0);
  const int middle = slice.rows / 2;
  int depth = 0;
  while (slice.at(depth, middle) == Droplet::none) ++depth;
  EXPECT_NEAR(depth * plan.x().pitch(), 10.4, plan.x().pitch());
  int height = 0;
  for (int row = 0; row < slice.rows; ++row) height += slice.at(0, row) == Droplet::none;
  EXPECT_NEAR(height * plan.y().pitch(), 0.26, plan.y().pitch());
  const DropletPlan cut({.design = kPublished, .notch = {.print_cut = true}}, {});
  const Slice with_cut = cut.slice(0);
  int opening = 0;
  for (int row = 0; row < slice.rows; ++row) opening += with_cut.at(0, row) == Droplet::none;
  EXPECT_NEAR(opening * plan.y().pitch(), 2 * 7.8 * std::tan(M_PI / 6), 0.2);
}

TEST(DropletPlan, TheBarHasTheOutlineOfAstmD638TypeOne) {
  const DropletPlan plan({.design = pattern::Mixture{1.0}, .kind = SpecimenKind::tensile_bar}, {});
  const Slice slice = plan.slice(0);
  const auto width_mm_at = [&](double along_mm) {
    const int row = static_cast<int>(along_mm / plan.y().pitch());
    int solid = 0;
    for (int column = 0; column < slice.columns; ++column) solid += slice.at(column, row) != Droplet::none;
    return solid * plan.x().pitch();
  };
  EXPECT_NEAR(slice.rows * plan.y().pitch(), 165.0, plan.y().pitch());
  for (const double narrow : {82.5, 82.5 - 28.0, 82.5 + 28.0}) EXPECT_NEAR(width_mm_at(narrow), 13.0, 0.17);
  for (const double wide : {2.0, 30.0, 163.0}) EXPECT_NEAR(width_mm_at(wide), 19.0, 0.17);
  // Fillet of radius 76: 10 mm beyond the narrow section the half width has grown by 76 - sqrt(76^2 - 10^2).
  EXPECT_NEAR(width_mm_at(82.5 + 38.5), 13.0 + 2 * (76 - std::sqrt(76.0 * 76 - 100)), 0.2);
  EXPECT_GT(bar_effective_gauge_mm(), 57.0 + 2 * 29 * 13.0 / 19.0);
  EXPECT_LT(bar_effective_gauge_mm(), 115.0);
}

TEST(DropletPlan, RigidGripsLeaveTheGaugeAlone) {
  const Slice plain = DropletPlan({.design = kPublished}, {}).slice(0);
  const Slice gripped = DropletPlan({.design = kPublished, .grips = GripMaterial::rigid}, {}).slice(0);
  for (int row = 0; row < plain.rows; ++row) {
    const double along_mm = (row + 0.5) * 25.4 / 600;
    const bool grip = along_mm < 25.0 || along_mm > 79.0;
    for (int column = 0; column < plain.columns; column += 7)
      ASSERT_EQ(gripped.at(column, row), grip ? Droplet::rigid : plain.at(column, row)) << row;
  }
}

TEST(DropletPlan, RefusesWhatCannotBePrinted) {
  EXPECT_THROW(DropletPlan({.design = kPublished, .orientation_deg = 45.0}, {}), InputError);
  EXPECT_THROW(DropletPlan({.design = kPublished, .thickness_mm = 0.0}, {}), InputError);
  EXPECT_THROW(DropletPlan({.design = kPublished}, {.dpi_x = 10}), InputError);
}

}  // namespace
}  // namespace nacre::fabricate
