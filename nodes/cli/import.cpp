// Part of the command line (command.hpp): nacre import, raw exports of a testing machine as a measurement set.

#include "measurement/import.hpp"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "base/counted.hpp"
#include "base/files.hpp"
#include "command.hpp"
#include "measurement/export_list.hpp"
#include "measurement/set_files.hpp"
#include "measurement/write_import.hpp"
#include "output.hpp"
#include "report/import_preview.hpp"

namespace nacre::cli {
namespace {

struct ImportOptions {
  std::vector<std::string> files;
  std::string sheet;
  std::string out;
  std::string toe = "compensate";
  std::string preview;
  bool list = false;
  bool replace = false;
  bool confined = false;
  bool yes = false;
  bool json = false;
};

/// A value that comes from the curve: null where the specimen has none.
nlohmann::ordered_json of_curve(const measurement::ImportedSpecimen& one, double value) {
  return one.test.curve.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(value);
}

/// At most 60 points of a curve, its peak and its end among them: enough for a small picture.
nlohmann::ordered_json to_json(const tester::Curve& curve) {
  constexpr std::size_t kMost = 58;
  nlohmann::ordered_json strain = nlohmann::ordered_json::array(), stress_pa = strain;
  const std::size_t step = (curve.size() + kMost - 1) / kMost;
  const auto peak = std::max_element(curve.stress_pa.begin(), curve.stress_pa.end()) - curve.stress_pa.begin();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i % step != 0 && i != static_cast<std::size_t>(peak) && i + 1 != curve.size()) continue;
    strain.push_back(curve.strain[i]);
    stress_pa.push_back(curve.stress_pa[i]);
  }
  return {{"strain", strain}, {"stress_pa", stress_pa}};
}

nlohmann::ordered_json to_json(const std::vector<measurement::ImportDoubt>& doubts) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const measurement::ImportDoubt& doubt : doubts)
    list.push_back({{"of_scale", doubt.is_of_scale}, {"text", doubt.text}});
  return list;
}

nlohmann::ordered_json to_json(const measurement::ImportedSpecimen& one) {
  const measurement::SpecimenRecord& record = one.record;
  return {{"specimen", record.specimen},
          {"file", one.file},
          {"line", one.line},
          {"maker", one.maker},
          {"pattern", record.design.name()},
          {"test", std::string(tester::to_string(record.test))},
          {"orientation_deg", record.conditions.orientation_deg},
          {"thickness_mm", record.conditions.thickness_mm},
          {"modulus_pa", one.test.modulus_pa},
          {"modulus_error_pa", of_curve(one, one.test.modulus_error_pa)},
          {"toughness_pa", of_curve(one, one.test.toughness_pa)},
          {"peak_stress_pa", of_curve(one, one.test.peak_stress_pa)},
          {"failure_strain", of_curve(one, one.test.failure_strain)},
          {"toe_strain", of_curve(one, one.test.toe_strain)},
          {"extension_column", one.extension_column},
          {"columns", one.provenance},
          {"decisions", one.decisions},
          {"gauge_mm", one.gauge_mm},
          {"strain_rate_per_s", record.conditions.strain_rate_per_s},
          {"rate_source", one.rate_source},
          {"separated", one.test.separated},
          {"points", one.test.curve.size()},
          {"curve", to_json(one.test.curve)},
          {"doubts", to_json(one.doubts)},
          {"valid", record.valid},
          {"note", record.note}};
}

nlohmann::ordered_json to_json(const measurement::ImportFault& fault) {
  nlohmann::ordered_json document = {{"file", fault.file}, {"specimen", fault.specimen}};
  document.update(row_json(measurement::RejectedRow{fault.line, fault.column, fault.reason}));
  return document;
}

