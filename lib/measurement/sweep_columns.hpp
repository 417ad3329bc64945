#pragma once
// The meaning of the columns of dynamic mechanical analysis, a frequency sweep or a relaxation: headings -> quantity
// and unit.

#include <optional>
#include <string>
#include <string_view>

#include "measurement/tester_columns.hpp"

namespace nacre::measurement {

/// `amplitude`: of the strain, or the strain that is held.
enum class SweepQuantity { frequency, storage_modulus, amplitude, temperature, time, relaxation_modulus, stress };
inline constexpr std::size_t kSweepQuantities = 7;
std::string_view to_string(SweepQuantity quantity);  ///< as they are named above

/// From a unit to rad/s, Pa, 1 (strain), mm (displacement), degrees Celsius or s: factor * value + offset.
struct SweepUnit {
  double factor = 1.0, offset = 0.0;
  double base(double value) const { return factor * value + offset; }
};

/// A heading of a sweep, taken apart.
struct SweepColumn {
  ColumnName name = {};  ///< heading as in the file, name in plain words, unit as written
  std::optional<SweepQuantity> quantity = {};
  int rank = 0;             ///< among columns of one quantity the smallest is preferred
  bool is_angular = false;  ///< a frequency that its name says to be in rad/s
  bool is_sample = false;   ///< tells which piece a row belongs to; a number of rows or runs does not
  bool is_length = false;   ///< an amplitude of the displacement: its unit is mm
  bool is_shear = false;    ///< says that the test is in shear, where no modulus is Young's
};

/// Recognises `Frequency (Hz)`, `f/Hz`, `Angular frequency [rad/s]`, `Storage modulus (MPa)`, `E'`, `Speichermodul`,
/// `Relaxation modulus (MPa)`, `E(t)`, `Step time (s)`, `Oscillation strain (%)`, `Temp./°C`. Loss and complex moduli,
/// tan delta, logarithms and static strains are none of the quantities. `unit`: of a row of its own; may be empty.
SweepColumn recognise_sweep_column(std::string_view heading, std::string_view unit = {});

/// The unit as a heading writes it; nothing where the column's quantity has no such unit. 1/s is rad/s of an angular
/// frequency, otherwise Hz.
std::optional<SweepUnit> unit_of_sweep(const SweepColumn& column, std::string_view unit);
/// Examples of units, for error messages.
std::string_view expected_units(SweepQuantity quantity);
/// Whether it is a unit of a sweep's table, in plain words: also one that no quantity here has.
bool is_unit_of_sweep(std::string_view unit);

}  // namespace nacre::measurement
