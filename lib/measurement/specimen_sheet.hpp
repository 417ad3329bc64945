#pragma once
// The sheet that assigns the files of the testing machine to specimens and holds their sizes.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/specimen_record.hpp"
#include "measurement/tester_export.hpp"

namespace nacre::measurement {

/// Heading of the sheet that a print job begins. The job fills the columns up to `tray`; the operator fills
/// the others and replaces the nominal sizes by the measured ones.
inline constexpr std::string_view kJobHeading =
    "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm,orientation_deg,planned_strain_rate_per_s,loading,batch,"
    "print_order,order_id,tray,date,operator,machine,path,note";

/// One row: everything about a specimen except the machine's record.
struct SheetRow {
  int line = 0;
  std::string file;
  std::string part;  ///< which test of the file: its name, or its number from 1; empty: the file holds one
  SpecimenRecord record;
  double width_mm = 0.0;
  double gauge_mm = 0.0;
  bool rate_is_given = false;                ///< by the operator: it wins over the recorded time
  std::optional<double> planned_rate_per_s;  ///< used where the recorded time gives no rate
  std::optional<double> strain_amplitude;    ///< of a sweep whose table has no column of it
  ColumnChoice columns;
};

struct SpecimenSheet {
  std::vector<SheetRow> rows;
  std::vector<ImportFault> rejected;
  std::vector<std::string> warnings;
};

/// Reads a sheet: CSV as people's spreadsheets write it (comma, semicolon or tab, decimal point or comma, UTF-8, UTF-16
/// or Windows-1252). Bad rows are listed, the others kept. Throws InputError when the file cannot be read, a required
/// column is missing or there is no row. `confined`: layouts are read from the sheet's own folder alone.
SpecimenSheet read_specimen_sheet(const std::filesystem::path& file, bool confined = false);

}  // namespace nacre::measurement
