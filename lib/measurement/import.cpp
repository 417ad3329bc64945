#include "measurement/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "measurement/conditions.hpp"
#include "measurement/consistency.hpp"
#include "measurement/import_relaxation.hpp"
#include "measurement/import_sweep.hpp"
#include "measurement/limits.hpp"
#include "measurement/loading_part.hpp"
#include "measurement/nominal_curve.hpp"
#include "measurement/plausibility.hpp"
#include "measurement/provenance.hpp"
#include "measurement/rounded.hpp"
#include "measurement/set_files.hpp"
#include "measurement/sheet_exports.hpp"
#include "measurement/specimen_checks.hpp"
#include "measurement/specimen_sheet.hpp"
#include "measurement/strain_rate.hpp"
#include "thesis/constants.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;

/// Leaves out what stands before the pull; says so.
void cut_before_pull(std::vector<double>& time_s, tester::Curve& curve, const PullStart& start,
                     std::vector<std::string>& decisions) {
  if (start.row == 0) return;
  const auto rows = static_cast<std::ptrdiff_t>(start.row);
  curve.strain.erase(curve.strain.begin(), curve.strain.begin() + rows);
  curve.stress_pa.erase(curve.stress_pa.begin(), curve.stress_pa.begin() + rows);
  for (double& strain : curve.strain) strain -= start.zero_strain;
  if (!time_s.empty()) time_s.erase(time_s.begin(), time_s.begin() + rows);
  decisions.push_back(fmt::format("{} rows before the pull left out ({})", start.row,
                                  start.was_tared ? "the extension was set to zero" : "the extension stands still"));
}

void keep_history(const TesterRecord& from, const ReducedTest& test, SpecimenRecord& record) {
  for (const auto& [name, text] : from.header) record.other_columns.try_emplace(name, text);
  const auto keep = [&](const char* name, double value) {
    record.other_columns[name] = fmt::format("{}", rounded(value, 6));
  };
  keep("peak_stress_pa", test.peak_stress_pa);
  keep("failure_strain", test.failure_strain);
  keep("toe_strain", test.toe_strain);
  keep("modulus_error_pa", test.modulus_error_pa);
  if (record.test != tester::TestKind::modulus) keep("initial_modulus_pa", test.modulus_pa);
}

void set_values(const ReducedTest& test, SpecimenRecord& record) {
  record.curve = test.curve;
  if (record.test == tester::TestKind::modulus) record.modulus_pa = rounded(test.modulus_pa, 6);
  if (record.test != tester::TestKind::toughness) return;
  record.toughness_pa = rounded(test.toughness_pa, 6);
  if (test.separated) return;
  record.valid = false;
  const std::string why = test.unloaded ? "not separated: the strain returns with the force"
                                        : fmt::format("not separated: the record ends at {:.0f} % of the peak force",
                                                      100.0 * test.residual_share);
  record.note += (record.note.empty() ? "" : "; ") + why;
}

/// Which file, part, columns and units the numbers came from.
std::map<std::string, std::string> provenance_of(const TesterRecord& from, const SheetRow& row) {
  std::map<std::string, std::string> cells = provenance_of_file(from, row);
  for (const Quantity quantity :
       {Quantity::time, Quantity::extension, Quantity::force, Quantity::strain, Quantity::stress})
    add_provenance(to_string(quantity), from.column(quantity), cells);
  return cells;
}

/// The units of columns without one, from what the record shows when its numbers are taken as they stand.
tl::expected<AssumedUnits, std::string> settle_units(const TesterRecord& from, const SheetRow& row, Toe toe) {
  const bool lacks =
      lacks_unit(from, Quantity::extension) || lacks_unit(from, Quantity::force) || lacks_unit(from, Quantity::time);
  for (const Quantity quantity : {Quantity::strain, Quantity::stress}) {
    if (lacks_unit(from, quantity))
      return tl::unexpected(
          fmt::format("column `{}` has no unit that is read, expected one of {} in the heading, or in the "
                      "column `unit` of the sheet",
                      from.column(quantity)->heading, expected_units(quantity)));
  }
  if (!lacks) return AssumedUnits{};
  const tester::Curve curve = nominal_curve(from, row, {});
  const Result<ReducedTest> test = reduce(curve, toe);
  if (!test) return tl::unexpected(test.error().message);
  UnitEvidence evidence{.modulus_pa = test->modulus_pa,
                        .peak_pa = test->peak_stress_pa,
                        .failure_strain = test->failure_strain,
                        .rigid_fraction = row.record.design.rigid_fraction(),
                        .is_homogeneous = row.record.design.mixture() != nullptr};
  evidence.speed_per_s = row.gauge_mm * strain_rate(from.time_s, curve).value_or(0.0);
  return assumed_units(from, evidence);
}

