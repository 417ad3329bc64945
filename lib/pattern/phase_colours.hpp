#pragma once
// The colours of the phases, 0xRRGGBB: the same in films, pattern icons, previews and slices. Soft is dark and rigid
// light, as the inks of the thesis are (TangoBlackPlus, VeroWhitePlus). Both are greys, so that the hues of the energy
// scale remain free, and rigid is no lighter than a white page allows.

#include <cstdint>
#include <string>

#include <fmt/format.h>

namespace nacre::pattern {

inline constexpr std::uint32_t kSoftRgb = 0x22262c, kRigidRgb = 0x8d97a6, kInterfaceRgb = 0x525a66;
/// Around a specimen: support or air.
inline constexpr std::uint32_t kNotPrintedRgb = 0xaac8eb;

/// The colour as HTML, CSS and SVG write it: `#22262c`.
inline std::string html_colour(std::uint32_t rgb) { return fmt::format("#{:06x}", rgb); }

}  // namespace nacre::pattern
