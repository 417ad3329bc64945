#pragma once
// One slice as a PNG, point = droplet: indexed (palette index 0 none, 1 soft, 2 rigid) or in opaque colours of 32 bits.

#include <cstdint>
#include <filesystem>
#include <string>

#include "fabricate/printer.hpp"
#include "fabricate/slice.hpp"
#include "pattern/phase_colours.hpp"

namespace nacre::fabricate {

/// Colours of none, soft and rigid droplets, 0xRRGGBB.
struct SliceColours {
  std::uint32_t none, soft, rigid;
};

/// Those of pictures in a palette. Where a person assigns a resin to each colour by eye, clear ones on black, which
/// files of Voxel Print have as their background.
constexpr SliceColours colours_of(SlicePixels pixels) {
  return pixels == SlicePixels::rgba
             ? SliceColours{.none = 0x000000, .soft = 0x0000ff, .rigid = 0xffff00}
             : SliceColours{.none = pattern::kNotPrintedRgb, .soft = pattern::kSoftRgb, .rigid = pattern::kRigidRgb};
}

/// A slice as PNG with the droplet pitch as physical size. `is_noise`: it holds a mixture, of whose droplets only
/// runs repeat.
std::string to_png(const Slice& slice, const Printer& printer, bool is_noise);

/// Reads a slice back, indexed of any bit depth or RGBA. Throws InputError when the file is neither, or holds an index
/// above 2 or another colour.
Slice read_slice(const std::filesystem::path& path);

}  // namespace nacre::fabricate
