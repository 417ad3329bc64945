#pragma once
// Films as bytes and files: docs/FORMATS.md, "Fracture films".

#include <filesystem>
#include <string>
#include <string_view>

#include "film/film.hpp"

namespace nacre::film {

/// The film as the content of a .film file.
std::string encode(const Film& film);

/// A film from arbitrary bytes. The error says what is wrong and where.
Result<Film> decode(std::string_view bytes);

/// Throws InputError naming the file.
void write_film(const std::filesystem::path& path, const Film& film);
Film read_film(const std::filesystem::path& path);

}  // namespace nacre::film