/// The strain rate: the sheet's, else that of the record, else the planned one.
void set_rate(const TesterRecord& from, const SheetRow& row, const std::vector<double>& time_s,
              const tester::Curve& curve, ImportedSpecimen& imported) {
  double& rate_per_s = imported.record.conditions.strain_rate_per_s;
  const auto recorded = strain_rate(time_s, curve);
  imported.rate_source = row.rate_is_given        ? "sheet"
                         : recorded               ? "record"
                         : row.planned_rate_per_s ? "planned"
                                                  : "default";
  if (row.rate_is_given) return;
  if (recorded) {
    rate_per_s = rounded(*recorded, 3);
  } else if (!from.time_s.empty()) {
    imported.doubts.push_back(
        {false, fmt::format("no strain rate can be computed from its times; {} 1/s is assumed", rate_per_s)});
  } else {
    const std::string said = fmt::format("no clock is read; the strain rate {} 1/s is {}", rate_per_s,
                                         row.planned_rate_per_s ? "the planned one" : "assumed");
    imported.decisions.push_back(said);
    if (!row.planned_rate_per_s)
      imported.doubts.push_back(
          {false, fmt::format("{}; expected strain_rate_per_s in the sheet, or time_column", said)});
  }
}

tl::expected<ImportedSpecimen, ImportFault> import_one(const SheetRow& row, const TesterRecord& from,
                                                       const std::string& shown_file, const ImportSettings& settings) {
  const auto fault = [&](std::string column, std::string reason) {
    return tl::unexpected(
        ImportFault{shown_file, from.line.empty() ? 0 : from.line.front(), std::move(column), std::move(reason)});
  };
  if (from.line.size() < kFewestCurveRows)
    return fault("", fmt::format("has {} rows of data, expected at least {}", from.line.size(), kFewestCurveRows));
  ImportedSpecimen imported{
      .record = row.record,
      .file = shown_file,
      .line = row.line,
      .maker = from.maker,
      .extension_column = from.column(Quantity::extension) ? from.column(Quantity::extension)->heading : std::string(),
      .gauge_mm = row.gauge_mm,
      .decisions = from.decisions};
  tester::Curve curve = nominal_curve(from, row, {});
  if (const auto implausible = implausible_record(from, shown_file)) return tl::unexpected(*implausible);
  const auto units = settle_units(from, row, settings.toe);
  if (!units) return fault("", units.error());
  for (const std::string& said : units->said) {
    imported.doubts.push_back({true, said});
    imported.decisions.push_back(said);
  }
  std::vector<double> time_s = units->time_factor == 0.0 ? std::vector<double>{} : from.time_s;
  if (units->extension_factor != 1.0 || units->force_factor != 1.0) curve = nominal_curve(from, row, *units);
  cut_before_pull(time_s, curve, pull_start(time_s, curve), imported.decisions);
  const auto least = std::min_element(curve.strain.begin(), curve.strain.end());
  if (*least <= -1.0)
    return fault("extension",
                 fmt::format("the extension falls by the whole gauge of {} mm, expected tension", row.gauge_mm));
  const Result<ReducedTest> test = reduce(curve, settings.toe);
  if (!test) return fault("force", test.error().message);
  if (test->curve.size() < kFewestCurveRows)
    return fault("", fmt::format("{} points are left after the toe, expected at least {}", test->curve.size(),
                                 kFewestCurveRows));
  // The area of a modulus test that is unloaded is noise; linear_part() has checked its sign.
  if (row.record.test == tester::TestKind::toughness && test->toughness_pa <= 0.0)
    return fault("", "the area under the curve is not positive, expected a test in tension");
  for (const std::string& doubt : doubts_of_course(curve.stress_pa)) imported.doubts.push_back({false, doubt});
  imported.test = *test;
  imported.provenance = provenance_of(from, row);
  set_rate(from, row, time_s, curve, imported);
  set_values(*test, imported.record);
  keep_history(from, *test, imported.record);
  return imported;
}

