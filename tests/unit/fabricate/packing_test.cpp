#include "fabricate/packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.hpp"

namespace nacre::fabricate {
namespace {

int trays_of(const std::vector<Place>& places) { return std::ranges::max(places, {}, &Place::tray).tray; }

TEST(Packing, KeepsObjectsApartAndOnTheirTrays) {
  RandomStream random(1, "packing test");
  for (int round = 0; round < 50; ++round) {
    std::vector<Rectangle> objects;
    for (int i = 0; i < 40; ++i) objects.push_back({10.0 + 60.0 * random.uniform(), 10.0 + 60.0 * random.uniform()});
    const Rectangle tray{200.0, 150.0};
    const double gap = 3.0, exact = gap - 1e-9;
    const auto places = packed(objects, tray, gap);
    ASSERT_EQ(places.size(), objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
      EXPECT_GE(std::min(places[i].x_mm, places[i].y_mm), exact);
      EXPECT_LE(places[i].x_mm + objects[i].x_mm, tray.x_mm - exact);
      EXPECT_LE(places[i].y_mm + objects[i].y_mm, tray.y_mm - exact);
      for (std::size_t j = 0; j < i; ++j) {
        if (places[i].tray != places[j].tray) continue;
        const auto before = [&](double a, double length, double b) { return a + length + exact <= b; };
        EXPECT_TRUE(before(places[i].x_mm, objects[i].x_mm, places[j].x_mm) ||
                    before(places[j].x_mm, objects[j].x_mm, places[i].x_mm) ||
                    before(places[i].y_mm, objects[i].y_mm, places[j].y_mm) ||
                    before(places[j].y_mm, objects[j].y_mm, places[i].y_mm));
      }
    }
  }
}

TEST(Packing, TakesNoMoreTraysInAnotherOrder) {
  std::vector<Rectangle> objects;
  for (int i = 0; i < 9; ++i) objects.push_back({52.0, 104.0});
  for (int i = 0; i < 9; ++i) objects.push_back({19.0, 165.0});
  const int trays = trays_of(packed(objects, {255.0, 252.0}, 5.0));
  RandomStream random(2, "packing test");
  for (int round = 0; round < 20; ++round) {
    for (std::size_t i = objects.size() - 1; i > 0; --i)
      std::swap(objects[i], objects[static_cast<std::size_t>(random.index(static_cast<int>(i) + 1))]);
    EXPECT_EQ(trays_of(packed(objects, {255.0, 252.0}, 5.0)), trays);
  }
}

TEST(Packing, FillsATrayThatIsFilledExactly) {
  // Four columns of two, 2 x 104 + 3 x 5 = 223 mm and 4 x 52 + 5 x 5 = 233 mm.
  EXPECT_EQ(trays_of(packed(std::vector<Rectangle>(8, {52.0, 104.0}), {233.0, 223.0}, 5.0)), 1);
  EXPECT_EQ(trays_of(packed(std::vector<Rectangle>(9, {52.0, 104.0}), {233.0, 223.0}, 5.0)), 2);
}

TEST(Packing, GivesNoPlaceToWhatIsLargerThanATray) {
  const auto places = packed(std::vector<Rectangle>{{10.0, 10.0}, {95.0, 10.0}}, {100.0, 100.0}, 5.0);
  EXPECT_EQ(places[0].tray, 1);
  EXPECT_EQ(places[1].tray, 0);
}

}  // namespace
}  // namespace nacre::fabricate
