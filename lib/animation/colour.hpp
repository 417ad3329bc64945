#pragma once
// Colours of the pictures. Blends and scales run in OKLab, in which equal steps look equal.

#include <cstdint>

namespace nacre::animation {

/// Lightness 0..1, chroma, hue in degrees.
struct Lch {
  double lightness = 0.0, chroma = 0.0, hue_deg = 0.0;
};

/// 0xRRGGBB of a colour; colours beyond sRGB lose chroma, not lightness.
std::uint32_t rgb_of(const Lch& colour);

/// The colour between a (share 0) and b (share 1).
std::uint32_t blend(std::uint32_t a, std::uint32_t b, double share);

/// Colour of a share 0..1 of the scale: violet, red, orange, pale yellow; lightness rises evenly.
std::uint32_t glow(double share);

/// An element of a phase (0 soft, 1 rigid, 2 interface): the phase's own colour (pattern/phase_colours.hpp) where no
/// energy is stored, covered by the glow as the energy level (0..1) rises.
std::uint32_t element_colour(int phase, double energy_level);

}  // namespace nacre::animation