/// A doubt about the size of a specimen in the sheet, or nothing: wrong units are off by factors of ten and more.
std::string doubt_of_size(const SheetRow& row) {
  constexpr double kBarWidthMm = 13.0, kFactor = 2.0;  // ASTM D638, type I
  const bool notched = row.record.test == tester::TestKind::toughness;
  const double width_mm = notched ? 1e3 * thesis::kSpecimenWidth.value : kBarWidthMm;
  const double thickness_mm = 1e3 * thesis::kSpecimenThickness.value;
  const auto far_off = [&](double value, double nominal) {
    return value > kFactor * nominal || value < nominal / kFactor;
  };
  if (!far_off(row.width_mm, width_mm) && !far_off(row.record.conditions.thickness_mm, thickness_mm)) return "";
  return fmt::format("{} x {} mm in the gauge, nominal {} x {} mm: are width_mm and thickness_mm right?", row.width_mm,
                     row.record.conditions.thickness_mm, width_mm, thickness_mm);
}

/// A doubt about whether the extension belongs to the gauge, without the specimen's name; or nothing. A bar's narrow
/// section holds any extensometer's gauge, the travel of its grips belongs to a longer one (ASTM D638, type I).
std::string doubt_of_gauge(const TesterRecord& from, const SheetRow& row) {
  constexpr double kNarrowSectionMm = 57.0;
  if (!from.column(Quantity::extension)) return "";
  const TakenColumn& taken = *from.column(Quantity::extension);
  std::vector<std::string> others = taken.not_taken;
  others.insert(others.end(), from.strains.begin(), from.strains.end());
  const std::string also = others.empty() ? "" : fmt::format(" (the file also has `{}`)", fmt::join(others, "`, `"));
  if (std::count(taken.not_taken.begin(), taken.not_taken.end(), taken.heading) > 0)
    return fmt::format("`{}` occurs twice in the file, the first was taken: expected names that differ", taken.heading);
  if (row.record.test == tester::TestKind::toughness) return "";
  const bool short_gauge = row.gauge_mm <= kNarrowSectionMm;
  const bool is_named = !row.columns.extension.empty();
  const bool of_grips = taken.gauge == Gauge::grips || (!is_named && !others.empty());
  if (short_gauge && taken.gauge != Gauge::extensometer && of_grips)
    return fmt::format(
        "gauge_mm {} is an extensometer's, but the extension is that of `{}`{}: expected extension_column with the "
        "name of its column, or the gauge of the grips' travel (104.9 for a bar of ASTM D638, type I)",
        row.gauge_mm, taken.heading, also);
  if (!short_gauge && taken.gauge == Gauge::extensometer)
    return fmt::format("gauge_mm {} is longer than a bar's narrow section, but the extension is that of `{}`{}",
                       row.gauge_mm, taken.heading, also);
  return "";
}

/// One warning for several specimens with the same doubt.
void collect_gauge_doubts(const std::map<std::string, std::vector<std::string>>& specimens_by_doubt,
                          std::vector<std::string>& warnings) {
  constexpr std::size_t kMostNamed = 5;
  for (const auto& [doubt, specimens] : specimens_by_doubt) {
    const std::size_t named = std::min(kMostNamed, specimens.size());
    warnings.push_back(
        fmt::format("{} {}{}: {}", specimens.size() == 1 ? "specimen" : "specimens",
                    fmt::join(std::span(specimens).first(named), ", "),
                    specimens.size() > named ? fmt::format(" and {} more", specimens.size() - named) : "", doubt));
  }
}

