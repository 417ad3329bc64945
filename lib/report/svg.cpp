#include "report/svg.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/names.hpp"

namespace nacre::report {
namespace {

// Sizes in px.
constexpr int kLeft = 50, kRight = 12, kTop = 28, kBottom = 42;
constexpr int kTickSpacingX = 60, kTickSpacingY = 38;  // about
constexpr int kLegendRow = 17, kLegendSample = 26, kLegendGap = 14;
constexpr double kCharacterWidth = 6.7;  // of the 11 px legend, on average
constexpr double kDot = 3.4;
constexpr double kIndistinct = 0.35;  // closer points look like one

bool is_finite(const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string_view ink_class(Ink ink) {
  switch (ink) {
    case Ink::simulated:
      return "sim";
    case Ink::measured:
      return "meas";
    case Ink::earlier:
      return "earlier";
    case Ink::homogeneous:
      return "homo";
    case Ink::thesis:
      return "thes";
    case Ink::family_1:
      return "fam1";
    case Ink::family_2:
      return "fam2";
    case Ink::family_3:
      return "fam3";
    case Ink::family_4:
      return "fam4";
    case Ink::family_5:
      return "fam5";
    case Ink::family_6:
      return "fam6";
  }
  return "";
}

std::string_view stroke_class(Stroke stroke) {
  switch (stroke) {
    case Stroke::solid:
      return "line";
    case Stroke::thin:
      return "line thin";
    case Stroke::dashed:
      return "line dashed";
  }
  return "";
}

/// Distance of the ticks: 1, 2 or 5 times a power of ten.
double tick_step(const Range& range, int wanted) {
  const double rough = (range.high - range.low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

bool is_empty(const Range& range) { return !(range.high > range.low) || !std::isfinite(range.high - range.low); }

/// Ticks with as many decimals as their distance needs.
std::string tick_text(double value, const std::vector<double>& ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos ? "0" : text;
}

std::string text_at(double x, double y, std::string_view classes, std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>", x, y, classes, escaped(text));
}

std::string sample_line(Ink ink, std::string_view classes) {
  return fmt::format("<path class=\"{} {}\" d=\"M0 0h18\"/>", ink_class(ink), classes);
}

}  // namespace

Ink family_ink(std::size_t family) {
  constexpr std::size_t kInks = 6;
  return static_cast<Ink>(static_cast<std::size_t>(Ink::family_1) + family % kInks);
}

std::vector<double> round_ticks(const Range& range, int wanted) {
  if (is_empty(range) || wanted < 1) return {};
  const double step = tick_step(range, wanted);
  std::vector<double> ticks;
  const double tolerance = 1e-6;
  const auto first = static_cast<long>(std::ceil(range.low / step - tolerance));
  const auto last = static_cast<long>(std::floor(range.high / step + tolerance));
  for (long i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

Range range_with_zero(std::span<const double> values) {
  Range range{0.0, 0.0};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  const double margin = 0.05 * std::max(range.high, -range.low);
  if (margin == 0.0) return {0.0, 1.0};
  return {range.low < 0.0 ? range.low - margin : 0.0, range.high > 0.0 ? range.high + margin : 0.0};
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      case '\n':
      case '\t':
        safe += ' ';
        break;
      default:
        if (is_control(c)) {
          safe += "\uFFFD";
        } else {
          safe += c;
        }
    }
  }
  return safe;
}

Plot::Plot(Axes axes) : axes_(std::move(axes)) {
  if (is_empty(axes_.x)) axes_.x = {};
  if (is_empty(axes_.y)) axes_.y = {};
}

double Plot::px(double x) const {
  return (x - axes_.x.low) / (axes_.x.high - axes_.x.low) * (axes_.width - kLeft - kRight);
}

double Plot::py(double y) const {
  return (axes_.y.high - y) / (axes_.y.high - axes_.y.low) * (axes_.height - kTop - kBottom);
}

std::string Plot::path_of(std::span<const PlotPoint> points) const {
  std::string path;
  double last_x = 0.0, last_y = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) continue;
    const double x = px(points[i].x), y = py(points[i].y);
    const bool is_end = i + 1 == points.size();
    if (!path.empty() && !is_end && std::hypot(x - last_x, y - last_y) < kIndistinct) continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    last_x = x;
    last_y = y;
  }
  return path;
}

void Plot::cloud(std::span<const PlotPoint> points, Ink ink, std::string_view label) {
  std::string path;
  for (const PlotPoint& p : points) {
    if (is_finite(p)) path += fmt::format("M{:.1f} {:.1f}h0", px(p.x), py(p.y));
  }
  if (path.empty()) return;
  marks_ += fmt::format("<path class=\"{} cloud\" d=\"{}\"/>\n", ink_class(ink), path);
  add_to_legend(fmt::format("<path class=\"{} cloud\" d=\"M3 -2h0M9 2h0M15 -1h0\"/>", ink_class(ink)), label);
}

void Plot::coloured(std::span<const PlotPoint> points, std::span<const std::string> colours) {
  constexpr double kHalf = 1.9;
  for (std::size_t i = 0; i < points.size() && i < colours.size(); ++i) {
    if (!is_finite(points[i])) continue;
    marks_ += fmt::format("<path fill=\"{}\" d=\"M{:.1f} {:.1f}h{}v{}h-{}Z\"/>\n", escaped(colours[i]),
                          px(points[i].x) - kHalf, py(points[i].y) - kHalf, 2 * kHalf, 2 * kHalf, 2 * kHalf);
  }
}

void Plot::circles(std::span<const PlotPoint> points, Ink ink, std::string_view shape,
                   std::span<const std::string> hints) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) continue;
    const std::string hint =
        i < hints.size() && !hints[i].empty() ? fmt::format("<title>{}</title>", escaped(hints[i])) : "";
    marks_ += fmt::format("<circle class=\"{} {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\">{}</circle>\n", ink_class(ink),
                          shape, px(points[i].x), py(points[i].y), kDot, hint);
  }
}

