#pragma once
// Third stage of reading a frequency sweep or a relaxation: tables -> modulus by frequency or by time of one piece, and
// which columns were taken.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "measurement/column_choice.hpp"
#include "measurement/import_fault.hpp"
#include "measurement/sweep_columns.hpp"
#include "measurement/tester_blocks.hpp"
#include "measurement/tester_series.hpp"

namespace nacre::measurement {

/// One line of the table.
struct SweepPoint {
  int line = 0;                          ///< of the file, from 1
  std::string sample;                    ///< as a column of the table names it; empty where there is none
  double angular_frequency_per_s = 0.0;  ///< of a sweep
  double time_s = 0.0;                   ///< of a relaxation
  double modulus_pa = 0.0;               ///< E', relaxation modulus, or the stress of a relaxation without one
  std::optional<double> amplitude;       ///< of the strain, or held; nothing where neither table nor header tells it
  std::optional<double> temperature_c;   ///< nothing where the table tells none
};

struct Sweep {
  std::vector<SweepPoint> points;                                       ///< at least one
  std::array<std::optional<TakenColumn>, kSweepQuantities> taken = {};  ///< of the first table
  std::string no_amplitude;            ///< why an amplitude was not taken; empty where there is none
  bool has_header_amplitude = false;   ///< the amplitude of all points is that of the header
  std::vector<std::string> decisions;  ///< columns, units, rows left out, as sentences
  std::vector<std::string> warnings;
  char decimal_mark = '.';
  bool has_amplitude() const { return has_header_amplitude || column(SweepQuantity::amplitude).has_value(); }
  const std::optional<TakenColumn>& column(SweepQuantity quantity) const {
    return taken[static_cast<std::size_t>(quantity)];
  }
  bool is_relaxation() const { return column(SweepQuantity::time).has_value(); }
};

/// Reads the tables of sweep_tables_of() one after the other; `lines` are the file's. A table without a column of
/// frequency or amplitude has those of the lines above it, and an amplitude of the displacement becomes one of the
/// strain by the sample's length there. Of several columns of a quantity the first with a unit and the most usual name
/// is taken. Rows without positive numbers are left out; of a sweep also those without an amplitude. The fault names
/// line and column: no unit, a test in shear, torn rows, decimal points and commas, no row left.
tl::expected<Sweep, ImportFault> sweep_of(const ExportTables& tables, const std::vector<std::string_view>& lines,
                                          const ColumnChoice& choice, const std::string& file);

}  // namespace nacre::measurement
