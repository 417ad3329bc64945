#include "measurement/sweep_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "base/counted.hpp"
#include "measurement/decimal_marks.hpp"
#include "measurement/set_files.hpp"
#include "measurement/sweep_header.hpp"
#include "measurement/tester_delimiter.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

/// Adds the points of one table to a sweep.
class SweepReader {
 public:
  SweepReader(const TableBlock& block, SweepHeader header, char delimiter, const ColumnChoice& choice,
              const std::string& file, Sweep& sweep)
      : block_(block),
        header_(std::move(header)),
        delimiter_(delimiter),
        choice_(choice),
        file_(file),
        sweep_(sweep),
        rows_(block.rows()) {
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    for (const ColumnName& name : block.columns) columns_.push_back(recognise_sweep_column(name.heading, name.unit));
  }

  std::optional<ImportFault> read() {
    check_shape();
    choose_axes();
    for (const SweepQuantity quantity : {axis_, modulus_, SweepQuantity::amplitude, SweepQuantity::temperature})
      take(quantity);
    take_header();
    refuse_shear();
    find_marks();
    if (!fault_) read_points();
    return fault_;
  }

 private:
  struct Taken {
    std::size_t place = 0;
    SweepUnit unit;
  };

  void reject(std::size_t line, std::string column, std::string reason) {
    if (!fault_) fault_ = ImportFault{file_, static_cast<int>(line), std::move(column), std::move(reason)};
  }

  /// Tables of one file decide alike: once is enough.
  void say(std::string decision) {
    std::vector<std::string>& said = sweep_.decisions;
    if (std::find(said.begin(), said.end(), decision) == said.end()) said.push_back(std::move(decision));
  }

  std::optional<Taken>& taken(SweepQuantity quantity) { return taken_[static_cast<std::size_t>(quantity)]; }

  /// A row that was torn at its decimal commas has more cells than the heading; between blanks an empty cell is lost.
  void check_shape() {
    const bool between_blanks = delimiter_ == kGaps || delimiter_ == kBlanks;
    for (const std::size_t row : rows_) {
      const std::size_t cells = block_.cells_in(row), expected = block_.columns.size();
      bool is_torn = between_blanks && cells != expected;
      for (std::size_t i = expected; i < cells; ++i) is_torn = is_torn || is_measured(block_.cell(row, i));
      if (!is_torn) continue;
      return reject(block_.lines[row] + 1, "",
                    fmt::format("has {} cells, expected {} as in the heading: decimal commas in a comma-separated "
                                "file, or an empty cell between blanks?",
                                cells, expected));
    }
  }

  bool has(SweepQuantity quantity) const {
    return std::ranges::any_of(columns_, [&](const SweepColumn& each) { return each.quantity == quantity; });
  }

  /// A table of both is one of frequencies.
  void choose_axes() {
    const bool tells_frequency = has(SweepQuantity::frequency) || header_.angular_frequency_per_s;
    if (tells_frequency && has(SweepQuantity::storage_modulus)) return;
    axis_ = SweepQuantity::time;
    modulus_ = has(SweepQuantity::relaxation_modulus) ? SweepQuantity::relaxation_modulus : SweepQuantity::stress;
  }

