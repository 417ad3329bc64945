#pragma once
// Raw exports of a testing machine and a sheet of specimens -> measured specimens.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "measurement/reduction.hpp"
#include "measurement/specimen_record.hpp"
#include "measurement/tester_export.hpp"

namespace nacre::measurement {

/// What a person should look at in a specimen.
struct ImportDoubt {
  bool is_of_scale = false;  ///< a unit, a size or a gauge may be mistaken: to be settled before the specimen counts
  std::string text;          ///< a sentence
};

/// One specimen that could be used.
struct ImportedSpecimen {
  SpecimenRecord record;
  std::string file;
  int line = 0;  ///< of the sheet
  std::string maker;
  std::string extension_column;  ///< its heading; empty where there is none
  double gauge_mm = 0.0;         ///< assumed for the extension
  std::vector<ImportDoubt> doubts = {};
  std::vector<std::string> decisions = {};             ///< columns taken and not, units, rows left out: sentences
  std::string rate_source = {};                        ///< `sheet`, `record`, `planned`, `default`
  std::map<std::string, std::string> provenance = {};  ///< cells of provenance.csv by column
  ReducedTest test = {};
};

struct Import {
  std::vector<ImportedSpecimen> specimens;  ///< in the order of the sheet
  std::vector<ImportFault> rejected;        ///< one per specimen or file that could not be used
  std::vector<std::string> warnings;
  int known = 0;     ///< how many of the specimens the set held before (write_import)
  int replaced = 0;  ///< how many it held with another test, which this one replaces
};

struct ImportSettings {
  Toe toe = Toe::compensate;
  bool confined = false;  ///< a name in the sheet that leads out of the sheet's folder is a fault
};

/// Reads `sheet` (docs/FORMATS.md, "Specimen sheets") and the exports that it names: among `files` by path or file
/// name, or, when `files` is empty, in the sheet's folder. A fault in one specimen or file does not lose the others.
/// Throws InputError when the sheet itself cannot be used.
Import import_exports(const std::vector<std::filesystem::path>& files, const std::filesystem::path& sheet,
                      const ImportSettings& settings = {});

/// A sentence where one of the others has the same curve to the last digit, which no two tests have. Else empty.
std::string doubt_of_twins(const SpecimenRecord& one, std::span<const SpecimenRecord> others);

}  // namespace nacre::measurement
