#pragma once
// The right half of a scene.

#include "animation/canvas.hpp"
#include "film/film.hpp"

namespace nacre::animation {

/// Stress-strain curve with a marker, and the figures of this moment.
void draw_chart(Canvas& canvas, const film::Film& film, int frame);

}  // namespace nacre::animation