  std::vector<std::size_t> places_of(SweepQuantity quantity) const {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].quantity == quantity) places.push_back(i);
    }
    std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      const auto order = [&](std::size_t i) {
        return std::tuple(!unit_of_sweep(columns_[i], columns_[i].name.unit).has_value(), columns_[i].rank);
      };
      return order(a) < order(b);
    });
    return places;
  }

  /// The unit of the heading, else that of the sheet, else rad/s of an angular frequency.
  std::optional<SweepUnit> find_unit(const SweepColumn& column, TakenColumn& shown) {
    shown.unit = unit_as_written(column.name.unit);
    if (const auto unit = unit_of_sweep(column, column.name.unit)) return unit;
    const std::string quantity = std::string(to_string(*column.quantity)), heading = column.name.heading;
    for (const std::string& named : units_of_sheet(choice_)) {
      const auto unit = unit_of_sweep(column, named);
      if (!unit) continue;
      shown.unit = named;
      shown.unit_of_sheet = true;
      say(fmt::format("{}: `{}` in {}, as the sheet says", quantity, heading, named));
      return unit;
    }
    if (!column.is_angular || !column.name.unit.empty() || column.quantity != SweepQuantity::frequency)
      return std::nullopt;
    shown.unit = "rad/s";
    say(fmt::format("{}: `{}` in rad/s, as its name says", quantity, heading));
    return SweepUnit{};
  }

  static std::string unit_fault(const SweepColumn& column) {
    const std::string problem = column.name.unit.empty()
                                    ? std::string("has no unit that is read")
                                    : fmt::format("`{}` is no unit of it", unit_as_written(column.name.unit));
    return fmt::format("{}: {}, expected one of {} in the heading, or in the column `unit` of the sheet",
                       to_string(*column.quantity), problem, expected_units(*column.quantity));
  }

  void take(SweepQuantity quantity) {
    const std::vector<std::size_t> places = places_of(quantity);
    if (places.empty()) return;
    const SweepColumn& column = columns_[places.front()];
    TakenColumn shown{.heading = column.name.heading};
    for (auto other = places.begin() + 1; other != places.end(); ++other)
      shown.not_taken.push_back(columns_[*other].name.heading);
    const auto unit = find_unit(column, shown);
    if (!unit && quantity == SweepQuantity::amplitude) {
      sweep_.no_amplitude = fmt::format("`{}`: {}", column.name.heading, unit_fault(column));
      return;
    }
    if (!unit) return reject(block_.unit_line + 1, column.name.heading, unit_fault(column));
    if (column.is_length && !header_.length_mm) {
      sweep_.no_amplitude = fmt::format("`{}` in line {} {}", column.name.heading, block_.heading + 1, kNoLength);
      return;
    }
    if (column.is_length) say_length(fmt::format("`{}`", column.name.heading));
    if (!shown.not_taken.empty())
      say(fmt::format("{}: `{}` taken, not `{}`", to_string(quantity), shown.heading,
                      fmt::join(shown.not_taken, "`, `")));
    shown.factor = unit->factor;
    taken(quantity) = Taken{places.front(), *unit};
    auto& first = sweep_.taken[static_cast<std::size_t>(quantity)];
    if (!first) first = std::move(shown);
  }

  static constexpr std::string_view kNoLength =
      "is a length: expected the sample's length in the lines above the table too, such as `Sample length: 17.5 mm`";

  void say_length(const std::string& amplitude) {
    say(fmt::format("amplitude: {} over the sample's length, {} in line {} of the header", amplitude,
                    header_.length_mm->text, header_.length_mm->line));
  }

  /// What has no column is the header's, the same in all rows.
  void take_header() {
    if (axis_ != SweepQuantity::frequency) return;
    if (const auto& frequency = header_.angular_frequency_per_s; frequency && !taken(SweepQuantity::frequency))
      say(fmt::format("frequency: {} in line {} of the header", frequency->text, frequency->line));
    if (taken(SweepQuantity::amplitude)) return;
    if (header_.amplitude) {
      say(fmt::format("amplitude: {} in line {} of the header", header_.amplitude->text, header_.amplitude->line));
      header_amplitude_ = header_.amplitude->value;
    } else if (header_.amplitude_mm && header_.length_mm) {
      say_length(fmt::format("{} in line {}", header_.amplitude_mm->text, header_.amplitude_mm->line));
      header_amplitude_ = header_.amplitude_mm->value / header_.length_mm->value;
    } else if (header_.amplitude_mm) {
      sweep_.no_amplitude = fmt::format("the amplitude {} in line {} {}", header_.amplitude_mm->text,
                                        header_.amplitude_mm->line, kNoLength);
    }
    sweep_.has_header_amplitude = sweep_.has_header_amplitude || header_amplitude_.has_value();
  }

  std::optional<double> amplitude_of(std::size_t row) {
    const auto& column = taken(SweepQuantity::amplitude);
    if (!column) return header_amplitude_;
    const auto own = value(row, SweepQuantity::amplitude);
    return own && columns_[column->place].is_length ? std::optional(*own / header_.length_mm->value) : own;
  }

  std::optional<double> frequency_of(std::size_t row) {
    if (taken(SweepQuantity::frequency)) return value(row, SweepQuantity::frequency);
    if (!header_.angular_frequency_per_s) return std::nullopt;
    return header_.angular_frequency_per_s->value;
  }

  /// A modulus that is not named E' may be one in shear, a third of it.
  void refuse_shear() {
    const auto& modulus = taken(modulus_);
    if (!modulus) return;
    const auto sheared = std::find_if(columns_.begin(), columns_.end(), [](const auto& each) { return each.is_shear; });
    const bool is_symbol = columns_[modulus->place].rank == 0;
    if (sheared == columns_.end() || is_symbol) return;
    reject(block_.heading + 1, sheared->name.heading,
           "says that the test is in shear, where no modulus is Young's, expected E' (tension, compression, bending)");
  }

  void find_marks() {
    std::vector<std::size_t> places;
    for (const auto& each : taken_) {
      if (each) places.push_back(each->place);
    }
    marks_ = decimal_marks(block_, places, rows_, delimiter_);
    if (!marks_.contradictory.empty()) return reject(marks_.contradiction, "", fault_of_marks(marks_));
    if (marks_.is_assumed) sweep_.warnings.push_back(doubt_of_marks(marks_, file_));
    sweep_.decimal_mark = marks_.usual == DecimalMark::comma ? ',' : '.';
  }

  std::optional<double> value(std::size_t row, SweepQuantity quantity) {
    const auto& column = taken(quantity);
    if (!column) return std::nullopt;
    const auto number = instrument_number(block_.cell(row, column->place), marks_.of(column->place));
    return number ? std::optional(column->unit.base(*number)) : std::nullopt;
  }

  std::string sample_of(std::size_t row) const {
    const auto named = std::find_if(columns_.begin(), columns_.end(), [](const auto& each) { return each.is_sample; });
    const auto place = static_cast<std::size_t>(named - columns_.begin());
    return named == columns_.end() ? "" : std::string(block_.cell(row, place));
  }

  void read_points() {
    std::vector<int> left_out;
    for (const std::size_t row : rows_) {
      const int line = static_cast<int>(block_.lines[row]) + 1;
      const bool is_sweep = axis_ == SweepQuantity::frequency;
      const auto at = is_sweep ? frequency_of(row) : value(row, axis_), modulus = value(row, modulus_),
                 amplitude = amplitude_of(row);
      const bool lacks_amplitude = is_sweep && taken(SweepQuantity::amplitude) && amplitude.value_or(0.0) <= 0.0;
      if (at.value_or(0.0) <= 0.0 || modulus.value_or(0.0) <= 0.0 || lacks_amplitude) {
        left_out.push_back(line);
        continue;
      }
      sweep_.points.push_back({.line = line,
                               .sample = sample_of(row),
                               .angular_frequency_per_s = is_sweep ? *at : 0.0,
                               .time_s = is_sweep ? 0.0 : *at,
                               .modulus_pa = *modulus,
                               .amplitude = amplitude,
                               .temperature_c = value(row, SweepQuantity::temperature)});
    }
    if (!left_out.empty())
      say(fmt::format("{} left out, the first in line {}: {} are expected as numbers above 0",
                      counted(static_cast<int>(left_out.size()), "row"), left_out.front(),
                      axis_ == SweepQuantity::frequency ? "frequency, storage modulus and amplitude"
                                                        : "time and modulus or stress"));
  }

  const TableBlock& block_;
  SweepHeader header_;
  std::optional<double> header_amplitude_;
  char delimiter_;
  const ColumnChoice& choice_;
  const std::string& file_;
  Sweep& sweep_;
  std::vector<std::size_t> rows_;
  std::vector<SweepColumn> columns_;
  std::array<std::optional<Taken>, kSweepQuantities> taken_ = {};
  SweepQuantity axis_ = SweepQuantity::frequency, modulus_ = SweepQuantity::storage_modulus;
  DecimalMarks marks_;
  std::optional<ImportFault> fault_;
};

}  // namespace

