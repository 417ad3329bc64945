// Part of the command line (command.hpp): nacre import, raw exports of a testing machine as a measurement set.

#include "measurement/import.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/counted.hpp"
#include "command.hpp"
#include "measurement/write_import.hpp"
#include "output.hpp"

namespace nacre::cli {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string sheet;
  std::string out;
  std::string toe = "compensate";
  bool replace = false;
  bool json = false;
};

nlohmann::ordered_json to_json(const measurement::ImportedSpecimen& one) {
  const measurement::SpecimenRecord& record = one.record;
  return {{"specimen", record.specimen},
          {"file", one.file},
          {"maker", one.maker},
          {"pattern", record.design.name()},
          {"test", std::string(tester::to_string(record.test))},
          {"modulus_pa", one.test.modulus_pa},
          {"toughness_pa", one.test.toughness_pa},
          {"peak_stress_pa", one.test.peak_stress_pa},
          {"failure_strain", one.test.failure_strain},
          {"toe_strain", one.test.toe_strain},
          {"extension_column", one.extension_column},
          {"gauge_mm", one.gauge_mm},
          {"strain_rate_per_s", record.conditions.strain_rate_per_s},
          {"separated", one.test.separated},
          {"points", one.test.curve.size()},
          {"valid", record.valid},
          {"note", record.note}};
}

nlohmann::ordered_json to_json(const measurement::ImportFault& fault) {
  nlohmann::ordered_json document = {{"file", fault.file}};
  document.update(row_json(measurement::RejectedRow{fault.line, fault.column, fault.reason}));
  return document;
}

void print_import(const measurement::Import& import, const Options& options) {
  if (!options.json) {
    for (const auto& one : import.specimens) {
      fmt::print("{:16} {:20} E {:>9} GPa  T {:>8} MPa  peak {:7.3f} MPa  failure at {:6.2f} %  toe {:5.3f} %{}\n",
                 one.record.specimen, one.maker, shown(1e-9 * one.test.modulus_pa), shown(1e-6 * one.test.toughness_pa),
                 1e-6 * one.test.peak_stress_pa, 100.0 * one.test.failure_strain, 100.0 * one.test.toe_strain,
                 one.record.valid ? "" : "  NOT VALID");
    }
    fmt::print("{}{}{}, {} rejected: {}\n", counted(static_cast<std::int64_t>(import.specimens.size()), "specimen"),
               import.known > 0 ? fmt::format(" ({} there before)", import.known) : "",
               import.replaced > 0 ? fmt::format(" ({} replaced)", import.replaced) : "", import.rejected.size(),
               options.out);
    return;
  }
  nlohmann::ordered_json specimens = nlohmann::ordered_json::array(), rejected = specimens;
  for (const auto& one : import.specimens) specimens.push_back(to_json(one));
  for (const auto& fault : import.rejected) rejected.push_back(to_json(fault));
  print_json({{"set", options.out},
              {"specimens", specimens},
              {"known", import.known},
              {"replaced", import.replaced},
              {"rejected", rejected},
              {"warnings", import.warnings}});
}

int import_exports(const Options& options) {
  const measurement::ImportSettings settings{.toe = options.toe == "keep" ? measurement::Toe::keep
                                                                          : measurement::Toe::compensate};
  measurement::Import import = measurement::import_exports(
      std::vector<std::filesystem::path>(options.files.begin(), options.files.end()), options.sheet, settings);
  measurement::write_import(options.out, options.sheet, import, options.replace);
  for (const std::string& warning : import.warnings) warn(warning);
  for (const auto& fault : import.rejected) warn(to_string(fault));
  if (import.specimens.empty()) {
    throw InputError::format("{}: none of its specimens is usable; the first: {}", options.sheet,
                             import.rejected.empty() ? "no rows" : to_string(import.rejected.front()));
  }
  print_import(import, options);
  return 0;
}

}  // namespace

void add_import(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = add_command(app, action, "import", "Turn exports of a testing machine into a measurement set",
                                  options, import_exports);
  command.add_option(
      "TESTER.csv", options->files,
      "Exports (Bluehill, testXpert, MTS, plain tables); default: those that the sheet names, in its folder");
  command
      .add_option("--specimens", options->sheet,
                  "Specimen sheet: which file is which specimen, and its width and thickness")
      ->required()
      ->check(CLI::ExistingFile);
  command.add_option("--out", options->out, "Folder of the measurement set; specimens are added to one that exists")
      ->required();
  command.add_flag("--replace", options->replace,
                   "Replace specimens that the set holds with other values; whether they are valid stays");
  command.add_option("--toe", options->toe, "Flat beginning of the curves: compensate (ASTM D638 A1) or keep")
      ->check(CLI::IsMember({"compensate", "keep"}))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
