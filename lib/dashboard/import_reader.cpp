#include "dashboard/import_reader.hpp"

#include <fstream>
#include <sstream>

#include "base/files.hpp"
#include "measurement/read_set.hpp"
#include "measurement/set_columns.hpp"
#include "runtime/process.hpp"

namespace nacre::dashboard {
namespace {

namespace fs = std::filesystem;

constexpr const char *kFiles = "files", *kSet = "set", *kOutput = "understood.json", *kErrors = "errors.txt";

void write_new_file(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << bytes) || !file.flush()) throw InputError::format("{}: cannot be written", path.filename().string());
}

/// The last line that is no warning: why the program gave up.
std::string last_error(const fs::path& file) {
  constexpr std::size_t kMostShown = 2000;
  std::istringstream lines(read_file(file));
  std::string found = "the files cannot be read";
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && !line.starts_with("warning: ")) found = line;
  if (found.ends_with("std::bad_alloc"))
    return "the files need more memory than they may: expected fewer or smaller ones";
  if (found.starts_with("nacre: ")) found.erase(0, 7);
  return found.substr(0, kMostShown);
}

}  // namespace

ReadUpload::ReadUpload(const Upload& upload, const ImportReader& reader) {
  write_files(upload);
  std::vector<std::string> command = reader.command;
  if (upload.keeps_toe) command.push_back("--toe=keep");
  for (const std::string& argument :
       {std::string("--json"), std::string("--confined"), "--out=" + (folder_.path() / kSet).string(),
        "--specimens=" + upload.sheet.name, std::string("--")})
    command.push_back(argument);
  for (const UploadedFile& file : upload.exports) command.push_back(file.name);
  const runtime::LimitedEnd ended = runtime::run_limited(command,
                                                         {.folder = folder_.path() / kFiles,
                                                          .output_file = folder_.path() / kOutput,
                                                          .error_file = folder_.path() / kErrors,
                                                          .memory_bytes = reader.memory_bytes,
                                                          .file_bytes = reader.file_bytes,
                                                          .processor_s = reader.processor_s},
                                                         reader.patience_s);
  if (ended.is_late) {
    problem_ = fmt::format("reading the files takes more than {} s, and was ended", reader.patience_s);
  } else if (ended.end.signal != 0) {
    problem_ =
        fmt::format("reading the files takes more than it may ({}), and was ended: expected fewer or smaller ones",
                    ended.end.in_words());
  }
}

void ReadUpload::write_files(const Upload& upload) const {
  const fs::path files = folder_.path() / kFiles;
  fs::create_directory(files);
  write_new_file(files / upload.sheet.name, upload.sheet.bytes);
  for (const UploadedFile& file : upload.exports) write_new_file(files / file.name, file.bytes);
}

Result<nlohmann::ordered_json> ReadUpload::document() const {
  if (!problem_.empty()) return fail("{}", problem_);
  auto document = nlohmann::ordered_json::parse(read_file(folder_.path() / kOutput), nullptr, false);
  if (!document.is_object()) return fail("{}", last_error(folder_.path() / kErrors));
  return document;
}

std::vector<measurement::SpecimenRecord> ReadUpload::specimens() const {
  std::error_code unreadable;
  if (!fs::exists(folder_.path() / kSet / measurement::kTableName, unreadable)) return {};
  return measurement::read_measurement_set(folder_.path() / kSet).specimens;
}

}  // namespace nacre::dashboard
