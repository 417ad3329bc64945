#pragma once

#include <span>
#include <string_view>

#include "thesis/constants.hpp"
#include "thesis/laboratory_rates.hpp"

namespace nacre::fabricate {

/// How a printer's software reads the material of a droplet in a slice's PNG.
enum class SlicePixels {
  indexed,  ///< 8-bit palette: index 0 none, 1 soft, 2 rigid; files 0000.png, 0001.png, ...
  rgba,     ///< 32 bits, one opaque colour each (slice_png.hpp); files slice_0000.png, ...: GrabCAD Voxel Print
};

/// A voxel printer: droplets per inch along its axes, the part of its tray that can be printed on, and the slices that
/// it takes. The defaults are those of the thesis' printer (2.2.1) and its build area.
struct Printer {
  int dpi_x = thesis::kPrinterResolutionX;
  int dpi_y = thesis::kPrinterResolutionY;
  int dpi_z = thesis::kPrinterResolutionZ;
  double tray_x_mm = thesis::kTrayX;
  double tray_y_mm = thesis::kTrayY;
  SlicePixels pixels = SlicePixels::indexed;
  bool operator==(const Printer&) const = default;
};

/// A printer that is chosen by name (docs/printing.md).
struct NamedPrinter {
  std::string_view name;
  std::string_view words;  ///< for a person who chooses
  Printer printer;
};

/// The first one is that of the thesis.
std::span<const NamedPrinter> named_printers();

/// Throws InputError listing the names.
const NamedPrinter& printer_of_name(std::string_view name);

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
