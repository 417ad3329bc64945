#include "film/film_file.hpp"

#include <bit>
#include <cstring>

#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "base/result.hpp"
#include "film/sections.hpp"

namespace nacre::film {
namespace {

using Json = nlohmann::ordered_json;
using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::string_view kMagic = "NACREFLM";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kFixedBytes = 16;  // magic, version, length of the header
constexpr std::size_t kLargestFile = 256u << 20;
constexpr int kLargestSide = 4096, kMostFrames = 1000;
constexpr std::size_t kMostValues = 64u << 20;
constexpr double kLargestStrain = 100.0, kLargestStress = 1e13;  // as of measured curves

Json crack_json(const crack::CrackRecord& crack) {
  Json value = {
      {"broken", crack.order.size()}, {"branches", crack.branches}, {"separate_cracks", crack.separate_cracks}};
  if (!crack.path) return value["path"] = nullptr, value;
  const crack::CrackPath& path = *crack.path;
  value["path"] = {{"length_m", path.length_m},
                   {"straight_length_m", path.straight_length_m},
                   {"ratio", path.ratio()},
                   {"bridged_share", path.bridged_share},
                   {"soft_share", path.material[0]},
                   {"rigid_share", path.material[1]},
                   {"interface_share", path.material[2]},
                   {"crosses", path.crosses},
                   {"elements", path.elements}};
  return value;
}

Json header_json(const Film& film, const std::vector<FilmSection>& sections) {
  Json frames = Json::array(), lengths = Json::array();
  for (const FilmFrame& frame : film.frames)
    frames.push_back({{"strain", frame.strain}, {"stress_pa", frame.stress_pa}, {"broken", frame.broken}});
  for (const FilmSection& section : sections)
    lengths.push_back({{"name", section.name}, {"bytes", section.bytes.size()}});
  return {
      {"design", film.design},
      {"fidelity", film.fidelity},
      {"columns", film.columns},
      {"rows", film.rows},
      {"element_size_m", film.element_size_m},
      {"toughness_pa", film.toughness_pa},
      {"peak_stress_pa", film.peak_stress_pa},
      {"failure_strain", film.failure_strain},
      {"end", film.end},
      {"energy",
       {{"largest_j_per_m3", film.largest_energy_j_per_m3}, {"decades", kEnergyDecades}, {"levels", kEnergyLevels}}},
      {"displacement_step_m", film.displacement_step_m},
      {"curve", {{"strain", film.curve.strain}, {"stress_pa", film.curve.stress_pa}}},
      {"crack", crack_json(film.crack)},
      {"frames", frames},
      {"sections", lengths}};
}

/// A count. Throws InputError where it is none: a conversion would take any number for one.
int count_from(const json& value, const char* name, int most) {
  if (!value.is_number_integer() || value < 0 || value > most)
    throw InputError::format("{}: {}, expected a whole number from 0 to {}", name, value.dump(), most);
  return value.get<int>();
}

int count_in(const json& object, const char* name, int most) { return count_from(object.at(name), name, most); }

crack::CrackPath path_from(const json& path, int elements) {
  crack::CrackPath read{.elements = {},
                        .length_m = path.at("length_m"),
                        .straight_length_m = path.at("straight_length_m"),
                        .bridged_share = path.at("bridged_share"),
                        .material = {path.at("soft_share"), path.at("rigid_share"), path.at("interface_share")},
                        .crosses = path.at("crosses")};
  for (const json& element : path.at("elements")) read.elements.push_back(count_from(element, "element", elements - 1));
  return read;
}

/// Header members into a film; throws nlohmann's exceptions or InputError where one is missing or of another kind.
void read_header(const json& header, Film& film) {
  header.at("design").get_to(film.design);
  header.at("fidelity").get_to(film.fidelity);
  film.columns = count_in(header, "columns", kLargestSide);
  film.rows = count_in(header, "rows", kLargestSide);
  const int elements = film.columns * film.rows;
  header.at("element_size_m").get_to(film.element_size_m);
  header.at("toughness_pa").get_to(film.toughness_pa);
  header.at("peak_stress_pa").get_to(film.peak_stress_pa);
  header.at("failure_strain").get_to(film.failure_strain);
  header.at("end").get_to(film.end);
  const json& energy = header.at("energy");
  energy.at("largest_j_per_m3").get_to(film.largest_energy_j_per_m3);
  if (energy.at("decades") != kEnergyDecades || energy.at("levels") != kEnergyLevels)
    throw InputError::format("energies over {} decades in {} levels, expected {} and {}", energy.at("decades").dump(),
                             energy.at("levels").dump(), kEnergyDecades, kEnergyLevels);
  header.at("displacement_step_m").get_to(film.displacement_step_m);
  header.at("curve").at("strain").get_to(film.curve.strain);
  header.at("curve").at("stress_pa").get_to(film.curve.stress_pa);
  const json& crack = header.at("crack");
  film.crack.branches = count_in(crack, "branches", elements);
  film.crack.separate_cracks = count_in(crack, "separate_cracks", elements);
  film.crack.columns = film.columns;
  film.crack.rows = film.rows;
  film.crack.order.resize(count_in(crack, "broken", elements));
  if (const json& path = crack.at("path"); !path.is_null()) film.crack.path = path_from(path, elements);
  for (const json& frame : header.at("frames"))
    film.frames.push_back({.strain = frame.at("strain"),
                           .stress_pa = frame.at("stress_pa"),
                           .broken = count_in(frame, "broken", elements),
                           .energy_level = {},
                           .displacement_step = {}});
}

/// What in the header contradicts itself or the format; empty when nothing does.
std::string header_fault(const Film& film) {
  if (film.columns < 1 || film.rows < 1)
    return fmt::format("{} x {} elements, expected 1 to {} on a side", film.columns, film.rows, kLargestSide);
  if (!(film.element_size_m > 0.0)) return fmt::format("elements of {} m", film.element_size_m);
  if (film.frames.empty() || film.frames.size() > kMostFrames)
    return fmt::format("{} frames, expected 1 to {}", film.frames.size(), kMostFrames);
  const int elements = film.columns * film.rows;
  if (film.frames.size() * static_cast<std::size_t>(elements) > kMostValues)
    return fmt::format("{} frames of {} elements, expected {} values in all", film.frames.size(), elements,
                       kMostValues);
  if (!(film.failure_strain >= 0.0 && film.failure_strain <= kLargestStrain))
    return fmt::format("a failure strain of {}, expected 0 to {}", film.failure_strain, kLargestStrain);
  std::vector<double> stresses = film.curve.stress_pa;
  stresses.insert(stresses.end(), {film.toughness_pa, film.peak_stress_pa});
  for (const double value : stresses)
    if (!(std::abs(value) <= kLargestStress))
      return fmt::format("a toughness or stress of {} Pa, expected at most {} in magnitude", value, kLargestStress);
  if (film.curve.strain.size() != film.curve.stress_pa.size()) return "strain and stress of the curve differ in length";
  for (const FilmFrame& frame : film.frames)
    if (frame.broken > static_cast<int>(film.crack.order.size()))
      return fmt::format("a frame with {} failed elements of {}", frame.broken, film.crack.order.size());
  return {};
}

Result<Film> read_film_parts(const json& header, std::string_view body) {
  Film film;
  std::vector<FilmSection> sections;
  try {
    read_header(header, film);
    for (const json& section : header.at("sections")) {
      const auto bytes = static_cast<std::size_t>(count_in(section, "bytes", kLargestFile));
      if (bytes > body.size()) return fail("section {} is cut off", section.at("name").get<std::string>());
      sections.push_back({section.at("name"), std::string(body.substr(0, bytes))});
      body.remove_prefix(bytes);
    }
  } catch (const std::exception& problem) {
    return fail("header: {}", problem.what());
  }
  if (const std::string fault = header_fault(film); !fault.empty()) return fail("header: {}", fault);
  if (const Result<void> read = read_sections(sections, film); !read) return tl::unexpected(read.error());
  return film;
}

}  // namespace

std::string encode(const Film& film) {
  const std::vector<FilmSection> sections = sections_of(film);
  const std::string header = header_json(film, sections).dump();
  std::string bytes(kMagic);
  for (const std::uint32_t number : {kVersion, static_cast<std::uint32_t>(header.size())})
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  bytes += header;
  for (const FilmSection& section : sections) bytes += section.bytes;
  return bytes;
}

Result<Film> decode(std::string_view bytes) {
  if (bytes.size() < kFixedBytes || !bytes.starts_with(kMagic))
    return fail("not a fracture film: it does not begin with {}", kMagic);
  std::uint32_t numbers[2];
  std::memcpy(numbers, bytes.data() + kMagic.size(), sizeof numbers);
  if (numbers[0] != kVersion) return fail("fracture film of version {}, expected {}", numbers[0], kVersion);
  if (numbers[1] > bytes.size() - kFixedBytes) return fail("the header is cut off");
  const json header = json::parse(bytes.substr(kFixedBytes, numbers[1]), nullptr, false);
  if (header.is_discarded()) return fail("the header is not JSON");
  return read_film_parts(header, bytes.substr(kFixedBytes + numbers[1]));
}

void write_film(const std::filesystem::path& path, const Film& film) { write_file_atomically(path, encode(film)); }

Film read_film(const std::filesystem::path& path) {
  Result<Film> film = decode(read_file_up_to(path, kLargestFile));
  if (!film) throw InputError::format("{}: {}", path.string(), film.error().message);
  return *std::move(film);
}

}  // namespace nacre::film