void Plot::dots(std::span<const PlotPoint> points, Ink ink, std::string_view label,
                std::span<const std::string> hints) {
  if (points.empty()) return;
  circles(points, ink, "dot", hints);
  add_to_legend(fmt::format("<circle class=\"{} dot\" cx=\"9\" cy=\"0\" r=\"{}\"/>", ink_class(ink), kDot), label);
}

void Plot::rings(std::span<const PlotPoint> points, Ink ink, std::string_view label,
                 std::span<const std::string> hints) {
  if (points.empty()) return;
  circles(points, ink, "ring", hints);
  add_to_legend(fmt::format("<circle class=\"{} ring\" cx=\"9\" cy=\"0\" r=\"{}\"/>", ink_class(ink), kDot), label);
}

void Plot::error_bars(std::span<const PlotPoint> points, std::span<const PlotPoint> half_widths, Ink ink) {
  std::string path;
  for (std::size_t i = 0; i < points.size() && i < half_widths.size(); ++i) {
    const PlotPoint &p = points[i], &h = half_widths[i];
    if (!is_finite(p) || !is_finite(h)) continue;
    if (h.x > 0.0) path += fmt::format("M{:.1f} {:.1f}H{:.1f}", px(p.x - h.x), py(p.y), px(p.x + h.x));
    if (h.y > 0.0) path += fmt::format("M{:.1f} {:.1f}V{:.1f}", px(p.x), py(p.y - h.y), py(p.y + h.y));
  }
  if (!path.empty()) marks_ += fmt::format("<path class=\"{} bar\" d=\"{}\"/>\n", ink_class(ink), path);
}

void Plot::error_bars(std::span<const double> xs, std::span<const Range> ends, Ink ink) {
  std::string path;
  for (std::size_t i = 0; i < xs.size() && i < ends.size(); ++i)
    if (is_finite({xs[i], ends[i].low}) && is_finite({xs[i], ends[i].high}))
      path += fmt::format("M{:.1f} {:.1f}V{:.1f}", px(xs[i]), py(ends[i].low), py(ends[i].high));
  if (!path.empty()) marks_ += fmt::format("<path class=\"{} bar\" d=\"{}\"/>\n", ink_class(ink), path);
}

void Plot::line(std::span<const PlotPoint> points, Ink ink, Stroke stroke, std::string_view label) {
  const std::string path = path_of(points);
  if (path.empty()) return;
  marks_ += fmt::format("<path class=\"{} {}\" d=\"{}\"/>\n", ink_class(ink), stroke_class(stroke), path);
  add_to_legend(sample_line(ink, stroke_class(stroke)), label);
}

