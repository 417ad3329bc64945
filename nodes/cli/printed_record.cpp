#include "printed_record.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::cli {
namespace {

constexpr const char* kColumns[] = {"label", "design", "test", "orientation_deg", "order_id", "by"};
constexpr std::size_t kColumnCount = std::size(kColumns);

std::filesystem::path printed_file(const RunAccess& run) { return run.folder / "laboratory" / "printed.csv"; }

game::PrintedSpecimen printed_of(const std::string& place, const std::string& label, const std::string& design,
                                 const std::string& test, double orientation_deg, const std::string& order_id) {
  const auto named = pattern::design_from_name(design);
  if (!named) throw InputError::format("{}: {}", place, named.error().message);
  const auto kind = tester::test_kind_from_string(test);
  if (!kind) throw InputError::format("{}: {}", place, kind.error().message);
  return {label, *named, *kind, orientation_deg, order_id};
}

/// A label names a measurement later: it can stand for one specimen only.
InputError another_specimen(const game::PrintedSpecimen& known) {
  return InputError::format(
      "{}: is printed already, as a specimen of {} ({} test); expected labels that the run does not know: make this "
      "job again with --batch NAME --replace, which changes its labels only, and write those on the specimens",
      known.label, known.design.name(), tester::to_string(known.test));
}

void write_printed(const RunAccess& run, const std::vector<PrintedRow>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(kColumns, ","));
  for (const auto& [specimen, person] : rows) {
    text += fmt::format("{},{},{},{},{},{}\n", csv_cell(specimen.label), csv_cell(specimen.design.name()),
                        tester::to_string(specimen.test), specimen.orientation_deg, csv_cell(specimen.order_id),
                        csv_cell(person));
  }
  make_folder(printed_file(run).parent_path().string());
  write_file_atomically(printed_file(run), text);
}

}  // namespace

std::vector<PrintedRow> read_printed(const RunAccess& run) {
  std::vector<PrintedRow> rows;
  const std::filesystem::path file = printed_file(run);
  if (!std::filesystem::exists(file)) return rows;
  const std::string text = read_file(file);
  CsvReader reader(text, file.string());
  CsvRow row;
  bool is_heading = true;
  while (reader.next(row)) {
    if (std::exchange(is_heading, false) || row.blank()) continue;
    const std::string place = fmt::format("{}:{}", file.string(), row.line);
    if (!row.fault.empty() || row.cells.size() != kColumnCount)
      throw InputError::format("{}: expected {} cells: {}", place, kColumnCount, fmt::join(kColumns, ","));
    const auto cell = [&](std::size_t i) { return row.cells[i].text; };
    const auto orientation = number_from_text(cell(3));
    if (!orientation) throw InputError::format("{}: orientation_deg: {}", place, orientation.error().message);
    rows.emplace_back(printed_of(place, cell(0), cell(1), cell(2), *orientation, cell(4)), cell(5));
  }
  return rows;
}

int record_printed(const RunAccess& run, const std::vector<game::PrintedSpecimen>& specimens, const std::string& by) {
  std::vector<PrintedRow> rows = read_printed(run);
  std::map<std::string, game::PrintedSpecimen> known;
  for (const auto& [specimen, person] : rows) known.emplace(specimen.label, specimen);
  const std::size_t before = rows.size();
  for (const game::PrintedSpecimen& specimen : specimens) {
    const auto [entry, is_new] = known.emplace(specimen.label, specimen);
    if (is_new) rows.emplace_back(specimen, by);
    if (entry->second != specimen) throw another_specimen(entry->second);
  }
  write_printed(run, rows);
  return static_cast<int>(rows.size() - before);
}

std::set<std::string> measured_names(const game::LaboratoryFacts& facts) {
  std::set<std::string> names;
  for (const measurement::SpecimenRecord& specimen : facts.book.specimens()) names.insert(specimen.specimen);
  return names;
}

int forget_printed(const RunAccess& run, const std::vector<game::PrintedSpecimen>& specimens,
                   const std::set<std::string>& measured) {
  std::set<std::string> labels;
  for (const game::PrintedSpecimen& specimen : specimens) {
    if (measured.contains(specimen.label))
      throw InputError::format("{}: is measured, so it was printed; expected specimens that are not", specimen.label);
    labels.insert(specimen.label);
  }
  std::vector<PrintedRow> rows = read_printed(run);
  const auto taken = std::erase_if(rows, [&](const PrintedRow& row) { return labels.contains(row.first.label); });
  write_printed(run, rows);
  return static_cast<int>(taken);
}

std::vector<game::PrintedSpecimen> specimens_of_build_sheet(const std::filesystem::path& file,
                                                            std::optional<int> tray) {
  std::vector<game::PrintedSpecimen> specimens;
  try {
    const auto sheet = nlohmann::json::parse(read_file(file));
    for (const auto& specimen : sheet.at("specimens")) {
      if (tray && specimen.at("tray") != *tray) continue;
      const auto& models = sheet.at("models");
      const auto model = std::find_if(models.begin(), models.end(),
                                      [&](const auto& each) { return each.at("name") == specimen.at("model"); });
      if (model == models.end())
        throw InputError::format("{}: specimens: model {} is not listed", file.string(),
                                 specimen.at("model").template get<std::string>());
      specimens.push_back(printed_of(file.string(), specimen.at("label"), specimen.at("design"), specimen.at("test"),
                                     model->at("orientation_deg"), model->at("order_id")));
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError::format("{}: no build sheet: {}; expected build_sheet.json of nacre fabricate", file.string(),
                             error.what());
  }
  if (specimens.empty() && tray) throw InputError::format("{}: has no tray {}", file.string(), *tray);
  return specimens;
}

std::filesystem::path jobs_folder(const RunAccess& run) { return run.folder / "laboratory" / "jobs"; }

}  // namespace nacre::cli
