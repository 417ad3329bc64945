#include "animation/picture.hpp"

#include <png.h>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::animation {

void write_png(const std::filesystem::path& path, const Picture& picture) {
  std::vector<unsigned char> points;
  points.reserve(3 * picture.rgb.size());
  for (const std::uint32_t rgb : picture.rgb)
    for (const int shift : {16, 8, 0}) points.push_back(static_cast<unsigned char>(rgb >> shift));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  const auto write = [&](void* to) {
    return png_image_write_to_memory(&image, to, &size, 0, points.data(), 0, nullptr);
  };
  std::string bytes;
  bool written = write(nullptr) != 0;
  if (written) {
    bytes.resize(size);
    written = write(bytes.data()) != 0;
  }
  if (!written) throw InputError::format("{}: cannot be written: {}", path.string(), image.message);
  bytes.resize(size);
  write_file_atomically(path, bytes);
}

}  // namespace nacre::animation