void print_specimen(const measurement::ImportedSpecimen& one) {
  const std::string validity = one.record.valid ? "" : "  NOT VALID";
  if (one.test.curve.empty()) {
    fmt::print("{:16} {:20} E {:>9} GPa  at {:.4g} 1/s: {}{}\n", one.record.specimen, one.maker,
               shown(1e-9 * one.test.modulus_pa), one.record.conditions.strain_rate_per_s, one.record.note, validity);
    return;
  }
  fmt::print("{:16} {:20} E {:>9} GPa  T {:>8} MPa  peak {:7.3f} MPa  failure at {:6.2f} %  toe {:5.3f} %{}\n",
             one.record.specimen, one.maker, shown(1e-9 * one.test.modulus_pa), shown(1e-6 * one.test.toughness_pa),
             1e-6 * one.test.peak_stress_pa, 100.0 * one.test.failure_strain, 100.0 * one.test.toe_strain, validity);
}

/// `set`: the folder that keeps the specimens; empty where none does.
void print_import(const measurement::Import& import, const ImportOptions& options, const std::string& set) {
  if (!options.json) {
    for (std::size_t i = 0; i < import.specimens.size(); ++i) {
      const auto& one = import.specimens[i];
      print_specimen(one);
      const bool goes_on = i + 1 < import.specimens.size() && import.specimens[i + 1].line == one.line;  // a sweep
      if (goes_on) continue;
      for (const std::string& decision : one.decisions) fmt::print("    {}\n", decision);
    }
    fmt::print("{}{}{}, {} rejected: {}\n", counted(import.specimens.size(), "specimen"),
               import.known > 0 ? fmt::format(" ({} there before)", import.known) : "",
               import.replaced > 0 ? fmt::format(" ({} replaced)", import.replaced) : "", import.rejected.size(),
               set.empty() ? "no set written" : set);
    return;
  }
  nlohmann::ordered_json specimens = nlohmann::ordered_json::array(), rejected = specimens;
  for (const auto& one : import.specimens) specimens.push_back(to_json(one));
  for (const auto& fault : import.rejected) rejected.push_back(to_json(fault));
  print_json({{"set", set},
              {"specimens", specimens},
              {"known", import.known},
              {"replaced", import.replaced},
              {"rejected", rejected},
              {"warnings", import.warnings}});
}

void print_part(const measurement::ListedPart& part) {
  fmt::print("  part {}: {} rows below line {}\n", part.name, part.rows, part.line);
  for (const auto& column : part.columns) {
    fmt::print("    {} {:15} {:32} {:8} {:>12} {:>12}  {}\n", column.taken ? '*' : ' ', column.quantity, column.heading,
               column.unit, column.sparkline.empty() ? "" : fmt::format("{:.5g}", column.least),
               column.sparkline.empty() ? "" : fmt::format("{:.5g}", column.most), column.sparkline);
  }
  for (const std::string& decision : part.decisions) fmt::print("    {}\n", decision);
  if (!part.fault.empty()) fmt::print("    refused as it stands: {}\n", part.fault);
}

nlohmann::ordered_json to_json(const measurement::ListedPart& part) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const auto& column : part.columns) {
    columns.push_back({{"heading", column.heading},
                       {"unit", column.unit},
                       {"quantity", column.quantity},
                       {"taken", column.taken},
                       {"least", column.least},
                       {"most", column.most}});
  }
  return {{"part", part.name},  {"line", part.line},           {"rows", part.rows},
          {"columns", columns}, {"decisions", part.decisions}, {"fault", part.fault}};
}

/// What the files hold; 1 where one of them holds nothing.
int list_exports(const ImportOptions& options) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  bool all_read = true;
  for (const std::string& file : options.files) {
    const auto held = measurement::list_export(read_file_up_to(file, measurement::kMostCurveBytes), file);
    all_read = all_read && held.has_value();
    if (!held) {
      warn(to_string(held.error()));
      continue;
    }
    nlohmann::ordered_json parts = nlohmann::ordered_json::array();
    for (const auto& part : held->parts) parts.push_back(to_json(part));
    files.push_back({{"file", file},
                     {"maker", held->maker},
                     {"encoding", held->encoding},
                     {"parts", parts},
                     {"notes", held->notes}});
    if (options.json) continue;
    fmt::print("{}: {}, {}, {}\n", file, held->maker, held->encoding, held->delimiter);
    for (const auto& part : held->parts) print_part(part);
    for (const std::string& note : held->notes) fmt::print("  {}\n", note);
  }
  if (options.json) print_json({{"files", files}});
  return all_read ? 0 : 1;
}

