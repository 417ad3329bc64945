#include "output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/result.hpp"

namespace nacre::cli {

void print_json(const nlohmann::ordered_json& document) {
  fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void remark(const std::string& line) { fmt::print(stderr, "{}\n", line); }

void warn(const std::string& line) { fmt::print(stderr, "warning: {}\n", line); }

void warn_about(const measurement::MeasurementSet& set, const std::string& name) {
  for (const std::string& warning : set.warnings) warn(warning);
  for (const auto& row : set.rejected) warn(fmt::format("{}: line {}, {}: {}", name, row.line, row.column, row.reason));
}

void check_standard_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw InputError::format("standard output: cannot be written: {}", std::strerror(errno));
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

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError::format("{}: cannot be made: {}", folder, error.message());
}

}  // namespace nacre::cli
