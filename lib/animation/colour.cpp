#include "animation/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pattern/phase_colours.hpp"

namespace nacre::animation {
namespace {

using Three = std::array<double, 3>;

/// OKLab (B. Ottosson 2020) to linear sRGB and back.
Three linear_of(const Three& lab) {
  const double l = lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2];
  const double m = lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2];
  const double s = lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2];
  const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
          -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
          -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

Three lab_of(const Three& linear) {
  const double l = std::cbrt(0.4122214708 * linear[0] + 0.5363325363 * linear[1] + 0.0514459929 * linear[2]);
  const double m = std::cbrt(0.2119034982 * linear[0] + 0.6806995451 * linear[1] + 0.1073969566 * linear[2]);
  const double s = std::cbrt(0.0883024619 * linear[0] + 0.2817188376 * linear[1] + 0.6299787005 * linear[2]);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
double decoded(double value) { return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); }

std::uint32_t packed(const Three& linear) {
  std::uint32_t rgb = 0;
  for (const double value : linear)
    rgb = rgb << 8 | static_cast<std::uint32_t>(std::lround(255.0 * encoded(std::clamp(value, 0.0, 1.0))));
  return rgb;
}

Three unpacked(std::uint32_t rgb) {
  return {decoded((rgb >> 16 & 0xff) / 255.0), decoded((rgb >> 8 & 0xff) / 255.0), decoded((rgb & 0xff) / 255.0)};
}

bool shown(const Three& linear) {
  return std::all_of(linear.begin(), linear.end(), [](double v) { return v >= -1e-4 && v <= 1.0 + 1e-4; });
}

}  // namespace

std::uint32_t rgb_of(const Lch& colour) {
  const double hue = colour.hue_deg * std::numbers::pi / 180.0;
  Three linear{};
  for (double chroma = colour.chroma;; chroma -= 0.002) {
    chroma = std::max(chroma, 0.0);
    linear = linear_of({colour.lightness, chroma * std::cos(hue), chroma * std::sin(hue)});
    if (chroma == 0.0 || shown(linear)) return packed(linear);
  }
}

std::uint32_t blend(std::uint32_t a, std::uint32_t b, double share) {
  const Three from = lab_of(unpacked(a)), to = lab_of(unpacked(b));
  Three mixed{};
  for (std::size_t i = 0; i < 3; ++i) mixed[i] = from[i] + share * (to[i] - from[i]);
  return packed(linear_of(mixed));
}

std::uint32_t glow(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return rgb_of({.lightness = 0.30 + 0.66 * t, .chroma = 0.20 - 0.06 * t * t, .hue_deg = -62.0 + 168.0 * t});
}

std::uint32_t element_colour(int phase, double energy_level) {
  constexpr std::array kPhases = {pattern::kSoftRgb, pattern::kRigidRgb, pattern::kInterfaceRgb};
  constexpr double kBegin = 0.32, kFull = 0.62, kTop = 0.92;  // the last decade fraction: single elements
  const double rise = std::clamp((energy_level - kBegin) / (kFull - kBegin), 0.0, 1.0);
  const double cover = rise * rise * (3.0 - 2.0 * rise);
  return blend(kPhases[std::clamp(phase, 0, 2)], glow((energy_level - kBegin) / (kTop - kBegin)), cover);
}

}  // namespace nacre::animation
