#pragma once
// Layouts as pictures: rigid is white (VeroWhite), soft is black (TangoBlack).

#include <filesystem>

#include "pattern/layout.hpp"

namespace nacre::pattern {

/// Largest number of picture points along one pixel that is read or written.
inline constexpr int kMaximumPngScale = 512;

/// Writes the layout as a grey picture of 20 scale x 20 scale points, scale 1 to 512, whole or not at all. Throws
/// InputError naming the file.
void write_png(const Layout& layout, const std::filesystem::path& path, int scale = 10);

/// Reads a picture of 20 k x 20 k points, k = 1 to 512, of any PNG colour type (transparency counts as black): a pixel
/// is rigid when the mean of its k x k points is at least mid grey. Throws InputError naming the file and what was
/// expected.
Layout read_png(const std::filesystem::path& path);

}  // namespace nacre::pattern
