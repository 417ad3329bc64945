#pragma once
// The parts of a scene.

#include "animation/canvas.hpp"
#include "film/film.hpp"

namespace nacre::animation {

inline constexpr double kSceneWidth = 960.0, kSceneHeight = 540.0;
inline constexpr std::uint32_t kInk = 0x1c2128, kFaint = 0x6a737d, kRule = 0xc9ced6, kPage = 0xffffff;
/// Elements that failed since the frame before, the marker, and what has been reached of the curve.
inline constexpr std::uint32_t kAccent = 0x0a9fd6;

/// Specimen, grips, scale bar and legend of the materials in the left half.
void draw_specimen(Canvas& canvas, const film::Film& film, int frame);

/// The scale of the energy density beside the specimen.
void draw_energy_scale(Canvas& canvas, const film::Film& film);

/// Curve and figures in the right half.
void draw_chart(Canvas& canvas, const film::Film& film, int frame);

}  // namespace nacre::animation
