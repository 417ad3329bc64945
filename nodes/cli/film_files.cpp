#include "film_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "animation/gif.hpp"
#include "animation/scene.hpp"

namespace nacre::cli {

bool is_gif(const std::string& out) { return std::filesystem::path(out).extension() == ".gif"; }

void draw_film(const film::Film& film, const std::string& out, const std::string& stem, int width_points) {
  const animation::Scene scene(film, width_points);
  if (is_gif(out)) {
    return animation::write_gif(
        out, {.frame_count = scene.frame_count(),
              .draw = [&](int frame) { return scene.draw(frame); },
              .hundredths_of_seconds = [&](int frame) { return scene.hundredths_of_seconds(frame); }});
  }
  for (int frame = 0; frame < scene.frame_count(); ++frame)
    animation::write_png(std::filesystem::path(out) / fmt::format("{}-{:04}.png", stem, frame), scene.draw(frame));
}

}  // namespace nacre::cli
