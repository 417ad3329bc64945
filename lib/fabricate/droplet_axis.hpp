#pragma once
// How the pixels of a specimen fall on the droplets of one axis of the printer (thesis 2.2.3, Table 2.1).

#include <cstdint>
#include <vector>

namespace nacre::fabricate {

/// Droplets of a pixel of `droplets` that belong to the interface at each of its two edges, d of Table 2.1: a quarter
/// of the pixel, rounded (3, 4, 5 -> 1; 6, 7 -> 2; the table's rows, continued to 7 and beyond).
constexpr int interface_droplets(int droplets) { return (droplets + 2) / 4; }

/// Place of one droplet: in pixel `own`, either in its centre part (`neighbour` == `own`) or in the interface part
/// that it shares with the pixel before or after it.
struct AxisPlace {
  std::int32_t own = 0;
  std::int32_t neighbour = 0;
  bool at_interface() const { return own != neighbour; }
  /// The first of the two pixels.
  std::int32_t low() const { return own < neighbour ? own : neighbour; }
  bool operator==(const AxisPlace&) const = default;
};

/// The droplets along one axis of a specimen. A droplet belongs to the specimen, and to a pixel, when its centre lies
/// in it: pixels are a droplet wider here and there (3 or 4 at 300 dpi, 6 or 7 at 600 dpi for 260 um). Pixel 0 begins
/// at the specimen's middle, which is a corner of four units. The outermost pixels have no neighbour and no interface
/// there.
class DropletAxis {
 public:
  /// `length_um` of the specimen, `pixel_um` of a pixel; both even, positive.
  DropletAxis(int dpi, std::int64_t length_um, std::int64_t pixel_um);

  int droplets() const { return places_.size(); }
  const AxisPlace& place(int droplet) const { return places_[droplet]; }
  /// Centre of a droplet from the specimen's edge.
  double centre_mm(int droplet) const { return pitch_mm_ * (droplet + 0.5); }
  double pitch() const { return pitch_mm_; }
  /// First droplet of pixel `pixel`, clipped to the specimen.
  int begin_of(std::int64_t pixel) const;

 private:
  double pitch_mm_;
  std::int64_t dpi_, length_um_, pixel_um_;
  std::vector<AxisPlace> places_;
};

}  // namespace nacre::fabricate
