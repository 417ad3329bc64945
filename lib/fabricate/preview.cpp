#include "fabricate/preview.hpp"

#include <algorithm>

#include "fabricate/slice_picture.hpp"

namespace nacre::fabricate {
namespace {

constexpr int kLongSidePoints = 1040, kCloseUpPoints = 640, kMargin = 20, kBarHeight = 40;
constexpr double kCloseUpMm = 3.0;
constexpr std::uint32_t kPaper = 0xffffff;

}  // namespace

void write_preview(const DropletPlan& plan, const std::filesystem::path& path) {
  const Slice slice = plan.slice(plan.layers() / 2);
  const SliceRectangle whole = whole_of(plan);
  const double points_per_mm = kLongSidePoints / std::max(whole.width_mm, whole.height_mm);
  const double close_up_points_per_mm = kCloseUpPoints / kCloseUpMm;
  const int whole_width = static_cast<int>(whole.width_mm * points_per_mm);
  const int whole_height = static_cast<int>(whole.height_mm * points_per_mm);
  const int close_up_left = whole_width + 2 * kMargin;
  const int width = close_up_left + kCloseUpPoints + kMargin;
  const int height = std::max(whole_height, kCloseUpPoints) + 3 * kMargin + kBarHeight;
  animation::Canvas canvas(width, height, width);
  canvas.fill(kPaper);
  draw_scale_bar(canvas, kMargin, whole_height + 2 * kMargin, 10.0, points_per_mm);
  draw_scale_bar(canvas, close_up_left, kCloseUpPoints + 2 * kMargin, 1.0, close_up_points_per_mm);
  // Below the shorter of the two pictures and its bar.
  if (whole_height > kCloseUpPoints) {
    draw_legend(canvas, close_up_left, kCloseUpPoints + 3 * kMargin + kBarHeight);
  } else {
    draw_legend(canvas, kMargin, whole_height + 3 * kMargin + kBarHeight);
  }
  animation::Picture picture = canvas.picture();
  draw_slice(picture, plan, slice, whole, kMargin, kMargin, points_per_mm);
  const auto [x_mm, y_mm] = plan.point_of_interest();
  const SliceRectangle close_up{x_mm - kCloseUpMm / 2, y_mm - kCloseUpMm / 2, kCloseUpMm, kCloseUpMm};
  draw_slice(picture, plan, slice, close_up, close_up_left, kMargin, close_up_points_per_mm);
  animation::write_png(path, picture);
}

}  // namespace nacre::fabricate
