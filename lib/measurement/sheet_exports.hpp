#pragma once
// The exports that a sheet of specimens names, and which part of them is which specimen.

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "measurement/specimen_sheet.hpp"
#include "measurement/tester_export.hpp"

namespace nacre::measurement {

/// The exports, each read once: among `files` by path or file name, or, when there are none, in `folder`.
class SheetExports {
 public:
  /// `files` must outlive this. `confined`: in `folder` alone, not where a path leads out of it.
  SheetExports(const std::vector<std::filesystem::path>& files, std::filesystem::path folder, bool confined = false)
      : files_(files), folder_(std::move(folder)), confined_(confined) {}

  /// The test of a row, which must outlive this, or what is wrong with it: no such file or part, or a part that is
  /// another row's already.
  tl::expected<TesterRecord, ImportFault> record_of(const SheetRow& row, const std::string& sheet);

  /// Files that no row names.
  std::vector<std::string> unused() const;

 private:
  Result<std::filesystem::path> find(const std::string& name);
  const tl::expected<std::vector<TesterRecord>, ImportFault>& read(const std::filesystem::path& path,
                                                                   const ColumnChoice& choice);

  const std::vector<std::filesystem::path>& files_;
  std::filesystem::path folder_;
  bool confined_;
  std::set<std::string> used_;
  std::map<std::string, tl::expected<std::vector<TesterRecord>, ImportFault>> read_;
  std::map<std::pair<std::string, std::size_t>, const SheetRow*>
      owners_;  ///< key and part -> the first row of the test
};

}  // namespace nacre::measurement
