#include "fabricate/slice_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "pattern/phase_colours.hpp"

namespace nacre::fabricate {
namespace {

using Channels = std::array<double, 3>;  ///< red, green, blue, 0 to 255
constexpr Channels channels_of(std::uint32_t rgb) {
  return {static_cast<double>(rgb >> 16 & 0xff), static_cast<double>(rgb >> 8 & 0xff), static_cast<double>(rgb & 0xff)};
}
std::uint32_t packed_rgb(const Channels& colour) {
  std::uint32_t rgb = 0;
  for (const double channel : colour) rgb = rgb << 8 | static_cast<std::uint32_t>(std::lround(channel));
  return rgb;
}

constexpr Channels kVoid = channels_of(pattern::kNotPrintedRgb), kSoft = channels_of(pattern::kSoftRgb),
                   kRigid = channels_of(pattern::kRigidRgb);

/// Mean colour of the droplets whose centre lies between two positions either way, at least the nearest one.
Channels mean_colour(const DropletPlan& plan, const Slice& slice, const SliceRectangle& part) {
  const auto range = [](double from_mm, double length_mm, double pitch, int droplets) {
    const int first = std::clamp(static_cast<int>(from_mm / pitch), 0, droplets - 1);
    const int last = std::clamp(static_cast<int>((from_mm + length_mm) / pitch), first + 1, droplets);
    return std::pair(first, std::max(first + 1, last));
  };
  const auto [first_column, end_column] = range(part.left_mm, part.width_mm, plan.x().pitch(), slice.columns);
  const auto [first_row, end_row] = range(part.top_mm, part.height_mm, plan.y().pitch(), slice.rows);
  Channels sum{};
  for (int row = first_row; row < end_row; ++row) {
    for (int column = first_column; column < end_column; ++column) {
      const Droplet droplet = slice.at(column, row);
      const Channels& colour = droplet == Droplet::none ? kVoid : droplet == Droplet::soft ? kSoft : kRigid;
      for (std::size_t i = 0; i < 3; ++i) sum[i] += colour[i];
    }
  }
  for (double& channel : sum) channel /= double(end_row - first_row) * (end_column - first_column);
  return sum;
}

}  // namespace

SliceRectangle whole_of(const DropletPlan& plan) {
  return {0.0, 0.0, plan.columns() * plan.x().pitch(), plan.rows() * plan.y().pitch()};
}

void draw_slice(animation::Picture& picture, const DropletPlan& plan, const Slice& slice, const SliceRectangle& part,
                int left, int top, double points_per_mm) {
  const int width = static_cast<int>(part.width_mm * points_per_mm);
  const int height = static_cast<int>(part.height_mm * points_per_mm);
  const double point_mm = 1.0 / points_per_mm;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const SliceRectangle point{part.left_mm + x * point_mm, part.top_mm + y * point_mm, point_mm, point_mm};
      const std::size_t at = std::size_t(top + y) * std::size_t(picture.width) + std::size_t(left + x);
      picture.rgb[at] = packed_rgb(mean_colour(plan, slice, point));
    }
  }
}

void draw_legend(animation::Canvas& canvas, double left, double top) {
  constexpr double kSwatch = 22.0, kRow = 32.0;
  constexpr std::pair<std::uint32_t, const char*> kEntries[] = {
      {pattern::kRigidRgb, "rigid"}, {pattern::kSoftRgb, "soft"}, {pattern::kNotPrintedRgb, "not printed"}};
  double y = top;
  for (const auto& [rgb, name] : kEntries) {
    canvas.rectangle({left, y}, kSwatch, kSwatch, rgb);
    canvas.text({left + kSwatch + 10.0, y + 0.8 * kSwatch}, name, {.size = kSwatch});
    y += kRow;
  }
}

void draw_scale_bar(animation::Canvas& canvas, double left, double top, double length_mm, double points_per_mm) {
  constexpr double kThickness = 5.0, kTextSize = 20.0;
  constexpr std::uint32_t kInk = 0x202020;
  const double length = length_mm * points_per_mm;
  canvas.rectangle({left, top}, length, kThickness, kInk);
  canvas.text({left + length / 2, top + kThickness + kTextSize}, fmt::format("{:g} mm", length_mm),
              {.size = kTextSize, .rgb = kInk, .anchor = animation::TextAnchor::centre});
}

}  // namespace nacre::fabricate
