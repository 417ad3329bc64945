// Part of the command line (command.hpp): nacre film, a recorded fracture film as a GIF or as pictures.

#include <filesystem>
#include <string>

#include "command.hpp"
#include "film/film_file.hpp"
#include "film_files.hpp"
#include "output.hpp"

namespace nacre::cli {
namespace {

struct FilmOptions {
  std::string film;
  std::string out;
  int width = 960;
};

int draw(const FilmOptions& options) {
  const film::Film film = film::read_film(options.film);
  prepare_film_output(options.out);
  draw_film(film, options.out, std::filesystem::path(options.film).stem().string(), options.width);
  return 0;
}

}  // namespace

void add_film(CLI::App& app, Action& action) {
  const auto options = std::make_shared<FilmOptions>();
  CLI::App& command =
      add_command(app, action, "film", "Draw a recorded fracture film as a GIF or as pictures", options, draw);
  command.add_option("FILM", options->film, "Film data, of `nacre simulate --frames` or of a run: RUN/films/*.film")
      ->required();
  command.add_option("--out", options->out, "GIF to write, or folder for PNG pictures")->required();
  command.add_option("--width", options->width, "Width of the pictures in pixels")
      ->check(CLI::Range(kNarrowestPicture, kWidestPicture))
      ->capture_default_str();
}

}  // namespace nacre::cli