void Plot::staircase(std::span<const PlotPoint> front, Ink ink, std::string_view label) {
  if (front.empty()) return;
  std::vector<PlotPoint> steps = {{0.0, front.front().y}};
  for (std::size_t i = 0; i < front.size(); ++i) {
    steps.push_back(front[i]);
    steps.push_back({front[i].x, i + 1 < front.size() ? front[i + 1].y : 0.0});
  }
  std::string path;  // every corner, however near to the last one: a line that leaves one out would slope
  for (const PlotPoint& p : steps) {
    if (is_finite(p)) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px(p.x), py(p.y));
  }
  if (path.empty()) return;
  marks_ += fmt::format("<path class=\"{} line steps\" d=\"{}\"/>\n", ink_class(ink), path);
  add_to_legend(fmt::format("<path class=\"{} line steps\" d=\"M0 -4h9v8h9\"/>", ink_class(ink)), label);
}

void Plot::band(std::span<const PlotPoint> lower, std::span<const PlotPoint> upper, Ink ink, std::string_view label) {
  std::vector<PlotPoint> outline(upper.begin(), upper.end());
  outline.insert(outline.end(), lower.rbegin(), lower.rend());
  const std::string path = path_of(outline);
  if (path.empty()) return;
  marks_ += fmt::format("<path class=\"{} band\" d=\"{}Z\"/>\n", ink_class(ink), path);
  add_to_legend(fmt::format("<path class=\"{} band\" d=\"M0 -5h18v10h-18Z\"/>", ink_class(ink)), label);
}

void Plot::zero_line() { marks_ += fmt::format("<path class=\"axis\" d=\"M0 {:.1f}H{}\"/>\n", py(0.0), axes_.width); }

void Plot::add_to_legend(std::string sample, std::string_view label) {
  if (!label.empty()) legend_.push_back({std::move(sample), std::string(label)});
}

std::string Plot::axes_svg() const {
  const int width = axes_.width - kLeft - kRight, height = axes_.height - kTop - kBottom;
  std::string text = text_at(kLeft, 16, "title", axes_.title);
  const std::vector<double> y_ticks = round_ticks(axes_.y, height / kTickSpacingY);
  for (const double tick : y_ticks) {
    const double y = kTop + py(tick);
    text += fmt::format("<path class=\"grid\" d=\"M{} {:.1f}h{}\"/>", kLeft, y, width);
    text += text_at(kLeft - 6, y + 3.5, "tick end", tick_text(tick, y_ticks));
  }
  std::vector<double> x_ticks = axes_.x_ticks.empty() ? round_ticks(axes_.x, width / kTickSpacingX) : axes_.x_ticks;
  if (axes_.whole_numbers_x) std::erase_if(x_ticks, [](double t) { return std::abs(t - std::round(t)) > 1e-6; });
  for (const double tick : x_ticks) {
    const double x = kLeft + px(tick);
    text += fmt::format("<path class=\"grid\" d=\"M{:.1f} {}v{}\"/>", x, kTop, height);
    text += text_at(x, kTop + height + 15, "tick middle", tick_text(tick, x_ticks));
  }
  text += fmt::format("<path class=\"axis\" d=\"M{0} {1}V{2}H{3}\"/>", kLeft, kTop, kTop + height, kLeft + width);
  text += text_at(kLeft + width / 2.0, kTop + height + 33, "label middle", axes_.x_label);
  text += fmt::format("<text transform=\"translate(12 {:.1f}) rotate(-90)\" class=\"label middle\">{}</text>\n",
                      kTop + height / 2.0, escaped(axes_.y_label));
  return text;
}

std::string Plot::legend_svg(int& rows) const {
  std::string text;
  double x = kLeft;
  rows = legend_.empty() ? 0 : 1;
  for (const LegendEntry& entry : legend_) {
    const double length = kLegendSample + kCharacterWidth * static_cast<double>(entry.label.size());
    if (x > kLeft && x + length > axes_.width - 2) {
      x = kLeft;
      ++rows;
    }
    const double y = axes_.height + kLegendRow * (rows - 1) + 6;
    text += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">{}{}</g>\n", x, y, entry.sample,
                        text_at(kLegendSample, 3.5, "key", entry.label));
    x += length + kLegendGap;
  }
  return text;
}

std::string Plot::svg() const {
  int rows = 0;
  const std::string legend = legend_svg(rows);
  const int height = axes_.height + kLegendRow * rows;
  std::string text = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" aria-label=\"{2}\">\n",
      axes_.width, height, escaped(axes_.title));
  // A nested svg clips its content to the axes.
  text += axes_svg() +
          fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\n{}</svg>\n", kLeft, kTop,
                      axes_.width - kLeft - kRight, axes_.height - kTop - kBottom, marks_) +
          legend + "</svg>\n";
  return text;
}

}  // namespace nacre::report
