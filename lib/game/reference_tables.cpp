#include "game/reference_tables.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/named_table.hpp"

namespace nacre::game {
namespace {

constexpr std::pair<const char*, double> kRigidFractions[] = {{"TB", 0.0}, {"VW", 1.0}, {"IF", 0.5}};

measurement::Replicates read_material(const NamedTable& table, std::size_t row, double rigid_fraction) {
  measurement::Replicates measured;
  measured.design = pattern::Mixture{rigid_fraction};
  measured.modulus_count = measured.toughness_count = 1;
  measured.modulus_pa = 1e9 * table.positive(row, "measured_modulus_gpa");
  measured.toughness_pa = 1e6 * table.positive(row, "measured_toughness_mpa");
  return measured;
}

}  // namespace

std::vector<measurement::Replicates> read_base_materials(const std::filesystem::path& path) {
  const NamedTable table(path, {"material", "measured_modulus_gpa", "measured_toughness_mpa"});
  std::map<std::string, measurement::Replicates> found;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::string& name = table.text(row, "material");
    const auto* known = std::find_if(std::begin(kRigidFractions), std::end(kRigidFractions),
                                     [&](const auto& each) { return name == each.first; });
    if (known == std::end(kRigidFractions))
      table.fail_at(row, "material", "expected TB, VW or IF, found '" + name + "'");
    if (!found.emplace(name, read_material(table, row, known->second)).second) {
      table.fail_at(row, "material", name + " is listed a second time");
    }
  }
  std::vector<measurement::Replicates> materials;
  for (const auto& [name, rigid_fraction] : kRigidFractions) {
    if (!found.contains(name)) {
      throw InputError::format("{}: no row for material {}; expected TB, VW and IF", path.string(), name);
    }
    materials.push_back(found.at(name));
  }
  return materials;
}

std::vector<optimize::Performance> read_benchmark_line(const std::filesystem::path& path) {
  const NamedTable table(path, {"modulus_gpa", "toughness_mpa"});
  std::vector<optimize::Performance> line;
  for (std::size_t row = 0; row < table.size(); ++row) {
    line.push_back({1e9 * table.positive(row, "modulus_gpa"), 1e6 * table.positive(row, "toughness_mpa")});
  }
  std::stable_sort(line.begin(), line.end(), [](const auto& a, const auto& b) { return a.modulus_pa < b.modulus_pa; });
  return line;
}

}  // namespace nacre::game
