#pragma once
// One slice as an indexed PNG: point = droplet, palette index 0 none, 1 soft, 2 rigid.

#include <filesystem>
#include <string>

#include "fabricate/droplet_plan.hpp"

namespace nacre::fabricate {

/// A slice as PNG: 8-bit palette, with the droplet pitch as physical size. `is_noise`: a mixture, whose droplets only a
/// Huffman code can shorten.
std::string to_png(const Slice& slice, const Printer& printer, bool is_noise);

/// Reads a slice back, of any bit depth. Throws InputError when the file is no indexed PNG or holds an index above 2.
Slice read_slice(const std::filesystem::path& path);

}  // namespace nacre::fabricate
