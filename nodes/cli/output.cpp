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
#include "material/unit_doubts.hpp"
#include "measurement/set_columns.hpp"

namespace nacre::cli {

std::string shown(double value) {
  return std::abs(value) < 0.01 ? fmt::format("{:.3g}", value) : fmt::format("{:.4f}", value);
}

void print_json(const nlohmann::ordered_json& document) {
  fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

// Work must not end because nobody can read a remark.
void remark(const std::string& line) { std::fputs((line + "\n").c_str(), stderr); }

void warn(const std::string& line) { remark("warning: " + line); }

void warn_all(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) warn(line);
}

void warn_about(const measurement::MeasurementSet& set, const std::string& folder) {
  warn_all(set.warnings);
  for (const auto& row : set.rejected) warn_about(row, folder);
}

void warn_about(const measurement::RejectedRow& row, const std::string& folder) {
  warn_about_table(row, (std::filesystem::path(folder) / measurement::kTableName).string());
}

void warn_about_table(const measurement::RejectedRow& row, const std::string& table) {
  const std::string column = row.column.empty() ? "" : fmt::format("column {}: ", row.column);
  warn(fmt::format("{}:{}: {}{}", table, row.line, column, row.reason));
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
  warn_all(material::unit_doubts(file, set, ranges));
  return set;
}

material::StartingModel starting_model_from_options(const std::string& parameters, const std::string& ranges) {
  material::StartingModel model = material::starting_model(parameters, ranges);
  if (!parameters.empty()) warn_all(material::unit_doubts(parameters, model.parameters, model.ranges));
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
