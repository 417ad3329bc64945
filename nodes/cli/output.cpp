#include "output.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/no_space.hpp"
#include "base/result.hpp"
#include "material/parameter_file.hpp"
#include "measurement/set_columns.hpp"

namespace nacre::cli {

namespace {

using material::FitTarget;

/// A factor that no ink explains, but a unit does.
constexpr double kFarOff = 100.0;

template <class Vector>
void warn_about_units(const std::string& file, std::string_view table, const Vector& values,
                      std::span<const material::ParameterRange> base,
                      std::span<const material::ParameterRange> microstructures) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double minimum = std::min(base[i].minimum, microstructures[i].minimum),
                 maximum = std::max(base[i].maximum, microstructures[i].maximum);
    if (values[i] >= minimum / kFarOff && values[i] <= maximum * kFarOff) continue;
    warn(fmt::format("{}: {}.{} = {:g} lies far outside {:g} to {:g}, where it is fitted: is the unit right?", file,
                     table, base[i].name, values[i], minimum, maximum));
  }
}

}  // namespace

std::string shown(double value) {
  return std::abs(value) < 0.01 ? fmt::format("{:.3g}", value) : fmt::format("{:.4f}", value);
}

void print_json(const nlohmann::ordered_json& document) {
  fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

// Work must not end because nobody can read a remark.
void remark(const std::string& line) { std::fputs((line + "\n").c_str(), stderr); }

void warn(const std::string& line) { remark("warning: " + line); }

void warn_about(const measurement::MeasurementSet& set, const std::string& folder) {
  for (const std::string& warning : set.warnings) warn(warning);
  for (const auto& row : set.rejected) warn_about(row, folder);
}

void warn_about(const measurement::RejectedRow& row, const std::string& folder) {
  warn_about_table(row, (std::filesystem::path(folder) / measurement::kTableName).string());
}

void warn_about_table(const measurement::RejectedRow& row, const std::string& table) {
  const std::string column = row.column.empty() ? "" : fmt::format("column {}: ", row.column);
  warn(fmt::format("{}:{}: {}{}", table, row.line, column, row.reason));
}

nlohmann::ordered_json row_json(const measurement::RejectedRow& row) {
  return {{"line", row.line}, {"column", row.column}, {"reason", row.reason}};
}

nlohmann::ordered_json rejected_json(const std::vector<measurement::RejectedRow>& rejected) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : rejected) rows.push_back(row_json(row));
  return rows;
}

void check_standard_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const int reason = errno;
  refuse_write(fmt::format("standard output: cannot be written: {}", std::strerror(reason)), reason);
}

material::ParameterSet parameters_from_option(const std::string& file, const material::ParameterSet& start,
                                              const material::ParameterRanges& ranges) {
  if (file.empty()) return start;
  const material::ParameterSet set = material::read_parameters(file, start);
  warn_about_units(file, set, ranges);
  return set;
}

void warn_about_units(const std::string& file, const material::ParameterSet& set,
                      const material::ParameterRanges& ranges) {
  warn_about_units(file, "modulus", to_vector(set.modulus), ranges.modulus(FitTarget::base),
                   ranges.modulus(FitTarget::microstructures));
  warn_about_units(file, "toughness", to_vector(set.toughness), ranges.toughness(FitTarget::base),
                   ranges.toughness(FitTarget::microstructures));
}

void warn_about_units(const std::string& file, const material::ParameterRanges& ranges) {
  const material::ParameterRanges& usual = material::thesis_ranges();
  const auto compare = [&](std::string_view table, std::span<const material::ParameterRange> own,
                           std::span<const material::ParameterRange> other) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i].maximum >= other[i].minimum / kFarOff && own[i].minimum <= other[i].maximum * kFarOff) continue;
      warn(fmt::format("{}: {}.{} from {:g} to {:g} lies far outside the thesis' {:g} to {:g}: is the unit right?",
                       file, table, own[i].name, own[i].minimum, own[i].maximum, other[i].minimum, other[i].maximum));
    }
  };
  for (const FitTarget target : {FitTarget::base, FitTarget::microstructures}) {
    compare("modulus", ranges.modulus(target), usual.modulus(target));
    compare("toughness", ranges.toughness(target), usual.toughness(target));
  }
}

material::StartingModel starting_model_from_options(const std::string& parameters, const std::string& ranges) {
  material::StartingModel model = material::starting_model(parameters, ranges);
  if (!parameters.empty()) warn_about_units(parameters, model.parameters, model.ranges);
  return model;
}

tester::Fidelity fidelity_from_option(const std::string& name) {
  const auto fidelity = tester::fidelity_from_string(name);
  if (!fidelity) throw InputError::format("--fidelity {}: {}", name, fidelity.error().message);
  return *fidelity;
}

std::string file_stem(const std::string& design_name) {
  std::string stem = design_name;
  std::replace(stem.begin(), stem.end(), ':', '_');
  return stem;
}

}  // namespace nacre::cli
