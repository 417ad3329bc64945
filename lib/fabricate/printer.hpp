#pragma once

#include "thesis/constants.hpp"
#include "thesis/laboratory_rates.hpp"

namespace nacre::fabricate {

/// A voxel printer: droplets per inch along its axes, and the part of its tray that can be printed on. The defaults are
/// those of the thesis' printer (2.2.1) and its build area.
struct Printer {
  int dpi_x = thesis::kPrinterResolutionX;
  int dpi_y = thesis::kPrinterResolutionY;
  int dpi_z = thesis::kPrinterResolutionZ;
  double tray_x_mm = thesis::kTrayX;
  double tray_y_mm = thesis::kTrayY;
  bool operator==(const Printer&) const = default;
};

/// How fast printer and testing machine work.
struct Rates {
  double layers_per_minute = thesis::kLayersPerMinute;
  double minutes_per_test = thesis::kMinutesPerTest;
  bool operator==(const Rates&) const = default;
};

inline constexpr int kMicrometresPerInch = 25400;
inline constexpr int kLowestDpi = 100, kHighestDpi = 4800;

/// Distance of droplets in mm.
constexpr double pitch_mm(int dpi) { return 1e-3 * kMicrometresPerInch / dpi; }

/// Layers of a specimen, at least one.
int layers_of(double thickness_mm, const Printer& printer);

/// Throws InputError unless 100 <= dpi <= 4800 on every axis and the tray is 10 to 10,000 mm long either way.
void check_printer(const Printer& printer);

}  // namespace nacre::fabricate
