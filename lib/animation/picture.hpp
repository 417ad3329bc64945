#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace nacre::animation {

/// A picture of opaque points.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> rgb;  ///< 0xRRGGBB, rows from the top
};

/// Writes a PNG, whole or not at all. Throws InputError naming the file.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace nacre::animation
