#include "measurement/import_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "base/counted.hpp"
#include "measurement/limits.hpp"
#include "measurement/piece_rows.hpp"
#include "measurement/provenance.hpp"
#include "measurement/rounded.hpp"

namespace nacre::measurement {
namespace {

constexpr int kSweepDigits = 6;  // significant

/// What speaks against taking the sheet's row for a sweep.
std::optional<ImportFault> fault_of_sweep(const SheetRow& row, const Sweep& sweep, const std::string& sheet) {
  const auto fault = [&](const char* column, const std::string& reason) {
    return ImportFault{
        sheet, row.line, column,
        fmt::format("`{}` holds a frequency sweep (storage modulus by frequency), {}", row.file, reason)};
  };
  const std::string other =
      "; a record of extension and force is read where the sheet names extension_column and "
      "force_column";
  if (row.record.test != tester::TestKind::modulus)
    return fault("test",
                 fmt::format("expected the test `modulus`, not `{}`{}", tester::to_string(row.record.test), other));
  if (!row.record.design.mixture())
    return fault("pattern", fmt::format("expected a homogeneous material (soft, interface, rigid, mix:F), not `{}`{}",
                                        row.record.design.name(), other));
  if (!sweep.has_amplitude() && !row.strain_amplitude)
    return fault("strain_amplitude",
                 fmt::format("expected the strain amplitude here (0.001 is 0.1 %), or a column such as `Oscillation "
                             "strain (%)` or a line such as `Amplitude: 0.1 %` in the file{}",
                             sweep.no_amplitude.empty() ? "" : "; " + sweep.no_amplitude));
  return std::nullopt;
}

/// Which columns and units the numbers came from.
std::map<std::string, std::string> provenance_of_sweep(const TesterRecord& from, const SheetRow& row) {
  std::map<std::string, std::string> cells = provenance_of_file(from, row);
  for (const SweepQuantity quantity :
       {SweepQuantity::frequency, SweepQuantity::storage_modulus, SweepQuantity::amplitude, SweepQuantity::temperature})
    add_provenance(to_string(quantity), from.sweep->column(quantity), cells);
  return cells;
}

/// The measured modulus at one frequency; `common` is the same of all.
ImportedSpecimen specimen_at(const SweepPoint& point, double amplitude, ImportedSpecimen common) {
  SpecimenRecord& record = common.record;
  record.modulus_pa = common.test.modulus_pa = rounded(point.modulus_pa, kSweepDigits);
  record.conditions.strain_rate_per_s = rounded(point.angular_frequency_per_s * amplitude, kSweepDigits);
  if (point.temperature_c)
    record.other_columns["temperature_c"] = fmt::format("{}", rounded(*point.temperature_c, kSweepDigits));
  const double frequency_hz = point.angular_frequency_per_s / (2.0 * std::numbers::pi);
  record.note +=
      fmt::format("{}E' at {:.4g} Hz, amplitude {:.4g}", record.note.empty() ? "" : "; ", frequency_hz, amplitude);
  common.provenance["first_line"] = common.provenance["last_line"] = fmt::format("{}", point.line);
  return common;
}

/// What is the same at every frequency.
ImportedSpecimen common_of(const SheetRow& row, const TesterRecord& from) {
  ImportedSpecimen common = common_of_piece(row, from);
  const bool is_recorded = from.sweep->has_amplitude();
  common.rate_source = is_recorded ? "record" : "sheet";
  common.provenance = provenance_of_sweep(from, row);
  common.decisions.push_back(
      is_recorded
          ? fmt::format("strain rate: angular frequency times the amplitude of the {}",
                        from.sweep->has_header_amplitude ? "header" : "table")
          : fmt::format("strain rate: angular frequency times the amplitude {} of the sheet", *row.strain_amplitude));
  return common;
}

/// Doubts about a whole sweep.
std::vector<ImportDoubt> doubts_of_sweep(const SheetRow& row, const Sweep& sweep, std::size_t left_out) {
  std::vector<ImportDoubt> doubts;
  if (left_out > 0)
    doubts.push_back(
        {true, fmt::format("{} left out, without an amplitude or with a strain rate not within {} to {} 1/s: are the "
                           "units of frequency and amplitude right?",
                           counted(static_cast<int>(left_out), "row"), kStrainRatePerS.least, kStrainRatePerS.most)});
  if (row.rate_is_given)
    doubts.push_back({false, "strain_rate_per_s of the sheet is not used: a sweep has a rate for each frequency"});
  if (row.strain_amplitude && sweep.has_amplitude()) {
    const auto& column = sweep.column(SweepQuantity::amplitude);
    doubts.push_back({false, fmt::format("strain_amplitude of the sheet is not used: the file has {}",
                                         column ? fmt::format("`{}`", column->heading) : "one in its header")});
  }
  const auto [least, most] =
      std::minmax_element(sweep.points.begin(), sweep.points.end(),
                          [](const auto& a, const auto& b) { return a.modulus_pa < b.modulus_pa; });
  if (!kUsualModulusPa.hold(least->modulus_pa) || !kUsualModulusPa.hold(most->modulus_pa))
    doubts.push_back({true, fmt::format("storage moduli from {:.3g} to {:.3g} Pa are unusual: is the unit right?",
                                        least->modulus_pa, most->modulus_pa)});
  return doubts;
}

}  // namespace

tl::expected<std::vector<ImportedSpecimen>, ImportFault> import_sweep(const SheetRow& row, const TesterRecord& from,
                                                                      const std::string& sheet,
                                                                      std::vector<std::string>& warnings) {
  if (const auto fault = fault_of_sweep(row, *from.sweep, sheet)) return tl::unexpected(*fault);
  const ImportedSpecimen common = common_of(row, from);
  std::vector<ImportedSpecimen> specimens;
  for (const SweepPoint& point : from.sweep->points) {
    const auto amplitude = point.amplitude ? point.amplitude : row.strain_amplitude;
    if (amplitude && kStrainRatePerS.hold(point.angular_frequency_per_s * *amplitude))
      specimens.push_back(specimen_at(point, *amplitude, common));
  }
  if (specimens.empty())
    return tl::unexpected(
        ImportFault{row.file, from.line.front(), "",
                    fmt::format("no row has a strain rate within {} to {} 1/s, the angular frequency times the "
                                "amplitude: expected other units of frequency or amplitude",
                                kStrainRatePerS.least, kStrainRatePerS.most)});
  const std::size_t left_out = from.sweep->points.size() - specimens.size();
  return rows_of_piece(row, std::move(specimens), doubts_of_sweep(row, *from.sweep, left_out), sheet, warnings);
}

}  // namespace nacre::measurement
