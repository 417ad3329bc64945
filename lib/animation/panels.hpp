#pragma once
// Measures and colours that the panels of a scene share.

#include <cstdint>

namespace nacre::animation {

inline constexpr double kSceneWidth = 960.0, kSceneHeight = 540.0;
inline constexpr std::uint32_t kInk = 0x1c2128, kFaint = 0x6a737d, kRule = 0xc9ced6, kPage = 0xffffff;
/// Elements that failed since the frame before, the marker, and the part of the curve that has been reached.
inline constexpr std::uint32_t kAccent = 0x0a9fd6;

}  // namespace nacre::animation
