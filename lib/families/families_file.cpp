#include "families/families_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/names.hpp"
#include "base/toml_file.hpp"
#include "pattern/pattern_key.hpp"

namespace nacre::families {
namespace {

[[noreturn]] void refuse(const std::string& source, const toml::node& node, const std::string& what) {
  throw InputError::format("{}: {}", place(source, node), what);
}

pattern::Pattern seed_of(const toml::node& node, const std::string& source) {
  const std::optional<std::string> key = node.value<std::string>();
  if (!key) refuse(source, node, "expected as seed a pattern key, 14 hexadecimal digits in quotes");
  const Result<pattern::Pattern> seed = pattern::pattern_from_key(*key);
  if (!seed) refuse(source, node, fmt::format("seed '{}': {}", *key, seed.error().message));
  return *seed;
}

SeedFamily family_of(const toml::table& table, const std::string& source) {
  SeedFamily family{.name = table["name"].value_or(std::string()), .seeds = {}};
  if (!is_family_name(family.name))
    refuse(source, table,
           fmt::format("expected a name of at most {} letters, digits, - and _, not digits alone", kLongestFamilyName));
  const toml::array* seeds = table["seeds"].as_array();
  if (seeds == nullptr || seeds->empty()) refuse(source, table, "expected seeds = [\"key\", ...] in the family");
  for (const toml::node& seed : *seeds) family.seeds.push_back(seed_of(seed, source));
  return family;
}

}  // namespace

bool is_family_name(std::string_view name) {
  return is_plain_name(name, kLongestFamilyName) && name.find_first_not_of("0123456789") != std::string_view::npos;
}

std::string to_toml(const std::vector<SeedFamily>& families) {
  std::string text =
      "# Families of near-Pareto designs. Move seeds, rename or merge families as you see them; `nacre families` reads "
      "this file.\n";
  for (const SeedFamily& family : families) {
    text += fmt::format("\n[[family]]\nname = \"{}\"\nseeds = [", family.name);
    for (std::size_t i = 0; i < family.seeds.size(); ++i)
      text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", family.seeds[i].key());
    text += "]\n";
  }
  return text;
}

std::vector<SeedFamily> parse_families(std::string_view text, const std::string& source) {
  const toml::table document = read_toml(text, source);
  const toml::array* tables = document["family"].as_array();
  if (tables == nullptr) throw InputError::format("{}: expected [[family]] tables", source);
  std::vector<SeedFamily> families;
  std::set<std::string> names;
  std::set<pattern::Pattern> seeds;
  for (const toml::node& node : *tables) {
    if (!node.is_table()) refuse(source, node, "expected a [[family]] table");
    families.push_back(family_of(*node.as_table(), source));
    if (!names.insert(families.back().name).second)
      refuse(source, node, fmt::format("family '{}' is listed a second time", families.back().name));
    for (const pattern::Pattern& seed : families.back().seeds)
      if (!seeds.insert(seed).second)
        refuse(source, node, fmt::format("seed '{}' is listed a second time", seed.key()));
  }
  return families;
}

std::vector<SeedFamily> read_families(const std::filesystem::path& file) {
  return parse_families(read_file(file), file.string());
}

}  // namespace nacre::families
