#include "game/thesis_tables.hpp"

#include <fmt/format.h>

#include "base/named_table.hpp"

namespace nacre::game {
namespace {

constexpr double kPaPerGpa = 1e9, kPaPerMpa = 1e6;
constexpr std::array<const char*, 5> kModels = {"initial", "r1", "r2", "r3", "r4"};

std::optional<double> scaled(std::optional<double> value, double factor) {
  return value ? std::optional<double>(*value * factor) : std::nullopt;
}

int whole(const NamedTable& table, std::size_t row, const std::string& column) {
  return static_cast<int>(table.positive(row, column));
}

std::vector<ThesisSample> read_samples(const std::filesystem::path& folder) {
  const NamedTable modulus(folder / "microstructures_modulus.csv",
                           {"sample", "round", "rigid_fraction_percent", "measured_gpa"});
  const NamedTable toughness(folder / "microstructures_toughness.csv", {"sample", "measured_mpa"});
  std::vector<ThesisSample> samples;
  for (std::size_t row = 0; row < modulus.size(); ++row) {
    if (row >= toughness.size() || toughness.text(row, "sample") != modulus.text(row, "sample"))
      modulus.fail_at(row, "sample", "expected the same samples in the same order as in microstructures_toughness.csv");
    ThesisSample& sample = samples.emplace_back();
    sample.number = whole(modulus, row, "sample");
    sample.round = whole(modulus, row, "round");
    sample.rigid_fraction = 0.01 * modulus.positive(row, "rigid_fraction_percent");
    sample.measured = {kPaPerGpa * modulus.positive(row, "measured_gpa"),
                       kPaPerMpa * toughness.positive(row, "measured_mpa")};
    for (std::size_t model = 0; model < kModels.size(); ++model) {
      sample.simulated[model] = {
          scaled(modulus.positive_or_empty(row, fmt::format("simulated_gpa_{}", kModels[model])), kPaPerGpa),
          scaled(toughness.positive_or_empty(row, fmt::format("simulated_mpa_{}", kModels[model])), kPaPerMpa)};
    }
  }
  return samples;
}

DesignValues pair_of(const NamedTable& table, std::size_t row, const std::string& modulus,
                     const std::string& toughness) {
  return {kPaPerGpa * table.positive(row, modulus), kPaPerMpa * table.positive(row, toughness)};
}

std::vector<ThesisFamilySample> read_family_samples(const std::filesystem::path& folder) {
  const NamedTable table(folder / "families.csv",
                         {"role", "family", "sample", "rigid_fraction_percent", "measured_modulus_gpa",
                          "measured_toughness_mpa", "simulated_modulus_gpa_r4", "simulated_toughness_mpa_r4",
                          "simulated_modulus_gpa_family", "simulated_toughness_mpa_family"});
  std::vector<ThesisFamilySample> samples;
  for (std::size_t row = 0; row < table.size(); ++row) {
    samples.push_back(
        {.family = whole(table, row, "family"),
         .is_seed = table.text(row, "role") == "seed",
         .name = table.text(row, "sample"),
         .rigid_fraction = 0.01 * table.positive(row, "rigid_fraction_percent"),
         .measured = pair_of(table, row, "measured_modulus_gpa", "measured_toughness_mpa"),
         .global_model = pair_of(table, row, "simulated_modulus_gpa_r4", "simulated_toughness_mpa_r4"),
         .family_model = pair_of(table, row, "simulated_modulus_gpa_family", "simulated_toughness_mpa_family")});
  }
  return samples;
}

std::vector<ThesisMaterial> read_materials(const std::filesystem::path& folder) {
  const NamedTable table(folder / "base_materials.csv", {"material", "measured_modulus_gpa", "simulated_modulus_gpa",
                                                         "measured_toughness_mpa", "simulated_toughness_mpa"});
  std::vector<ThesisMaterial> materials;
  for (std::size_t row = 0; row < table.size(); ++row) {
    materials.push_back({.name = table.text(row, "material"),
                         .measured = pair_of(table, row, "measured_modulus_gpa", "measured_toughness_mpa"),
                         .simulated = pair_of(table, row, "simulated_modulus_gpa", "simulated_toughness_mpa")});
  }
  return materials;
}

}  // namespace

ThesisTables read_thesis_tables(const std::filesystem::path& folder) {
  return {
      .samples = read_samples(folder), .families = read_family_samples(folder), .materials = read_materials(folder)};
}

}  // namespace nacre::game
