#include "film_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "animation/gif.hpp"
#include "animation/scene.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"

namespace nacre::cli {

bool is_gif(const std::string& out) { return std::filesystem::path(out).extension() == ".gif"; }

void prepare_film_output(const std::string& out) {
  if (is_gif(out)) return prepare_output_file(out);
  constexpr std::array<std::string_view, 8> kOthers = {".mp4", ".webm", ".avi", ".mov",
                                                       ".png", ".apng", ".svg", ".jpg"};
  const std::filesystem::path path(out);
  if (std::ranges::count(kOthers, path.extension().string()) > 0 && !std::filesystem::is_directory(path))
    throw InputError::format("{}: no film of that kind is drawn, expected NAME.gif, or a folder for PNG pictures", out);
  prepare_output_folder(out);
}

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
