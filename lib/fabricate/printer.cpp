#include "fabricate/printer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/result.hpp"

namespace nacre::fabricate {
namespace {

/// Of a printer for GrabCAD Voxel Print, which counts 600 x 300 droplets an inch in x and y; tray of the J750 and J850.
constexpr Printer voxel_print(int dpi_z) {
  return {
      .dpi_x = 600, .dpi_y = 300, .dpi_z = dpi_z, .tray_x_mm = 490.0, .tray_y_mm = 390.0, .pixels = SlicePixels::rgba};
}

constexpr std::array kPrinters = {
    NamedPrinter{"thesis", "the thesis' printer: 300 x 600 x 800 dpi, indexed slices, tray of 255 x 252 mm", {}},
    NamedPrinter{"voxel-print-27um", "GrabCAD Voxel Print, High Speed or High Mix: 600 x 300 dpi, layers of 27 um",
                 voxel_print(941)},
    NamedPrinter{"voxel-print-14um", "GrabCAD Voxel Print, High Quality: 600 x 300 dpi, layers of 14 um",
                 voxel_print(1814)}};

}  // namespace

std::span<const NamedPrinter> named_printers() { return kPrinters; }

const NamedPrinter& printer_of_name(std::string_view name) {
  const auto named = std::ranges::find(kPrinters, name, &NamedPrinter::name);
  if (named != kPrinters.end()) return *named;
  std::string names;
  for (const NamedPrinter& each : kPrinters) names += fmt::format("{}{}", names.empty() ? "" : ", ", each.name);
  throw InputError::format("printer `{}`: expected one of {}", name, names);
}

int layers_of(double thickness_mm, const Printer& printer) {
  return std::max(1, static_cast<int>(std::lround(thickness_mm / pitch_mm(printer.dpi_z))));
}

void check_printer(const Printer& printer) {
  for (const int dpi : {printer.dpi_x, printer.dpi_y, printer.dpi_z}) {
    if (dpi < kLowestDpi || dpi > kHighestDpi) {
      throw InputError::format("printer resolution {} dpi: expected {} to {}", dpi, kLowestDpi, kHighestDpi);
    }
  }
  for (const double side_mm : {printer.tray_x_mm, printer.tray_y_mm}) {
    if (!(side_mm >= 10.0 && side_mm <= 10'000.0)) {
      throw InputError::format("tray of {} mm: expected 10 to 10000 mm", side_mm);
    }
  }
}

}  // namespace nacre::fabricate
