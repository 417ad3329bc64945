#pragma once
// Why a file, or one specimen, is unusable, and where.

#include <string>

namespace nacre::measurement {

struct ImportFault {
  std::string file;
  int line = 0;               ///< 0: the file as a whole
  std::string column;         ///< heading or column of the sheet; may be empty
  std::string reason;         ///< a sentence with what was expected
  std::string specimen = {};  ///< whose row of the sheet; empty: nobody's
  bool operator==(const ImportFault&) const = default;
};

/// `file:line: column: reason`.
std::string to_string(const ImportFault& fault);

}  // namespace nacre::measurement
