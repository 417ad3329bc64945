#include "fabricate/price.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/counted.hpp"

namespace nacre::fabricate {
namespace {

constexpr double kMinutesPerHour = 60.0, kCubicMmPerMl = 1000.0, kMmPerUm = 1e-3;

double outline_mm2(SpecimenKind kind, const NotchOptions& notch) {
  constexpr int kSteps = 20'000;
  const double step_mm = kMmPerUm * static_cast<double>(geometry_of(kind).length_um) / kSteps;
  double area_mm2 = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const auto [begin, end] = solid_across(kind, (i + 0.5) * step_mm, notch);
    area_mm2 += step_mm * std::max(0.0, end - begin);
  }
  return area_mm2;
}

std::string hours(double h) { return fmt::format("{:.{}f} h", h, h < 9.95 ? 1 : 0); }

}  // namespace

Price price_of(const Job& job) {
  const Rates& rates = job.request.rates;
  const Printer& printer = job.request.printer;
  std::map<SpecimenKind, double> outlines_mm2;
  std::map<int, int> layers;  // by tray
  double volume_mm3 = 0.0;
  for (const PlacedSpecimen& specimen : job.specimens) {
    const SpecimenPlan& plan = job.models[specimen.model].plan;
    const auto [outline, is_new] = outlines_mm2.try_emplace(plan.kind, 0.0);
    if (is_new) outline->second = outline_mm2(plan.kind, plan.notch);
    const int own_layers = layers_of(plan.thickness_mm, printer);
    layers[specimen.tray] = std::max(layers[specimen.tray], own_layers);
    volume_mm3 += outline->second * own_layers * pitch_mm(printer.dpi_z);
  }
  Price price{.specimens = static_cast<int>(job.specimens.size()), .trays = job.trays};
  for (const auto& [tray, count] : layers) price.slices += count;
  price.printing_h = price.slices / rates.layers_per_minute / kMinutesPerHour;
  price.testing_h = price.specimens * rates.minutes_per_test / kMinutesPerHour;
  price.resin_ml = volume_mm3 / kCubicMmPerMl;
  return price;
}

std::string in_words(const Price& price) {
  return fmt::format("{} on {}, {}, about {} of printing, {} of testing, {:.0f} ml of resin",
                     counted(price.specimens, "specimen"), counted(price.trays, "tray"), counted(price.slices, "slice"),
                     hours(price.printing_h), hours(price.testing_h), price.resin_ml);
}

}  // namespace nacre::fabricate
