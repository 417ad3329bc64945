#include "measurement/import_relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/counted.hpp"
#include "measurement/held_strain.hpp"
#include "measurement/limits.hpp"
#include "measurement/nominal_curve.hpp"
#include "measurement/piece_rows.hpp"
#include "measurement/provenance.hpp"
#include "measurement/rounded.hpp"

namespace nacre::measurement {
namespace {

constexpr int kHoldDigits = 6;  // significant

/// One strain that is held at one temperature.
struct HeldCurve {
  double strain = 0.0, ramp_s = 0.0;
  std::optional<double> temperature_c;
  std::vector<RelaxationReading> readings;  ///< all that are used
};

std::optional<ImportFault> fault_of_relaxation(const SheetRow& row, const std::string& sheet) {
  const auto fault = [&](const char* column, const std::string& reason) {
    return ImportFault{sheet, row.line, column, fmt::format("`{}` holds a stress relaxation, {}", row.file, reason)};
  };
  if (row.record.test != tester::TestKind::modulus)
    return fault("test", fmt::format("expected the test `modulus`, not `{}`", tester::to_string(row.record.test)));
  if (!row.record.design.mixture())
    return fault("pattern", fmt::format("expected a homogeneous material (soft, interface, rigid, mix:F), not `{}`",
                                        row.record.design.name()));
  return std::nullopt;
}

/// Adds a reading where it is late enough after the ramp.
void add_reading(HeldCurve& held, int line, double time_s, double modulus_pa) {
  if (!(time_s > 1.5 * held.ramp_s) || !(modulus_pa > 0.0) || !kStrainRatePerS.hold(rate_of_hold(time_s))) return;
  if (!held.readings.empty() && time_s <= held.readings.back().time_s) return;
  held.readings.push_back({line, time_s, modulus_pa});
}

/// Where the table's clock goes back or the temperature changes another strain is held.
std::vector<std::vector<SweepPoint>> runs_of(const std::vector<SweepPoint>& points) {
  constexpr double kSameC = 2.0;
  std::vector<std::vector<SweepPoint>> runs;
  for (const SweepPoint& point : points) {
    const auto other = [&](const SweepPoint& last) {
      return point.time_s <= last.time_s ||
             std::abs(point.temperature_c.value_or(0.0) - runs.back().front().temperature_c.value_or(0.0)) > kSameC;
    };
    if (runs.empty() || other(runs.back().back())) runs.emplace_back();
    runs.back().push_back(point);
  }
  return runs;
}

/// The held strain of one run; `origin_s` of its clock. Nothing where its strain never stands still.
std::optional<HeldCurve> held_in_run(const std::vector<SweepPoint>& run, double origin_s, const SheetRow& row,
                                     bool is_stress) {
  std::vector<double> times, strains;
  for (const SweepPoint& point : run) {
    times.push_back(point.time_s - origin_s);
    strains.push_back(point.amplitude.value_or(row.strain_amplitude.value_or(1.0)));
  }
  HeldStretch stretch{.first = 0, .end = run.size(), .strain = strains.front()};
  const auto [least, most] = std::ranges::minmax(strains);
  constexpr double kStill = 0.02;
  if (most - least > kStill * most) {
    const auto found = held_stretch(times, strains);
    if (!found) return std::nullopt;
    stretch = *found;
  }
  HeldCurve held{.strain = stretch.strain, .ramp_s = stretch.ramp_s, .temperature_c = run.front().temperature_c};
  for (std::size_t i = stretch.first; i < stretch.end; ++i)
    add_reading(held, run[i].line, times[i] - stretch.begin_s, run[i].modulus_pa / (is_stress ? strains[i] : 1.0));
  return held;
}

std::vector<HeldCurve> held_in_table(const Sweep& table, const SheetRow& row) {
  const bool is_stress = table.column(SweepQuantity::stress).has_value();
  std::vector<HeldCurve> all;
  double last_s = 0.0;
  for (const auto& run : runs_of(table.points)) {
    const double origin_s = run.front().time_s > last_s ? last_s : 0.0;
    if (auto held = held_in_run(run, origin_s, row, is_stress); held && !held->readings.empty())
      all.push_back(std::move(*held));
    last_s = run.back().time_s;
  }
  return all;
}

std::optional<HeldStretch> stretch_of(const SheetRow& row, const TesterRecord& from, const tester::Curve& curve) {
  auto held = held_stretch(from.time_s, curve.strain);
  if (held && is_relaxation(*held, from.time_s)) return held;
  const auto [least, most] = std::ranges::minmax(curve.strain);
  if (row.strain_amplitude && most - least < 0.02 * *row.strain_amplitude)
    return HeldStretch{.first = 0, .end = curve.size(), .strain = *row.strain_amplitude};
  return std::nullopt;
}

std::vector<HeldCurve> held_in_record(const SheetRow& row, const TesterRecord& from) {
  const tester::Curve curve = nominal_curve(from, row, {});
  const HeldStretch stretch = *stretch_of(row, from, curve);
  HeldCurve held{.strain = stretch.strain, .ramp_s = stretch.ramp_s, .temperature_c = {}};
  for (std::size_t i = stretch.first; i < stretch.end; ++i)
    add_reading(held, from.line[i], from.time_s[i] - stretch.begin_s,
                curve.stress_pa[i] / (stretch.is_whole() ? stretch.strain : curve.strain[i]));
  return {held};
}

/// A column of a record without a unit that is read.
std::optional<ImportFault> fault_of_units(const SheetRow& row, const TesterRecord& from) {
  for (const Quantity quantity :
       {Quantity::time, Quantity::extension, Quantity::force, Quantity::strain, Quantity::stress})
    if (lacks_unit(from, quantity))
      return ImportFault{row.file, from.line.front(), from.column(quantity)->heading,
                         fmt::format("has no unit that is read, expected one of {} in the heading, or in the column "
                                     "`unit` of the sheet",
                                     expected_units(quantity))};
  return std::nullopt;
}

std::map<std::string, std::string> provenance_of_relaxation(const TesterRecord& from, const SheetRow& row) {
  std::map<std::string, std::string> cells = provenance_of_file(from, row);
  if (!from.sweep) {
    for (const Quantity quantity :
         {Quantity::time, Quantity::extension, Quantity::force, Quantity::strain, Quantity::stress})
      add_provenance(to_string(quantity), from.column(quantity), cells);
    return cells;
  }
  for (const SweepQuantity quantity : {SweepQuantity::time, SweepQuantity::relaxation_modulus, SweepQuantity::stress,
                                       SweepQuantity::amplitude, SweepQuantity::temperature})
    add_provenance(to_string(quantity), from.sweep->column(quantity), cells);
  return cells;
}

/// What is the same at every time.
ImportedSpecimen common_of_relaxation(const SheetRow& row, const TesterRecord& from) {
  ImportedSpecimen common = common_of_piece(row, from);
  common.rate_source = "record";
  common.provenance = provenance_of_relaxation(from, row);
  return common;
}

ImportedSpecimen held_specimen(const RelaxationReading& reading, const HeldCurve& held, bool strain_is_known,
                               ImportedSpecimen common) {
  SpecimenRecord& record = common.record;
  const double time_s = rounded(reading.time_s, kHoldDigits);
  record.modulus_pa = common.test.modulus_pa = rounded(reading.modulus_pa, kHoldDigits);
  record.conditions.strain_rate_per_s = rounded(rate_of_hold(time_s), kHoldDigits);
  record.other_columns[std::string(kHoldColumn)] = fmt::format("{}", time_s);
  if (held.temperature_c)
    record.other_columns["temperature_c"] = fmt::format("{}", rounded(*held.temperature_c, kHoldDigits));
  record.note += fmt::format("{}E at {:.4g} s{}", record.note.empty() ? "" : "; ", time_s,
                             strain_is_known ? fmt::format(" of held strain {:.4g}", held.strain) : " of held strain");
  common.provenance["first_line"] = common.provenance["last_line"] = fmt::format("{}", reading.line);
  return common;
}

std::vector<ImportDoubt> doubts_of_relaxation(const SheetRow& row, const std::vector<HeldCurve>& all,
                                              bool strain_is_known) {
  constexpr double kLinear = 0.05, kGrown = 1.05;
  std::vector<ImportDoubt> doubts;
  const auto doubt = [&](bool is_of_scale, std::string text) { doubts.push_back({is_of_scale, std::move(text)}); };
  if (row.rate_is_given)
    doubt(false, "strain_rate_per_s of the sheet is not used: a held strain has the rate of a pull that is as stiff");
  for (const HeldCurve& held : all) {
    if (strain_is_known && held.strain > kLinear)
      doubt(false,
            fmt::format("its strain, {:.3g}, is beyond {}: stress over strain is a secant, no small-strain modulus",
                        held.strain, kLinear));
    const double first = held.readings.front().modulus_pa, last = held.readings.back().modulus_pa;
    if (last > kGrown * first)
      doubt(false, fmt::format("its stress grows by {:.0f} % while strain is held: does it cure, dry, or cool?",
                               100.0 * (last / first - 1.0)));
    if (!kUsualModulusPa.hold(first) || !kUsualModulusPa.hold(last))
      doubt(true,
            fmt::format("relaxation moduli from {:.3g} to {:.3g} Pa are unusual: is the unit right?", first, last));
  }
  return doubts;
}

std::string said_of(const HeldCurve& held, std::size_t used, bool strain_is_known) {
  return fmt::format(
      "stress relaxation{}{}: {} of {} times taken, counted from the middle of the ramp, from {:.3g} s on",
      strain_is_known ? fmt::format(" at strain {:.4g}", held.strain) : "",
      held.ramp_s > 0.0 ? fmt::format(" after a ramp of {:.3g} s", held.ramp_s) : "", used, held.readings.size(),
      held.readings.front().time_s);
}

}  // namespace

bool is_held(const SheetRow& row, const TesterRecord& from) {
  if (from.sweep || fault_of_relaxation(row, "") || from.time_s.empty() || from.line.empty()) return false;
  return stretch_of(row, from, nominal_curve(from, row, {})).has_value();
}

tl::expected<std::vector<ImportedSpecimen>, ImportFault> import_relaxation(const SheetRow& row,
                                                                           const TesterRecord& from,
                                                                           const std::string& sheet,
                                                                           std::vector<std::string>& warnings) {
  if (const auto fault = fault_of_relaxation(row, sheet)) return tl::unexpected(*fault);
  const bool of_stress = from.sweep && from.sweep->column(SweepQuantity::stress);
  const bool strain_is_known = !from.sweep || row.strain_amplitude || from.sweep->column(SweepQuantity::amplitude);
  if (of_stress && !strain_is_known)
    return tl::unexpected(ImportFault{sheet, row.line, "strain_amplitude",
                                      fmt::format("`{}` holds stress by time, expected the strain that was held here "
                                                  "(0.01 is 1 %), or a column of strain in the file",
                                                  row.file)});
  if (!from.sweep)
    if (const auto fault = fault_of_units(row, from)) return tl::unexpected(*fault);
  const std::vector<HeldCurve> all = from.sweep ? held_in_table(*from.sweep, row) : held_in_record(row, from);
  ImportedSpecimen common = common_of_relaxation(row, from);
  std::vector<std::pair<const HeldCurve*, RelaxationReading>> taken;
  for (const HeldCurve& held : all) {
    const auto few = thinned(held.readings);
    for (const RelaxationReading& reading : few) taken.emplace_back(&held, reading);
    if (!few.empty()) common.decisions.push_back(said_of(held, few.size(), strain_is_known));
  }
  if (taken.empty())
    return tl::unexpected(
        ImportFault{row.file, from.line.front(), "",
                    "no row lies after the ramp's end by the ramp's own duration, with a stress and a "
                    "time above 0, expected a strain that is held"});
  std::vector<ImportedSpecimen> specimens;
  for (const auto& [held, reading] : taken) specimens.push_back(held_specimen(reading, *held, strain_is_known, common));
  return rows_of_piece(row, std::move(specimens), doubts_of_relaxation(row, all, strain_is_known), sheet, warnings);
}

}  // namespace nacre::measurement
