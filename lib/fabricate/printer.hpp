#pragma once

#include "thesis/constants.hpp"

namespace nacre::fabricate {

/// A voxel printer: droplets per inch along its axes, and the part of its tray that can be printed on. The defaults are
/// those of the thesis' printer (2.2.1) and its build area.
struct Printer {
  int dpi_x = thesis::kPrinterResolutionX;
  int dpi_y = thesis::kPrinterResolutionY;
  int dpi_z = thesis::kPrinterResolutionZ;
  double tray_x_mm = 255.0;
  double tray_y_mm = 252.0;
  bool operator==(const Printer&) const = default;
};

inline constexpr int kMicrometresPerInch = 25400;
inline constexpr int kLowestDpi = 100, kHighestDpi = 4800;

/// Distance of droplets in mm.
constexpr double pitch_mm(int dpi) { return 1e-3 * kMicrometresPerInch / dpi; }

/// Throws InputError unless 100 <= dpi <= 4800 on every axis and the tray is 10 to 10,000 mm long either way.
void check_printer(const Printer& printer);

}  // namespace nacre::fabricate
