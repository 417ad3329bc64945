#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"
#include "commands.hpp"
#include "explore/gamut_csv.hpp"
#include "growth.hpp"
#include "predicted.hpp"
#include "report/standalone.hpp"
#include "report/svg.hpp"

namespace nacre::search_study {
namespace {

/// Those that differ most come first.
constexpr report::Ink kInks[] = {report::Ink::measured, report::Ink::simulated,   report::Ink::family_3,
                                 report::Ink::family_4, report::Ink::homogeneous, report::Ink::family_5,
                                 report::Ink::family_6, report::Ink::family_2};

/// Mean and range over the seeds, against samples in thousands.
struct Curve {
  std::vector<report::PlotPoint> mean, low, high;
};

/// As far as every seed has run and no farther than `most`.
Curve curve_of(const std::vector<Growth>& growths, int most) {
  for (const Growth& growth : growths) most = std::min(most, growth.rbegin()->first);
  Curve curve;
  for (const auto& [samples, step] : growths.front()) {
    if (samples > most) break;
    std::vector<double> at;
    for (const Growth& growth : growths) at.push_back(hypervolume_at(growth, samples));
    const double x = samples / 1000.0;
    curve.mean.push_back({x, mean(at)});
    curve.low.push_back({x, *std::min_element(at.begin(), at.end())});
    curve.high.push_back({x, *std::max_element(at.begin(), at.end())});
  }
  return curve;
}

/// Predicted against simulated, on samples learnt from and on those asked for next.
std::string predicted_figure(const std::vector<report::PlotPoint>& learnt, const std::vector<report::PlotPoint>& next,
                             const std::string& title, const std::string& quantity) {
  std::vector<double> all;
  for (const auto* points : {&learnt, &next})
    for (const report::PlotPoint& point : *points) all.insert(all.end(), {point.x, point.y});
  const report::Range range = report::range_with_zero(all);
  report::Plot plot(
      {.title = title, .x_label = quantity + ", simulated", .y_label = "predicted", .x = range, .y = range});
  plot.cloud(learnt, report::Ink::simulated, "learnt from");
  plot.rings(next, report::Ink::measured, "asked for next");
  plot.line(std::vector<report::PlotPoint>{{range.low, range.low}, {range.high, range.high}}, report::Ink::earlier,
            report::Stroke::dashed, "");
  return report::standalone(plot.svg());
}

void write_figure(const std::filesystem::path& path, const std::string& svg) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  write_file_atomically(path, svg);
  fmt::print("{}\n", path.string());
}

}  // namespace

void draw_growth(const Options& options) {
  std::vector<Curve> curves;
  std::vector<double> all;
  for (const std::string& variant : options.variants) {
    const std::vector<Growth> growths = growths_of(options, variant);
    if (growths.empty()) throw InputError::format("no run of {} in {}", variant, options.work);
    curves.push_back(curve_of(growths, options.most));
    for (const report::PlotPoint& point : curves.back().high) all.push_back(point.y);
  }
  report::Plot plot({.title = "Growth of the gamut",
                     .x_label = "simulations, thousands",
                     .y_label = "hypervolume, GPa MPa",
                     .x = {0.0, options.most / 1000.0},
                     .y = report::range_with_zero(all),
                     .width = 640,
                     .height = 380});
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const report::Ink ink = kInks[i % std::size(kInks)];
    plot.band(curves[i].low, curves[i].high, ink, "");
    plot.line(curves[i].mean, ink, report::Stroke::solid, options.variants[i]);
  }
  write_figure(options.out, report::standalone(plot.svg()));
}

void draw_predicted(const Options& options) {
  const auto gamut = explore::read_gamut_csv(run_path(options, options.variant, options.first_seed) + "-gamut.csv");
  const auto learnt = static_cast<std::size_t>(options.checkpoints.front());
  if (learnt >= gamut.size())
    throw InputError::format("{} samples in the run, {} to be learnt from", gamut.size(), learnt);
  const Predicted predicted = predict(options, options.first_seed, gamut, learnt);
  const auto draw = [&](double optimize::Performance::*property, double unit, const std::string& title,
                        const std::string& quantity, const std::string& suffix) {
    std::vector<report::PlotPoint> known, next;
    for (std::size_t i = 0; i < predicted.samples.size(); ++i)
      (i < learnt ? known : next)
          .push_back({predicted.samples[i].performance.*property / unit, predicted.predicted[i].*property / unit});
    write_figure(options.out + suffix, predicted_figure(known, next, title, quantity));
  };
  draw(&optimize::Performance::modulus_pa, 1e9, fmt::format("Modulus, {} learnt from", learnt), "E, GPa",
       "-modulus.svg");
  draw(&optimize::Performance::toughness_pa, 1e6, fmt::format("Toughness, {} learnt from", learnt), "T, MPa",
       "-toughness.svg");
}

}  // namespace nacre::search_study