/// A doubt about how fast a specimen was pulled, or nothing.
std::string doubt_of_rate(const SpecimenRecord& record, const SheetRow& row) {
  constexpr double kSlowest = 1e-6, kFastest = 1.0;
  const double rate = record.conditions.strain_rate_per_s;
  if (rate < kSlowest || rate > kFastest)
    return fmt::format("strain rate {} 1/s: are the units of time and extension right?", rate);
  tester::TestConditions planned = record.conditions;
  planned.strain_rate_per_s = row.planned_rate_per_s.value_or(rate);
  if (same_conditions(record.conditions, planned)) return "";
  return fmt::format(
      "strain rate {} 1/s, planned {}: was the speed different, or does the gauge ({} mm) not belong "
      "to the recorded extension?",
      rate, planned.strain_rate_per_s, row.gauge_mm);
}

/// Adds the doubts that its reduction and its row raise.
void collect_doubts(const SheetRow& row, ImportedSpecimen& one) {
  const auto doubt = [&](bool is_of_scale, std::string text) {
    if (!text.empty()) one.doubts.push_back({is_of_scale, std::move(text)});
  };
  if (!one.test.separated && one.record.test == tester::TestKind::toughness)
    doubt(false, one.record.note + "; kept as not valid");
  constexpr double kStiff = 1.25, kFarOfNotched = 100.0;
  if (one.test.toe_kept != 0.0)
    doubt(false,
          fmt::format("its straight part meets zero stress at {:.2f} % strain; a toe beyond {} % is not compensated: "
                      "was the specimen slack in its grips, or preloaded?",
                      100.0 * one.test.toe_kept, 100.0 * kLargestToe));
  if (one.test.stiffening > kStiff)
    doubt(false, fmt::format("its peak stress is {:.1f} times the extrapolation of its straight part: does it "
                             "stiffen, or was it slack in its grips?",
                             one.test.stiffening));
  if (one.test.modulus_error_pa > kSureModulus * one.test.modulus_pa)
    doubt(false, fmt::format("initial modulus {:.3g} Pa has a standard error of {:.1f} %: is the force noisy, or the "
                             "curve bent?",
                             one.test.modulus_pa, 100.0 * one.test.modulus_error_pa / one.test.modulus_pa));
  doubt(true, doubt_of_size(row));
  if (one.test.failure_strain > kMostUsualStrain)
    doubt(true, fmt::format("failure strain {:.3g} is unusual: are extension and gauge ({} mm) right?",
                            one.test.failure_strain, row.gauge_mm));
  if (one.test.peak_stress_pa > kUsualPeakPa.most)
    doubt(true, fmt::format("peak stress {:.3g} Pa is unusual: are force and size right?", one.test.peak_stress_pa));
  doubt(true, doubt_of_rate(one.record, row));
  doubt(true, doubt_of_modulus(one.record, one.test.modulus_pa, kFarOfNotched));
  if (!kUsualModulusPa.hold(one.test.modulus_pa))
    doubt(true, fmt::format("initial modulus {:.3g} Pa is unusual: are the units of force and the size ({} x {} mm, "
                            "gauge {} mm) right?",
                            one.test.modulus_pa, row.width_mm, one.record.conditions.thickness_mm, row.gauge_mm));
}

/// Adds why the row's specimen cannot be used.
void reject(const SheetRow& row, ImportFault fault, Import& import) {
  fault.specimen = row.record.specimen;
  import.rejected.push_back(std::move(fault));
}

/// Adds the specimens of one piece, whose names must not be others' of the sheet.
void add_rows_of_piece(const SheetRow& row, tl::expected<std::vector<ImportedSpecimen>, ImportFault> rows,
                       const SpecimenSheet& sheet, const std::string& sheet_file, Import& import,
                       std::vector<SpecimenRecord>& records) {
  if (!rows) return reject(row, rows.error(), import);
  for (const ImportedSpecimen& one : *rows) {
    const auto has_name = [&](const SheetRow& other) { return other.record.specimen == one.record.specimen; };
    if (std::none_of(sheet.rows.begin(), sheet.rows.end(), has_name)) continue;
    const std::string reason =
        fmt::format("`{}` would be a row of the table {} and is a specimen of the sheet, expected another name",
                    one.record.specimen, row.record.specimen);
    return reject(row, {sheet_file, row.line, "specimen", reason}, import);
  }
  for (ImportedSpecimen& one : *rows) {
    records.push_back(one.record);
    import.specimens.push_back(std::move(one));
  }
}

}  // namespace

