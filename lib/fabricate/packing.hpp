#pragma once
// Where objects lie on trays.

#include <span>
#include <vector>

namespace nacre::fabricate {

/// The base of an object on a tray, or the part of a tray that can be printed on. Nothing is turned: the printer's axes
/// matter to what is tested.
struct Rectangle {
  double x_mm = 0.0, y_mm = 0.0;
};

/// Tray from 1; the object's front left corner from that of the tray.
struct Place {
  int tray = 0;
  double x_mm = 0.0, y_mm = 0.0;
};

/// Puts objects, `gap_mm` from each other and from the edge, on shelves along x or along y of a tray, the deepest
/// first, each on the first shelf that has room (first fit decreasing height). Of four such packings (shelves along x,
/// along y; each with and without objects much shallower than their shelf) the first with the fewest trays is taken. A
/// place per object, in their order; equal objects are interchangeable. An object larger than the tray is on tray 0.
std::vector<Place> packed(std::span<const Rectangle> objects, const Rectangle& tray, double gap_mm);

}  // namespace nacre::fabricate
