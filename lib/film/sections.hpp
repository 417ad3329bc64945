#pragma once
// The compressed parts of a film file.

#include <string>
#include <vector>

#include "base/result.hpp"
#include "film/film.hpp"

namespace nacre::film {

/// A name and a zlib stream.
struct FilmSection {
  std::string name;
  std::string bytes;
};

/// material, breaks, energy, displacement: see docs/FORMATS.md.
std::vector<FilmSection> sections_of(const Film& film);

/// Adds the content of the sections to a film whose header has been read and checked; sections of other names are
/// ignored. Error: a section is missing, damaged or of another length.
Result<void> read_sections(const std::vector<FilmSection>& sections, Film& film);

}  // namespace nacre::film