void check(const ImportOptions& options) {
  if (options.sheet.empty()) throw InputError("--specimens is missing, expected the sheet (or --list FILE)");
  if (options.out.empty() && (options.preview.empty() || options.yes))
    throw InputError::format("--out is missing, expected the folder of the measurement set{}",
                             options.yes ? "" : " (or --preview PAGE.html)");
}

/// Warnings and rejected specimens of an import, each once.
class Told {
 public:
  void tell(const measurement::Import& import) {
    for (; warnings_ < import.warnings.size(); ++warnings_) warn(import.warnings[warnings_]);
    for (; rejected_ < import.rejected.size(); ++rejected_) warn(to_string(import.rejected[rejected_]));
  }

 private:
  std::size_t warnings_ = 0, rejected_ = 0;
};

/// Whether what the page shows is to be kept, as the person or `--yes` says; nothing where nobody can be asked.
std::optional<bool> is_approved(const ImportOptions& options, std::size_t specimens) {
  if (options.yes) return true;
  if (options.out.empty() || ::isatty(STDIN_FILENO) == 0) return std::nullopt;
  std::cerr << fmt::format("Import {} into {}? [y/N] ", counted(specimens, "specimen"), options.out) << std::flush;
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

int import_exports(const ImportOptions& options) {
  if (options.list) {
    if (options.files.empty()) throw InputError("--list: expected one file or more");
    return list_exports(options);
  }
  check(options);
  const measurement::ImportSettings settings{
      .toe = options.toe == "keep" ? measurement::Toe::keep : measurement::Toe::compensate,
      .confined = options.confined};
  measurement::Import import = measurement::import_exports(
      std::vector<std::filesystem::path>(options.files.begin(), options.files.end()), options.sheet, settings);
  const bool is_shown = !options.preview.empty();
  std::optional<bool> approved = !is_shown;
  Told told;
  if (is_shown) {
    write_file_atomically(options.preview, report::import_preview(import, options.sheet));
    told.tell(import);
    remark(fmt::format("{}: shows what would be imported", options.preview));
    if (!import.specimens.empty()) approved = is_approved(options, import.specimens.size());
    if (!approved) remark("no set is written; the same with --out SET --yes keeps it");
  }
  if (approved.value_or(false)) measurement::write_import(options.out, options.sheet, import, options.replace);
  told.tell(import);
  if (import.specimens.empty()) {
    if (options.json) print_import(import, options, "");
    throw InputError::format("{}: none of its specimens is usable; the first: {}", options.sheet,
                             import.rejected.empty() ? "no rows" : to_string(import.rejected.front()));
  }
  print_import(import, options, approved.value_or(false) ? options.out : "");
  return approved.value_or(true) ? 0 : 1;
}

}  // namespace

void add_import(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App& command = add_command(app, action, "import", "Turn exports of a testing machine into a measurement set",
                                  options, import_exports);
  command.add_option(
      "TESTER.csv", options->files,
      "Exports (Bluehill, testXpert, MTS, sweeps, plain tables); default: those that the sheet names, in its folder");
  command
      .add_option("--specimens", options->sheet,
                  "Specimen sheet: which file is which specimen, and its width and thickness")
      ->check(CLI::ExistingFile);
  command.add_option("--out", options->out, "Folder of the measurement set; specimens are added to one that exists");
  command.add_flag("--list", options->list,
                   "Show what the files hold: parts, columns, units, ranges; nothing is imported");
  command.add_option("--preview", options->preview,
                     "Write this HTML page of what would be imported, then ask whether --out keeps it");
  command.add_flag("--yes", options->yes, "Keep what --preview shows without asking");
  command.add_flag("--replace", options->replace,
                   "Replace specimens that the set holds with other values; whether they are valid stays");
  command.add_flag("--confined", options->confined,
                   "Read nothing outside the sheet's folder, whatever the sheet names: for sheets from strangers");
  command.add_option("--toe", options->toe, "Flat beginning of the curves: compensate (ASTM D638 A1) or keep")
      ->check(CLI::IsMember({"compensate", "keep"}))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
