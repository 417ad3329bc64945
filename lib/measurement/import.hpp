#pragma once
// Raw exports of a testing machine and a sheet of specimens -> measured specimens.

#include <filesystem>
#include <string>
#include <vector>

#include "measurement/measurement.hpp"
#include "measurement/reduction.hpp"
#include "measurement/tester_export.hpp"

namespace nacre::measurement {

/// One specimen that could be used.
struct ImportedSpecimen {
  SpecimenRecord record;
  std::string file;
  std::string maker;
  ReducedTest test;
};

struct Import {
  std::vector<ImportedSpecimen> specimens;  ///< in the order of the sheet
  std::vector<ImportFault> rejected;        ///< one per specimen or file that could not be used
  std::vector<std::string> warnings;
};

struct ImportSettings {
  Toe toe = Toe::compensate;
};

/// Reads `sheet` (docs/FORMATS.md, "Specimen sheets") and the exports that it names: among `files` by path or file
/// name, or, when `files` is empty, beside the sheet. What is wrong with one specimen or file loses no other. Throws
/// InputError when the sheet itself cannot be used.
Import import_exports(const std::vector<std::filesystem::path>& files, const std::filesystem::path& sheet,
                      const ImportSettings& settings = {});

}  // namespace nacre::measurement
