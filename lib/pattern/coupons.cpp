#include "pattern/coupons.hpp"

#include <charconv>
#include <vector>

#include "base/result.hpp"

namespace nacre::pattern {
namespace {

/// The parts between colons.
std::vector<std::string_view> split_name(std::string_view name) {
  std::vector<std::string_view> parts;
  for (std::size_t colon = name.find(':'); colon != std::string_view::npos; colon = name.find(':')) {
    parts.push_back(name.substr(0, colon));
    name.remove_prefix(colon + 1);
  }
  parts.push_back(name);
  return parts;
}

/// A number of pixels; 0 where there is none that a unit holds.
int pixels_of(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_one = error == std::errc{} && end == text.data() + text.size() && value <= kSide;
  return is_one ? value : 0;
}

}  // namespace

Layout laminate(LayerDirection direction, int rigid_pixels, int soft_pixels) {
  const int period = rigid_pixels + soft_pixels;
  if (rigid_pixels < 1 || soft_pixels < 1 || kSide % period != 0) {
    throw InputError::format(
        "laminate of {} rigid and {} soft pixels: expected at least 1 of each and a sum that divides {}", rigid_pixels,
        soft_pixels, kSide);
  }
  Layout layout;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const int across = direction == LayerDirection::along_x ? r : c;
      layout.set(r, c, across % period < rigid_pixels);
    }
  }
  return layout;
}

Layout checkerboard(int period) {
  if (period < 1 || kSide % (2 * period) != 0) {
    throw InputError::format("checkerboard of period {}: expected 1, 2, 5 or 10 pixels", period);
  }
  Layout layout;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) layout.set(r, c, (r / period + c / period) % 2 == 0);
  }
  return layout;
}

std::optional<Result<Layout>> coupon_from_name(std::string_view name) {
  const std::vector<std::string_view> parts = split_name(name);
  if (parts[0] != "checkerboard" && parts[0] != "laminate") return std::nullopt;
  try {
    if (parts[0] == "checkerboard" && parts.size() == 2) return checkerboard(pixels_of(parts[1]));
    if (parts[0] == "laminate" && parts.size() == 4 && (parts[1] == "x" || parts[1] == "y")) {
      return laminate(parts[1] == "x" ? LayerDirection::along_x : LayerDirection::along_y, pixels_of(parts[2]),
                      pixels_of(parts[3]));
    }
  } catch (const InputError& error) {
    return Result<Layout>(fail("\"{}\": {}", name, error.what()));
  }
  return Result<Layout>(fail("\"{}\": expected checkerboard:PERIOD or laminate:x|y:RIGID:SOFT, in pixels", name));
}

std::optional<std::string> coupon_name(const Layout& layout) {
  for (const int period : {1, 2, 5, 10}) {
    if (layout == checkerboard(period)) return "checkerboard:" + std::to_string(period);
  }
  for (const int period : {2, 4, 5, 10, 20}) {
    for (int rigid = 1; rigid < period; ++rigid) {
      const std::string layers = std::to_string(rigid) + ":" + std::to_string(period - rigid);
      if (layout == laminate(LayerDirection::along_x, rigid, period - rigid)) return "laminate:x:" + layers;
      if (layout == laminate(LayerDirection::along_y, rigid, period - rigid)) return "laminate:y:" + layers;
    }
  }
  return std::nullopt;
}

std::string readable_name(const Design& design) {
  const Layout* layout = design.layout();
  return layout == nullptr ? design.name() : coupon_name(*layout).value_or(design.name());
}

}  // namespace nacre::pattern