tl::expected<Sweep, ImportFault> sweep_of(const ExportTables& tables, const std::vector<std::string_view>& lines,
                                          const ColumnChoice& choice, const std::string& file) {
  Sweep sweep;
  std::vector<std::size_t> headings;
  SweepHeader first_header;
  std::size_t above = 0;
  for (const TableBlock& block : tables.blocks) {
    const auto own = std::span(lines).subspan(above, block.heading - above);
    const SweepHeader header =
        with_missing_of(sweep_header_of(own, static_cast<int>(above) + 1, tables.delimiter), first_header);
    if (above == 0) first_header = header;
    above = block.lines.empty() ? block.heading + 1 : block.lines.back() + 1;
    if (auto fault = SweepReader(block, header, tables.delimiter, choice, file, sweep).read())
      return tl::unexpected(*fault);
    headings.push_back(block.heading + 1);
    if (block.statistics > 0)
      sweep.decisions.push_back(
          fmt::format("{} of means and deviations left out", counted(static_cast<int>(block.statistics), "row")));
  }
  const int first = headings.empty() ? 0 : static_cast<int>(headings.front());
  if (sweep.points.empty())
    return tl::unexpected(ImportFault{file, first, "",
                                      "no row below the heading has a frequency or time and a modulus "
                                      "above 0, expected at least one"});
  if (sweep.points.size() > kMostTableRows)
    return tl::unexpected(
        ImportFault{file, first, "", fmt::format("{} rows, expected at most {}", sweep.points.size(), kMostTableRows)});
  if (headings.size() > 1)
    sweep.decisions.push_back(fmt::format("{} tables are read as one, with headings in lines {}", headings.size(),
                                          fmt::join(headings, ", ")));
  return sweep;
}

}  // namespace nacre::measurement
