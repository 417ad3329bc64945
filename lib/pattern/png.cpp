#include "pattern/png.hpp"

#include <png.h>

#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::pattern {
namespace {

constexpr int kWhite = 255;

/// libpng's simplified interface, freed when it leaves scope. Errors come back as a message instead of a long jump.
struct Picture {
  png_image image{};
  Picture() { image.version = PNG_IMAGE_VERSION; }
  ~Picture() { png_image_free(&image); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  int side() const { return static_cast<int>(image.width); }
};

/// Points of a picture in rows from the top, one grey byte each.
using GreyPoints = std::vector<unsigned char>;

GreyPoints read_grey(Picture& picture, const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const auto give_up = [&] {
    return InputError::format("{}: no readable PNG picture: {}", path.string(), picture.image.message);
  };
  if (png_image_begin_read_from_memory(&picture.image, bytes.data(), bytes.size()) == 0) throw give_up();
  const auto width = picture.image.width, height = picture.image.height;
  if (width != height || width == 0 || width % kSide != 0 || width > kSide * kMaximumPngScale) {
    throw InputError::format("{}: the picture has {} x {} points, expected 20 k x 20 k with k = 1 to {}", path.string(),
                             width, height, kMaximumPngScale);
  }
  picture.image.format = PNG_FORMAT_GRAY;
  GreyPoints points(PNG_IMAGE_SIZE(picture.image));
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&picture.image, &black, points.data(), 0, nullptr) == 0) throw give_up();
  return points;
}

}  // namespace

void write_png(const Layout& layout, const std::filesystem::path& path, int scale) {
  if (scale < 1 || scale > kMaximumPngScale) {
    throw InputError::format("{}: scale {}, expected 1 to {}", path.string(), scale, kMaximumPngScale);
  }
  Picture picture;
  picture.image.width = picture.image.height = static_cast<png_uint_32>(kSide * scale);
  picture.image.format = PNG_FORMAT_GRAY;
  GreyPoints points(PNG_IMAGE_SIZE(picture.image));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int row = static_cast<int>(i) / picture.side(), column = static_cast<int>(i) % picture.side();
    points[i] = layout.rigid(row / scale, column / scale) ? kWhite : 0;
  }
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(picture.image), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&picture.image, bytes.data(), &size, 0, points.data(), 0, nullptr) == 0) {
    throw InputError::format("{}: cannot be written as PNG: {}", path.string(), picture.image.message);
  }
  write_file_atomically(path, std::string_view(bytes).substr(0, size));
}

Layout read_png(const std::filesystem::path& path) {
  Picture picture;
  const GreyPoints points = read_grey(picture, path);
  const int scale = picture.side() / kSide;
  std::vector<long> sums(kPixels, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int row = static_cast<int>(i) / picture.side() / scale, column = static_cast<int>(i) % picture.side() / scale;
    sums[static_cast<std::size_t>(row * kSide + column)] += points[i];
  }
  Layout layout;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    const long twice_mean = 2 * sums[static_cast<std::size_t>(pixel)];
    layout.set(pixel / kSide, pixel % kSide, twice_mean >= static_cast<long>(kWhite) * scale * scale);
  }
  return layout;
}

}  // namespace nacre::pattern
