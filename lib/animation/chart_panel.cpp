#include "animation/chart_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "animation/panels.hpp"

namespace nacre::animation {
namespace {

constexpr double kChartLeft = 690.0, kChartRight = 932.0, kChartTop = 104.0, kChartBottom = 346.0;
constexpr std::uint32_t kAhead = 0xb4bcc7, kPassedArea = 0xd9f1fa;

/// Distance of ticks for an axis of this length: 1, 2 or 5 times a power of ten, at most six of them.
double tick_distance(double length) {
  const double decade = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0})
    if (length / (factor * decade) <= 6.0) return factor * decade;
  return 50.0 * decade;
}

struct ChartAxes {
  double strain_percent = 1.0, stress_mpa = 1.0;  ///< at the far ends

  explicit ChartAxes(const film::Film& film) {
    const auto& stress = film.curve.stress_pa;
    const double highest = stress.empty() ? 0.0 : *std::max_element(stress.begin(), stress.end());
    strain_percent = std::max(100.0 * film.failure_strain, 1e-3) * 1.04;
    stress_mpa = std::max({1e-6 * highest, 1e-6 * film.peak_stress_pa, 1e-6}) * 1.1;
  }
  CanvasPoint at(double strain, double stress_pa) const {
    const double x = kChartLeft + (kChartRight - kChartLeft) * 100.0 * strain / strain_percent;
    const double y = kChartBottom - (kChartBottom - kChartTop) * 1e-6 * std::max(stress_pa, 0.0) / stress_mpa;
    return {x, y};
  }
};

void draw_axes(Canvas& canvas, const ChartAxes& axes) {
  const TextStyle number{.size = 12.0, .rgb = kInk, .anchor = TextAnchor::centre};
  const TextStyle number_left{.size = 12.0, .rgb = kInk, .anchor = TextAnchor::right};
  const double across = tick_distance(axes.strain_percent), up = tick_distance(axes.stress_mpa);
  for (double value = 0.0; value <= axes.stress_mpa * 1.0001; value += up) {
    const double y = axes.at(0.0, 1e6 * value).y;
    const std::array<CanvasPoint, 2> rule = {{{kChartLeft, y}, {kChartRight, y}}};
    canvas.line(rule, 0.7, kRule);
    canvas.text({kChartLeft - 6.0, y + 4.3}, fmt::format("{:g}", std::round(value / up) * up), number_left);
  }
  for (double value = 0.0; value <= axes.strain_percent * 1.0001; value += across) {
    const double x = axes.at(0.01 * value, 0.0).x;
    const std::array<CanvasPoint, 2> tick = {{{x, kChartBottom}, {x, kChartBottom + 4.0}}};
    canvas.line(tick, 1.0, kInk);
    canvas.text({x, kChartBottom + 18.0}, fmt::format("{:g}", std::round(value / across) * across), number);
  }
  const std::array<CanvasPoint, 3> frame = {
      {{kChartLeft, kChartTop - 6.0}, {kChartLeft, kChartBottom}, {kChartRight, kChartBottom}}};
  canvas.line(frame, 1.2, kInk);
  const TextStyle label{.size = 13.0, .rgb = kInk, .anchor = TextAnchor::centre};
  canvas.text({0.5 * (kChartLeft + kChartRight), kChartBottom + 38.0}, "nominal strain in %", label);
  TextStyle turned = label;
  turned.upwards = true;
  canvas.text({kChartLeft - 38.0, 0.5 * (kChartTop + kChartBottom)}, "nominal stress in MPa", turned);
}

/// The curve up to a strain, which becomes its last point.
std::vector<CanvasPoint> curve_until(const film::Film& film, const ChartAxes& axes, const film::FilmFrame& frame) {
  std::vector<CanvasPoint> points;
  for (std::size_t i = 0; i < film.curve.size() && film.curve.strain[i] < frame.strain; ++i)
    points.push_back(axes.at(film.curve.strain[i], film.curve.stress_pa[i]));
  points.push_back(axes.at(frame.strain, frame.stress_pa));
  return points;
}

void draw_curve(Canvas& canvas, const film::Film& film, const ChartAxes& axes, const film::FilmFrame& frame) {
  std::vector<CanvasPoint> whole;
  for (std::size_t i = 0; i < film.curve.size(); ++i)
    whole.push_back(axes.at(film.curve.strain[i], film.curve.stress_pa[i]));
  std::vector<CanvasPoint> passed = curve_until(film, axes, frame);
  std::vector<CanvasPoint> under = passed;
  under.push_back({passed.back().x, kChartBottom});
  under.push_back({passed.front().x, kChartBottom});
  canvas.area(under, kPassedArea);
  draw_axes(canvas, axes);
  canvas.line(whole, 1.6, kAhead);
  canvas.line(passed, 2.2, kInk);
  canvas.disc(passed.back(), 6.0, kPage);
  canvas.disc(passed.back(), 4.6, kAccent);
}

/// Energy absorbed so far: the area under the curve.
double absorbed_pa(const film::Film& film, const film::FilmFrame& frame) {
  tester::Curve passed;
  for (std::size_t i = 0; i < film.curve.size() && film.curve.strain[i] < frame.strain; ++i) {
    passed.strain.push_back(film.curve.strain[i]);
    passed.stress_pa.push_back(film.curve.stress_pa[i]);
  }
  passed.strain.push_back(frame.strain);
  passed.stress_pa.push_back(frame.stress_pa);
  return tester::area_under(passed);
}

void draw_figures(Canvas& canvas, const film::Film& film, const film::FilmFrame& frame) {
  const std::array<std::array<std::string, 2>, 4> now = {
      {{"strain", fmt::format("{:.2f} %", 100.0 * frame.strain)},
       {"stress", fmt::format("{:.2f} MPa", 1e-6 * std::max(0.0, frame.stress_pa))},
       {"failed elements", fmt::format("{}", frame.broken)},
       {"energy absorbed", fmt::format("{:.3f} MJ/m\u00b3", 1e-6 * absorbed_pa(film, frame))}}};
  double y = 418.0;
  for (const auto& [name, value] : now) {
    canvas.text({kChartLeft - 44.0, y}, name, {.size = 13.0, .rgb = kFaint});
    canvas.text({kChartRight, y}, value, {.size = 13.0, .rgb = kInk, .anchor = TextAnchor::right});
    y += 20.0;
  }
  const std::array<CanvasPoint, 2> rule = {{{kChartLeft - 44.0, y - 10.0}, {kChartRight, y - 10.0}}};
  canvas.line(rule, 0.7, kRule);
  canvas.text({kChartLeft - 44.0, 506.0}, "toughness", {.size = 13.0, .rgb = kInk, .bold = true});
  canvas.text({kChartRight, 506.0}, fmt::format("{:.3f} MJ/m\u00b3", 1e-6 * film.toughness_pa),
              {.size = 13.0, .rgb = kInk, .bold = true, .anchor = TextAnchor::right});
}

}  // namespace

void draw_chart(Canvas& canvas, const film::Film& film, int index) {
  const film::FilmFrame& frame = film.frames[index];
  draw_curve(canvas, film, ChartAxes(film), frame);
  draw_figures(canvas, film, frame);
}

}  // namespace nacre::animation
