#pragma once
// One repeated unit of a layout as the laboratory's printer lays it down, at the laboratory's resolution.

#include <vector>

#include "laboratory/specimen_raster.hpp"

namespace nacre::laboratory {

/// Lengths in pixels. Pixel k of a row of pixels is centred half a tester element from the specimen's edge plus k
/// pixels.
inline constexpr double kFirstCentre = 0.5 * kTesterElementM / kPixelM;
inline constexpr double kInterfaceReach = 0.25;
/// Elements of the laboratory along one side of a repeated unit.
inline constexpr int kUnitElements = static_cast<int>(pattern::kSide * kPixelM / kElementM + 0.5);

/// The unit's elements, row 0 at the bottom.
struct LaidUnit {
  std::vector<Site> site;
  std::vector<double> rigid_fraction;
};
inline std::size_t unit_index(int row, int column) { return row * kUnitElements + column; }

/// Pixel (column, row) counted from the lower left, the unit repeated without end.
bool rigid_at(const pattern::Layout& layout, int column, int row);

/// Sites from the drawn layout; rigid fractions with what hidden effects do to them (growth, mixing).
LaidUnit unit_of(const pattern::Layout& layout, const HiddenEffects& effects);

}  // namespace nacre::laboratory
