#include "film/sections.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace nacre::film {
namespace {

/// Of zlib's 1 to 9: the best one takes six times as long (1.7 s for a full specimen) and saves 4 %.
constexpr int kCompression = 7;

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), kCompression) != Z_OK)
    throw std::logic_error("zlib cannot compress");
  result.resize(size);
  return result;
}

/// The section's content, which must be `size` bytes long.
Result<std::string> content(const std::vector<FilmSection>& sections, const std::string& name, std::size_t size) {
  const auto section =
      std::find_if(sections.begin(), sections.end(), [&](const FilmSection& s) { return s.name == name; });
  if (section == sections.end()) return fail("there is no section {}", name);
  std::string bytes(size, '\0');
  uLongf length = static_cast<uLongf>(size);
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(section->bytes.data()),
                 static_cast<uLong>(section->bytes.size()));
  if (status != Z_OK || length != size) return fail("section {} is damaged or not {} bytes long", name, size);
  return bytes;
}

/// Elements as int32, then their strains as float32.
std::string break_bytes(const Film& film) {
  const std::size_t count = film.crack.order.size();
  std::string bytes(8 * count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t element = film.crack.order[i].element;
    const float strain = static_cast<float>(film.crack.order[i].strain);
    std::memcpy(bytes.data() + 4 * i, &element, 4);
    std::memcpy(bytes.data() + 4 * (count + i), &strain, 4);
  }
  return bytes;
}

/// Per frame the difference to the frame before, modulo 256.
std::string energy_bytes(const Film& film) {
  std::string bytes;
  std::vector<std::uint8_t> previous(film.material.size(), 0);
  for (const FilmFrame& frame : film.frames) {
    for (std::size_t e = 0; e < previous.size(); ++e) bytes += static_cast<char>(frame.energy_level[e] - previous[e]);
    previous = frame.energy_level;
  }
  return bytes;
}

/// Differences modulo 65536 to the frame before: the low bytes of all frames, then the high ones.
std::string displacement_bytes(const Film& film) {
  const std::size_t values = 2 * static_cast<std::size_t>(film.node_count());
  std::string bytes(2 * values * film.frames.size(), '\0');
  std::vector<std::int16_t> previous(values, 0);
  std::size_t at = 0;
  for (const FilmFrame& frame : film.frames)
    for (std::size_t i = 0; i < values; ++i, ++at) {
      const auto change = static_cast<std::uint16_t>(frame.displacement_step[i] - previous[i]);
      previous[i] = frame.displacement_step[i];
      bytes[at] = static_cast<char>(change & 0xff);
      bytes[at + values * film.frames.size()] = static_cast<char>(change >> 8);
    }
  return bytes;
}


Result<void> read_material(const std::string& bytes, Film& film) {
  film.material.assign(bytes.begin(), bytes.end());
  const auto wrong = std::find_if(film.material.begin(), film.material.end(), [](auto value) { return value > 3; });
  if (wrong == film.material.end()) return {};
  return fail("section material: element {} is {}, expected 0 to 3", wrong - film.material.begin(), *wrong);
}

Result<void> read_breaks(const std::string& bytes, Film& film) {
  const std::size_t count = film.crack.order.size();
  std::vector<bool> is_broken(film.material.size());
  for (std::size_t i = 0; i < count; ++i) {
    std::int32_t element = 0;
    float strain = 0.0F;
    std::memcpy(&element, bytes.data() + 4 * i, 4);
    std::memcpy(&strain, bytes.data() + 4 * (count + i), 4);
    if (element < 0 || element >= film.columns * film.rows)
      return fail("section breaks: there is no element {} among {}", element, film.columns * film.rows);
    const auto at = static_cast<std::size_t>(element);
    if (film.material[at] == kVoid) return fail("section breaks: element {} is empty and cannot fail", element);
    if (is_broken[at]) return fail("section breaks: element {} fails twice", element);
    is_broken[at] = true;
    film.crack.order[i] = {element, strain};
  }
  return {};
}

Result<void> read_energy(const std::string& bytes, Film& film) {
  const std::size_t elements = film.material.size();
  std::vector<std::uint8_t> levels(elements, 0);
  std::size_t at = 0;
  for (FilmFrame& frame : film.frames) {
    for (std::uint8_t& level : levels) {
      level = static_cast<std::uint8_t>(level + static_cast<std::uint8_t>(bytes[at++]));
      if (level >= kEnergyLevels) return fail("section energy: level {}, expected below {}", level, kEnergyLevels);
    }
    frame.energy_level = levels;
  }
  return {};
}

void read_displacement(const std::string& bytes, Film& film) {
  const std::size_t half = bytes.size() / 2;
  std::vector<std::int16_t> steps(2 * static_cast<std::size_t>(film.node_count()), 0);
  std::size_t at = 0;
  for (FilmFrame& frame : film.frames) {
    for (std::int16_t& step : steps) {
      const int change = static_cast<std::uint8_t>(bytes[at]) | static_cast<std::uint8_t>(bytes[half + at]) << 8;
      step = static_cast<std::int16_t>(static_cast<std::uint16_t>(step + change));
      ++at;
    }
    frame.displacement_step = steps;
  }
}

}  // namespace

std::vector<FilmSection> sections_of(const Film& film) {
  return {{"material", compressed({film.material.begin(), film.material.end()})},
          {"breaks", compressed(break_bytes(film))},
          {"energy", compressed(energy_bytes(film))},
          {"displacement", compressed(displacement_bytes(film))}};
}

Result<void> read_sections(const std::vector<FilmSection>& sections, Film& film) {
  const auto elements = static_cast<std::size_t>(film.columns) * static_cast<std::size_t>(film.rows);
  const std::size_t frames = film.frames.size();
  const auto read = [&](const std::string& name, std::size_t size, auto reader) -> Result<void> {
    const Result<std::string> bytes = content(sections, name, size);
    if (!bytes) return tl::unexpected(bytes.error());
    return reader(*bytes, film);
  };
  if (auto done = read("material", elements, read_material); !done) return done;
  if (auto done = read("breaks", 8 * film.crack.order.size(), read_breaks); !done) return done;
  if (auto done = read("energy", elements * frames, read_energy); !done) return done;
  return read("displacement", 4 * static_cast<std::size_t>(film.node_count()) * frames,
              [](const std::string& bytes, Film& f) -> Result<void> {
                read_displacement(bytes, f);
                return {};
              });
}

}  // namespace nacre::film
