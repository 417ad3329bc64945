#include "material/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <fmt/ranges.h>

#include "base/files.hpp"
#include "base/named_table.hpp"

namespace nacre::material {
namespace {

// Table A.1, Young's modulus.
constexpr std::array<ParameterRange, kModulusParameterCount> kModulusBase = {{{"e_tb_pa", 8.08e5, 1.21e6},
                                                                              {"e_vw_pa", 2.13e9, 3.19e9},
                                                                              {"e_if_pa", 4.51e8, 6.77e8},
                                                                              {"nu_tb", 0.4, 0.5},
                                                                              {"nu_vw", 0.2, 0.4},
                                                                              {"nu_if", 0.3, 0.4},
                                                                              {"gamma_per_s", 2e4, 2e6}}};
// Table A.1, toughness.
constexpr std::array<ParameterRange, kToughnessParameterCount> kToughnessBase = {{{"e_tb_pa", 1e5, 2e6},
                                                                                  {"e_vw_pa", 1e7, 1e9},
                                                                                  {"e_if_pa", 1e7, 1e9},
                                                                                  {"nu_tb", 0.4, 0.5},
                                                                                  {"nu_vw", 0.2, 0.4},
                                                                                  {"nu_if", 0.3, 0.4},
                                                                                  {"w_tb_j_per_m3", 5e4, 1e6},
                                                                                  {"w_vw_j_per_m3", 5e4, 1e7},
                                                                                  {"w_if_j_per_m3", 1e6, 1e8},
                                                                                  {"gamma_per_s", 2e4, 4e6}}};
// Table A.2, Young's modulus.
constexpr std::array<ParameterRange, kModulusParameterCount> kModulusMicrostructures = {{{"e_tb_pa", 8e5, 1.2e6},
                                                                                         {"e_vw_pa", 2.08e9, 3.12e9},
                                                                                         {"e_if_pa", 4.48e8, 6.72e8},
                                                                                         {"nu_tb", 0.4, 0.5},
                                                                                         {"nu_vw", 0.2, 0.4},
                                                                                         {"nu_if", 0.3, 0.4},
                                                                                         {"gamma_per_s", 2e4, 2e6}}};
// Table A.2, toughness.
constexpr std::array<ParameterRange, kToughnessParameterCount> kToughnessMicrostructures = {
    {{"e_tb_pa", 5e5, 5e8},
     {"e_vw_pa", 5e7, 1e9},
     {"e_if_pa", 1e7, 5e8},
     {"nu_tb", 0.4, 0.5},
     {"nu_vw", 0.2, 0.4},
     {"nu_if", 0.3, 0.4},
     {"w_tb_j_per_m3", 5e4, 1e6},
     {"w_vw_j_per_m3", 5e5, 1e7},
     {"w_if_j_per_m3", 1e6, 1e8},
     {"gamma_per_s", 2e4, 4e6}}};

std::span<ParameterRange> table_of(ParameterRanges& ranges, const NamedTable& file, std::size_t row) {
  const std::string &tester = file.text(row, "tester"), &fitted_to = file.text(row, "fitted_to");
  if (tester != "modulus" && tester != "toughness")
    file.fail_at(row, "tester", fmt::format("expected modulus or toughness, found '{}'", tester));
  if (fitted_to != "base" && fitted_to != "microstructures")
    file.fail_at(row, "fitted_to", fmt::format("expected base or microstructures, found '{}'", fitted_to));
  const bool is_base = fitted_to == "base";
  if (tester == "modulus") return is_base ? ranges.base_modulus : ranges.microstructure_modulus;
  return is_base ? std::span<ParameterRange>(ranges.base_toughness) : ranges.microstructure_toughness;
}

ParameterRange& range_of(ParameterRanges& ranges, const NamedTable& file, std::size_t row) {
  const std::span<ParameterRange> table = table_of(ranges, file, row);
  const std::string& name = file.text(row, "parameter");
  const auto found = std::ranges::find(table, name, &ParameterRange::name);
  if (found == table.end())
    file.fail_at(row, "parameter",
                 fmt::format("expected one of {}, found '{}'",
                             fmt::join(file.text(row, "tester") == "modulus" ? modulus_parameter_names()
                                                                             : toughness_parameter_names(),
                                       ", "),
                             name));
  return *found;
}

template <class Vector>
Vector brought_inside(Vector vector, std::span<const ParameterRange> ranges) {
  for (std::size_t i = 0; i < vector.size(); ++i) {
    if (vector[i] < ranges[i].minimum || vector[i] > ranges[i].maximum) vector[i] = from_unit(ranges[i], 0.5);
  }
  return vector;
}

}  // namespace

double to_unit(const ParameterRange& range, double value) {
  if (!range.logarithmic()) return (value - range.minimum) / (range.maximum - range.minimum);
  return std::log(value / range.minimum) / std::log(range.maximum / range.minimum);
}

double from_unit(const ParameterRange& range, double unit) {
  if (!range.logarithmic()) return range.minimum + unit * (range.maximum - range.minimum);
  return range.minimum * std::pow(range.maximum / range.minimum, unit);
}

std::span<const ParameterRange> ParameterRanges::modulus(FitTarget target) const {
  return target == FitTarget::base ? base_modulus : microstructure_modulus;
}

std::span<const ParameterRange> ParameterRanges::toughness(FitTarget target) const {
  return target == FitTarget::base ? base_toughness : microstructure_toughness;
}

const ParameterRanges& thesis_ranges() {
  static constexpr ParameterRanges kThesis = {.base_modulus = kModulusBase,
                                              .microstructure_modulus = kModulusMicrostructures,
                                              .base_toughness = kToughnessBase,
                                              .microstructure_toughness = kToughnessMicrostructures};
  return kThesis;
}

ParameterSet brought_inside(const ParameterSet& set, const ParameterRanges& ranges) {
  ParameterSet inside = set;
  inside.modulus = modulus_from_vector(brought_inside(to_vector(set.modulus), ranges.microstructure_modulus));
  inside.toughness = toughness_from_vector(brought_inside(to_vector(set.toughness), ranges.microstructure_toughness));
  return inside;
}

ParameterRanges parse_ranges(std::string_view text, const std::string& source, const ParameterRanges& otherwise) {
  constexpr double kLargestPoissonRatio = 0.5;
  const NamedTable file(source, text, {"tester", "fitted_to", "parameter", "minimum", "maximum"});
  ParameterRanges ranges = otherwise;
  std::set<const ParameterRange*> given;
  for (std::size_t row = 0; row < file.size(); ++row) {
    ParameterRange& range = range_of(ranges, file, row);
    if (!given.insert(&range).second)
      file.fail_at(row, "parameter", fmt::format("{} is listed a second time", range.name));
    range.minimum = file.positive(row, "minimum");
    range.maximum = file.positive(row, "maximum");
    if (range.name.starts_with("nu_") && range.maximum > kLargestPoissonRatio)
      file.fail_at(
          row, "maximum",
          fmt::format("expected at most {} for {}, found {}", kLargestPoissonRatio, range.name, range.maximum));
    if (range.minimum >= range.maximum)
      file.fail_at(row, "maximum",
                   fmt::format("expected more than the minimum {}, found {}", range.minimum, range.maximum));
  }
  return ranges;
}

ParameterRanges read_ranges(const std::filesystem::path& path, const ParameterRanges& otherwise) {
  return parse_ranges(read_file(path), path.string(), otherwise);
}

std::string to_csv(const ParameterRanges& ranges) {
  std::string text = "tester,fitted_to,parameter,minimum,maximum\n";
  for (const FitTarget target : {FitTarget::base, FitTarget::microstructures}) {
    const std::string_view fitted_to = target == FitTarget::base ? "base" : "microstructures";
    for (const ParameterRange& range : ranges.modulus(target))
      text += fmt::format("modulus,{},{},{},{}\n", fitted_to, range.name, range.minimum, range.maximum);
    for (const ParameterRange& range : ranges.toughness(target))
      text += fmt::format("toughness,{},{},{},{}\n", fitted_to, range.name, range.minimum, range.maximum);
  }
  return text;
}

}  // namespace nacre::material
