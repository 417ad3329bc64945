#pragma once
// Files that a person drops on the page: the specimens' sheet and the testing machine's exports.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "dashboard/http.hpp"

namespace nacre::dashboard {

inline constexpr std::size_t kMostUploadBytes = 64u << 20;  ///< of a whole request
inline constexpr std::size_t kMostExportBytes = 32u << 20;  ///< of one file
inline constexpr std::size_t kMostExports = 500;
inline constexpr std::size_t kMostParts = kMostExports + 2;  ///< and the sheet, and what is chosen

struct UploadedFile {
  std::string name;  ///< without a path
  std::string bytes;
};

struct Upload {
  UploadedFile sheet;
  std::vector<UploadedFile> exports;
  std::set<std::string> enter;      ///< specimens to be entered; none: the files are only read
  std::set<std::string> confirmed;  ///< specimens whose doubts of scale a person has looked at
  bool keeps_toe = false;           ///< the flat beginning of curves stays: `nacre import --toe keep`
};

/// The parts `sheet` (a file), `export` (a file each) and, where something is chosen, `choice`: JSON with the lists
/// `enter` and `confirmed` and `toe` (`keep`, `compensate`). Errors name the part or the file and what was expected:
/// names are plain ones, each once.
Result<Upload> upload_from_parts(std::vector<Part> parts);

}  // namespace nacre::dashboard