std::string doubt_of_twins(const SpecimenRecord& one, std::span<const SpecimenRecord> others) {
  if (one.curve.empty()) return "";
  const auto twin = std::find_if(others.begin(), others.end(), [&](const SpecimenRecord& other) {
    return other.specimen != one.specimen && other.curve == one.curve;
  });
  if (twin == others.end()) return "";
  return fmt::format("specimen {}: its readings equal those of {} to the last digit: is it one test under two names?",
                     one.specimen, twin->specimen);
}

namespace {

/// Adds the doubts that specimens raise beside each other.
void compare_specimens(const std::vector<SpecimenRecord>& records, Import& import) {
  for (const UnitDoubt& doubt : doubts_of_units(records)) {
    import.warnings.push_back(doubt.text);
    for (ImportedSpecimen& one : import.specimens)
      if (one.record.specimen == doubt.specimen) one.doubts.push_back({true, doubt.text});
  }
}

/// Adds the specimen of a row and the doubts about it; `others` come before it.
void add_specimen(const SheetRow& row, const TesterRecord& from, ImportedSpecimen one,
                  std::span<const SpecimenRecord> others, Import& import) {
  collect_doubts(row, one);
  for (const ImportDoubt& doubt : one.doubts)
    import.warnings.push_back(fmt::format("specimen {}: {}", row.record.specimen, doubt.text));
  if (std::string doubt = doubt_of_gauge(from, row); !doubt.empty()) one.doubts.push_back({true, std::move(doubt)});
  if (std::string doubt = doubt_of_twins(one.record, others); !doubt.empty()) {
    import.warnings.push_back(doubt);
    one.doubts.push_back({true, std::move(doubt)});
  }
  import.specimens.push_back(std::move(one));
}

}  // namespace

Import import_exports(const std::vector<fs::path>& files, const fs::path& sheet_file, const ImportSettings& settings) {
  SpecimenSheet sheet = read_specimen_sheet(sheet_file, settings.confined);
  Import import{.specimens = {}, .rejected = std::move(sheet.rejected), .warnings = std::move(sheet.warnings)};
  SheetExports exports(files, sheet_file.parent_path(), settings.confined);
  std::set<std::string> warned;
  std::vector<SpecimenRecord> records;
  std::map<std::string, std::vector<std::string>> gauge_doubts;  ///< specimens by doubt
  for (const SheetRow& row : sheet.rows) {
    auto record = exports.record_of(row, sheet_file.string());
    if (!record) {
      reject(row, record.error(), import);
      continue;
    }
    for (const std::string& warning : record->warnings) {
      if (warned.insert(warning).second) import.warnings.push_back(warning);
    }
    if (record->sweep || is_held(row, *record)) {
      const bool is_sweep = record->sweep && !record->sweep->is_relaxation();
      add_rows_of_piece(
          row, (is_sweep ? import_sweep : import_relaxation)(row, *record, sheet_file.string(), import.warnings), sheet,
          sheet_file.string(), import, records);
      continue;
    }
    auto imported = import_one(row, *record, row.file, settings);
    if (!imported) {
      reject(row, imported.error(), import);
      continue;
    }
    if (const std::string doubt = doubt_of_gauge(*record, row); !doubt.empty())
      gauge_doubts[doubt].push_back(row.record.specimen);
    add_specimen(row, *record, std::move(*imported), records, import);
    records.push_back(import.specimens.back().record);
  }
  collect_gauge_doubts(gauge_doubts, import.warnings);
  compare_specimens(records, import);
  for (const std::string& name : exports.unused())
    import.warnings.push_back(fmt::format("{}: no specimen of the sheet names this export; it is not used", name));
  return import;
}

}  // namespace nacre::measurement
