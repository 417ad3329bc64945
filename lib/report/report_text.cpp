#include "report/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "material/effect_words.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

constexpr std::size_t kLongName = 20, kShownOfLongName = 9;

/// A hyphen is too short for a minus.
std::string with_minus(std::string text) { return text.starts_with('-') ? "−" + text.substr(1) : text; }

std::string superscript(int exponent) {
  static constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

/// Decimals that show `digits` significant ones.
int decimals_for(double value, int digits) {
  if (value == 0.0) return 0;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12)), 0, 9);
}

}  // namespace

std::string figure(double value) {
  if (!std::isfinite(value)) return std::string(kDash);
  return with_minus(fmt::format("{:.{}f}", value, std::min(decimals_for(value, 3), 6)));
}

std::string percent(double share) {
  if (!std::isfinite(share)) return std::string(kDash);
  return with_minus(fmt::format("{:.{}f} %", 100.0 * share, std::abs(share) < 1.0 ? 1 : 0));
}

std::string percent_or_dash(const std::optional<double>& share) { return share ? percent(*share) : std::string(kDash); }

std::string gpa(double pa) { return figure(pa * 1e-9); }

std::string mpa(double pa) { return figure(pa * 1e-6); }

std::string with_error(double value, double error) {
  if (!std::isfinite(value) || !std::isfinite(error) || !(error > 0.0)) return figure(value);
  const int decimals = std::min(decimals_for(error, 2), decimals_for(value, 4));
  return with_minus(fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals));
}

std::string chance(double p) {
  if (!std::isfinite(p)) return std::string(kDash);
  return p < 0.001 ? "&lt; 0.001" : fmt::format("{:.3f}", p);
}

std::string quantity(double value) {
  if (!std::isfinite(value)) return std::string(kDash);
  const double size = std::abs(value);
  if (size == 0.0 || (size >= 1e-3 && size < 1e4)) return figure(value);
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-12));
  return with_minus(fmt::format("{:.2f} × 10{}", value / std::pow(10.0, exponent), superscript(exponent)));
}

std::string shortened(std::string_view name) {
  return name.size() <= kLongName ? std::string(name) : fmt::format("{}…", name.substr(0, kShownOfLongName));
}

std::string effect_name(const std::string& name) { return escaped(material::effect_in_words(name)); }

std::string design_name(std::string_view name) {
  const std::string shown = shortened(name);
  if (shown == name) return fmt::format("<code>{}</code>", escaped(name));
  return fmt::format("<code title=\"{}\">{}</code>", escaped(name), escaped(shown));
}

}  // namespace nacre::report
