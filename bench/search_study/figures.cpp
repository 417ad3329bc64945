#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include "analyser/svg.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"
#include "commands.hpp"
#include "explore/gamut_csv.hpp"
#include "foretold.hpp"
#include "growth.hpp"

namespace nacre::search_study {
namespace {

/// Those that differ most come first.
constexpr analyser::Ink kInks[] = {analyser::Ink::measured, analyser::Ink::simulated,   analyser::Ink::family_3,
                                   analyser::Ink::family_4, analyser::Ink::homogeneous, analyser::Ink::family_5,
                                   analyser::Ink::family_6, analyser::Ink::family_2};

/// Mean and range over the seeds, against samples in thousands.
struct Curve {
  std::vector<analyser::Point> mean, low, high;
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
std::string predicted_figure(const std::vector<analyser::Point>& learnt, const std::vector<analyser::Point>& next,
                             const std::string& title, const std::string& quantity) {
  std::vector<double> all;
  for (const auto* points : {&learnt, &next})
    for (const analyser::Point& point : *points) all.insert(all.end(), {point.x, point.y});
  const analyser::Range range = analyser::range_with_zero(all);
  analyser::Plot plot(
      {.title = title, .x_label = quantity + ", simulated", .y_label = "predicted", .x = range, .y = range});
  plot.cloud(learnt, analyser::Ink::simulated, "learnt from");
  plot.rings(next, analyser::Ink::measured, "asked for next");
  plot.line(std::vector<analyser::Point>{{range.low, range.low}, {range.high, range.high}}, analyser::Ink::earlier,
            analyser::Stroke::dashed, "");
  return analyser::standalone(plot.svg());
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
    for (const analyser::Point& point : curves.back().high) all.push_back(point.y);
  }
  analyser::Plot plot({.title = "Growth of the gamut",
                       .x_label = "simulations, thousands",
                       .y_label = "hypervolume, GPa MPa",
                       .x = {0.0, options.most / 1000.0},
                       .y = analyser::range_with_zero(all),
                       .width = 640,
                       .height = 380});
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const analyser::Ink ink = kInks[i % std::size(kInks)];
    plot.band(curves[i].low, curves[i].high, ink, "");
    plot.line(curves[i].mean, ink, analyser::Stroke::solid, options.variants[i]);
  }
  write_figure(options.out, analyser::standalone(plot.svg()));
}

void draw_predicted(const Options& options) {
  const auto gamut = explore::read_gamut_csv(run_path(options, options.variant, options.first_seed) + "-gamut.csv");
  const auto learnt = static_cast<std::size_t>(options.checkpoints.front());
  if (learnt >= gamut.size())
    throw InputError::format("{} samples in the run, {} to be learnt from", gamut.size(), learnt);
  const Foretold foretold = foretell(options, options.first_seed, gamut, learnt);
  const auto draw = [&](double optimize::Performance::*property, double unit, const std::string& title,
                        const std::string& quantity, const std::string& suffix) {
    std::vector<analyser::Point> known, next;
    for (std::size_t i = 0; i < foretold.samples.size(); ++i)
      (i < learnt ? known : next)
          .push_back({foretold.samples[i].performance.*property / unit, foretold.predicted[i].*property / unit});
    write_figure(options.out + suffix, predicted_figure(known, next, title, quantity));
  };
  draw(&optimize::Performance::modulus_pa, 1e9, fmt::format("Modulus, {} learnt from", learnt), "E, GPa",
       "-modulus.svg");
  draw(&optimize::Performance::toughness_pa, 1e6, fmt::format("Toughness, {} learnt from", learnt), "T, MPa",
       "-toughness.svg");
}

}  // namespace nacre::search_study
