#include "fabricate/preview.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::fabricate {
namespace {

using Colour = std::array<double, 3>;
constexpr Colour kVoid{170, 200, 235}, kSoft{20, 20, 20}, kRigid{245, 245, 245}, kPaper{255, 255, 255};
constexpr int kLongSidePoints = 1040, kCloseUpPoints = 640, kMargin = 20;
constexpr double kCloseUpMm = 3.0;

/// Rows of RGB points.
class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width), height_(height), bytes_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) set(x, y, kPaper);
    }
  }
  void set(int x, int y, const Colour& colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    for (std::size_t i = 0; i < 3; ++i) {
      bytes_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) + i] =
          static_cast<unsigned char>(std::lround(colour[i]));
    }
  }
  void write(const std::filesystem::path& path) const {
    png_image picture{};
    picture.version = PNG_IMAGE_VERSION;
    picture.width = static_cast<png_uint_32>(width_);
    picture.height = static_cast<png_uint_32>(height_);
    picture.format = PNG_FORMAT_RGB;
    std::string file(PNG_IMAGE_PNG_SIZE_MAX(picture), '\0');
    png_alloc_size_t size = file.size();
    if (png_image_write_to_memory(&picture, file.data(), &size, 0, bytes_.data(), 0, nullptr) == 0) {
      throw InputError::format("{}: cannot be written as PNG: {}", path.string(), picture.message);
    }
    write_file_atomically(path, std::string_view(file).substr(0, size));
  }

 private:
  int width_, height_;
  std::vector<unsigned char> bytes_;
};

/// A rectangle of the slice in mm.
struct Window {
  double left_mm, top_mm, width_mm, height_mm;
};

/// Mean colour of the droplets whose centre lies between two positions either way, at least the nearest one.
Colour mean_colour(const DropletPlan& plan, const Slice& slice, const Window& window) {
  const auto range = [](double from_mm, double length_mm, double pitch, int droplets) {
    const int first = std::clamp(static_cast<int>(from_mm / pitch), 0, droplets - 1);
    const int last = std::clamp(static_cast<int>((from_mm + length_mm) / pitch), first + 1, droplets);
    return std::pair(first, std::max(first + 1, last));
  };
  const auto [first_column, end_column] = range(window.left_mm, window.width_mm, plan.x().pitch(), slice.columns);
  const auto [first_row, end_row] = range(window.top_mm, window.height_mm, plan.y().pitch(), slice.rows);
  Colour sum{};
  for (int row = first_row; row < end_row; ++row) {
    for (int column = first_column; column < end_column; ++column) {
      const Droplet droplet = slice.at(column, row);
      const Colour& colour = droplet == Droplet::none ? kVoid : droplet == Droplet::soft ? kSoft : kRigid;
      for (std::size_t i = 0; i < 3; ++i) sum[i] += colour[i];
    }
  }
  for (double& channel : sum) channel /= double(end_row - first_row) * (end_column - first_column);
  return sum;
}

void draw(Canvas& canvas, const DropletPlan& plan, const Slice& slice, const Window& window, int left, int top,
          double points_per_mm) {
  const int width = static_cast<int>(window.width_mm * points_per_mm);
  const int height = static_cast<int>(window.height_mm * points_per_mm);
  const double point_mm = 1.0 / points_per_mm;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Window point{window.left_mm + x * point_mm, window.top_mm + y * point_mm, point_mm, point_mm};
      canvas.set(left + x, top + y, mean_colour(plan, slice, point));
    }
  }
}

}  // namespace

void write_preview(const DropletPlan& plan, const std::filesystem::path& path) {
  const Slice slice = plan.slice(plan.layers() / 2);
  const Window whole{0.0, 0.0, slice.columns * plan.x().pitch(), slice.rows * plan.y().pitch()};
  const double points_per_mm = kLongSidePoints / std::max(whole.width_mm, whole.height_mm);
  const int whole_width = static_cast<int>(whole.width_mm * points_per_mm);
  const int whole_height = static_cast<int>(whole.height_mm * points_per_mm);
  Canvas canvas(whole_width + kCloseUpPoints + 3 * kMargin, std::max(whole_height, kCloseUpPoints) + 2 * kMargin);
  draw(canvas, plan, slice, whole, kMargin, kMargin, points_per_mm);
  const auto [x_mm, y_mm] = plan.point_of_interest();
  const Window close_up{x_mm - kCloseUpMm / 2, y_mm - kCloseUpMm / 2, kCloseUpMm, kCloseUpMm};
  draw(canvas, plan, slice, close_up, whole_width + 2 * kMargin, kMargin, kCloseUpPoints / kCloseUpMm);
  canvas.write(path);
}

}  // namespace nacre::fabricate
