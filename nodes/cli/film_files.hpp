#pragma once
// Films drawn into files.

#include <string>

#include "film/film.hpp"

namespace nacre::cli {

/// Smallest and largest width of the pictures, in pixels.
inline constexpr int kNarrowestPicture = 320, kWidestPicture = 3840;

/// Whether `out` names a GIF; otherwise it is a folder for PNG pictures.
bool is_gif(const std::string& out);

/// Proves that pictures can be written to `out`. Throws InputError, also for the name of another kind of film or
/// picture.
void prepare_film_output(const std::string& out);

/// Writes the GIF `out`, or OUT/STEM-0000.png, ... one picture per frame. Throws InputError.
void draw_film(const film::Film& film, const std::string& out, const std::string& stem, int width_points);

}  // namespace nacre::cli
