#include "measurement/sheet_exports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "base/files.hpp"
#include "measurement/set_files.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

namespace fs = std::filesystem;

/// Place of the part that a sheet names or numbers; the error lists them all.
tl::expected<std::size_t, std::string> part_of(const std::vector<TesterRecord>& records, const std::string& wanted) {
  constexpr std::size_t kMostNamed = 20;
  if (records.size() == 1 && wanted.empty()) return 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!wanted.empty() && plain_words(records[i].part) == plain_words(wanted)) return i;
    if (i < kMostNamed) names.push_back(records[i].part);
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (error == std::errc{} && end == wanted.data() + wanted.size() && number >= 1 && number <= records.size())
    return number - 1;
  return tl::unexpected(fmt::format("{}{}", fmt::join(names, ", "), records.size() > kMostNamed ? ", ..." : ""));
}

/// Different columns of one file may be different tests.
std::string key_of(const fs::path& path, const ColumnChoice& choice) {
  return path.lexically_normal().string() + fmt::format("\n{}\n{}\n{}\n{}\n{}\n{}\n{}", choice.extension_falls,
                                                        choice.extension, choice.force, choice.time, choice.strain,
                                                        choice.stress, choice.unit);
}

tl::expected<std::vector<TesterRecord>, ImportFault> read_anew(const fs::path& path, const ColumnChoice& choice) {
  try {
    return read_tester_export(read_file_up_to(path, kMostCurveBytes), path.string(), choice);
  } catch (const InputError& error) {
    return tl::unexpected(ImportFault{path.string(), 0, "", error.what()});
  }
}

}  // namespace

tl::expected<TesterRecord, ImportFault> SheetExports::record_of(const SheetRow& row, const std::string& sheet) {
  const auto path = find(row.file);
  if (!path) return tl::unexpected(ImportFault{sheet, row.line, "file", path.error().message});
  const auto& records = read(*path, row.columns);
  if (!records) return tl::unexpected(records.error());
  const auto part = part_of(*records, row.part);
  if (!part) {
    return tl::unexpected(ImportFault{
        sheet, row.line, "part",
        row.part.empty()
            ? fmt::format("`{}` holds {} tests, expected the name or number of one in the column `part`: {}", row.file,
                          records->size(), part.error())
            : fmt::format("`{}`, but `{}` holds {} tests: {}", row.part, row.file, records->size(), part.error())});
  }
  const auto [owner, is_first] = owners_.try_emplace({key_of(*path, row.columns), *part}, &row);
  if (!is_first) {
    return tl::unexpected(ImportFault{sheet, row.line, "file",
                                      fmt::format("`{}` is already specimen {} (line {}), expected a test of its own",
                                                  row.file, owner->second->record.specimen, owner->second->line)});
  }
  const TesterRecord& record = (*records)[*part];
  if (record.fault) return tl::unexpected(*record.fault);
  return record;
}

std::vector<std::string> SheetExports::unused() const {
  std::vector<std::string> names;
  for (const fs::path& file : files_) {
    if (!used_.contains(file.string())) names.push_back(file.string());
  }
  return names;
}

Result<fs::path> SheetExports::find(const std::string& name) {
  const auto matching = [&](auto same) {
    std::vector<fs::path> found;
    std::copy_if(files_.begin(), files_.end(), std::back_inserter(found), same);
    return found;
  };
  if (files_.empty() && confined_ && fs::path(name).filename() != name)
    return fail("`{}` leads out of the sheet's folder, expected the name of a file in it", name);
  if (files_.empty()) {
    const fs::path in_folder = folder_ / name;
    std::error_code unreadable;
    if (fs::exists(in_folder, unreadable)) return in_folder;
    return fail("there is no file {}, expected an export in the sheet's folder or on the command line",
                in_folder.string());
  }
  auto found = matching([&](const fs::path& file) { return file == name || file == folder_ / name; });
  if (found.empty())
    found = matching([&](const fs::path& file) { return file.filename() == fs::path(name).filename(); });
  if (found.empty())
    return fail("`{}` is not among the {} exports given, expected one of that name", name, files_.size());
  if (found.size() > 1)
    return fail("`{}` is the name of {} exports given, expected the path of one of them", name, found.size());
  used_.insert(found.front().string());
  return found.front();
}

const tl::expected<std::vector<TesterRecord>, ImportFault>& SheetExports::read(const fs::path& path,
                                                                               const ColumnChoice& choice) {
  const std::string key = key_of(path, choice);
  const auto known = read_.find(key);
  if (known != read_.end()) return known->second;
  return read_.emplace(key, read_anew(path, choice)).first->second;
}

}  // namespace nacre::measurement
