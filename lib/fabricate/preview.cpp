#include "fabricate/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "animation/canvas.hpp"
#include "pattern/phase_colours.hpp"

namespace nacre::fabricate {
namespace {

using Channels = std::array<double, 3>;  ///< red, green, blue, 0 to 255
constexpr Channels channels_of(std::uint32_t rgb) {
  return {static_cast<double>(rgb >> 16 & 0xff), static_cast<double>(rgb >> 8 & 0xff), static_cast<double>(rgb & 0xff)};
}
std::uint32_t packed(const Channels& colour) {
  std::uint32_t rgb = 0;
  for (const double channel : colour) rgb = rgb << 8 | static_cast<std::uint32_t>(std::lround(channel));
  return rgb;
}

constexpr Channels kVoid = channels_of(pattern::kNotPrintedRgb), kSoft = channels_of(pattern::kSoftRgb),
                   kRigid = channels_of(pattern::kRigidRgb);
constexpr int kLongSidePoints = 1040, kCloseUpPoints = 640, kMargin = 20;
constexpr double kCloseUpMm = 3.0;

/// A rectangle of the slice in mm.
struct SliceRectangle {
  double left_mm, top_mm, width_mm, height_mm;
};

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

void draw(animation::Picture& picture, const DropletPlan& plan, const Slice& slice, const SliceRectangle& part,
          int left, int top, double points_per_mm) {
  const int width = static_cast<int>(part.width_mm * points_per_mm);
  const int height = static_cast<int>(part.height_mm * points_per_mm);
  const double point_mm = 1.0 / points_per_mm;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const SliceRectangle point{part.left_mm + x * point_mm, part.top_mm + y * point_mm, point_mm, point_mm};
      const std::size_t at = std::size_t(top + y) * std::size_t(picture.width) + std::size_t(left + x);
      picture.rgb[at] = packed(mean_colour(plan, slice, point));
    }
  }
}

/// The legend, downwards from its upper left corner.
void draw_legend(animation::Canvas& canvas, int left, int top) {
  constexpr double kSwatch = 22.0, kRow = 32.0;
  constexpr std::pair<std::uint32_t, const char*> kEntries[] = {
      {pattern::kRigidRgb, "rigid"}, {pattern::kSoftRgb, "soft"}, {pattern::kNotPrintedRgb, "not printed"}};
  double y = top;
  for (const auto& [rgb, name] : kEntries) {
    canvas.rectangle({static_cast<double>(left), y}, kSwatch, kSwatch, rgb);
    canvas.text({left + kSwatch + 10.0, y + 0.8 * kSwatch}, name, {.size = kSwatch});
    y += kRow;
  }
}

}  // namespace

void write_preview(const DropletPlan& plan, const std::filesystem::path& path) {
  constexpr std::uint32_t kPaper = 0xffffff;
  const Slice slice = plan.slice(plan.layers() / 2);
  const SliceRectangle whole{0.0, 0.0, slice.columns * plan.x().pitch(), slice.rows * plan.y().pitch()};
  const double points_per_mm = kLongSidePoints / std::max(whole.width_mm, whole.height_mm);
  const int whole_width = static_cast<int>(whole.width_mm * points_per_mm);
  const int whole_height = static_cast<int>(whole.height_mm * points_per_mm);
  const int width = whole_width + kCloseUpPoints + 3 * kMargin;
  const int height = std::max(whole_height, kCloseUpPoints) + 2 * kMargin;
  const int close_up_left = whole_width + 2 * kMargin;
  animation::Canvas canvas(width, height, width);
  canvas.fill(kPaper);
  // Below the shorter of the two pictures.
  if (whole_height > kCloseUpPoints) {
    draw_legend(canvas, close_up_left, kCloseUpPoints + 2 * kMargin);
  } else {
    draw_legend(canvas, kMargin, whole_height + 2 * kMargin);
  }
  animation::Picture picture = canvas.picture();
  draw(picture, plan, slice, whole, kMargin, kMargin, points_per_mm);
  const auto [x_mm, y_mm] = plan.point_of_interest();
  const SliceRectangle close_up{x_mm - kCloseUpMm / 2, y_mm - kCloseUpMm / 2, kCloseUpMm, kCloseUpMm};
  draw(picture, plan, slice, close_up, close_up_left, kMargin, kCloseUpPoints / kCloseUpMm);
  animation::write_png(path, picture);
}

}  // namespace nacre::fabricate
