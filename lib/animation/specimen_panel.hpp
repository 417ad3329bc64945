#pragma once
// The left half of a scene.

#include "animation/canvas.hpp"
#include "film/film.hpp"

namespace nacre::animation {

/// Specimen, grips, scale bar, legend of the materials, and letters at the mechanisms of the crack.
void draw_specimen(Canvas& canvas, const film::Film& film, int frame);

/// The colour scale of the energy density, right of the specimen.
void draw_energy_scale(Canvas& canvas, const film::Film& film);

}  // namespace nacre::animation
