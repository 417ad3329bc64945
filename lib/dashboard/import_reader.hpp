#pragma once
// Uploaded files through the reader of `nacre import`, in a process of its own: what strangers made may be anything.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/temporary_folder.hpp"
#include "dashboard/upload.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::dashboard {

struct ImportReader {
  std::vector<std::string> command;         ///< `nacre import`; empty: there is none
  std::uint64_t memory_bytes = 2ull << 30;  ///< of addresses
  std::uint64_t file_bytes = 256ull << 20;  ///< of each file that it writes
  unsigned processor_s = 60;
  double patience_s = 90.0;
};

/// What the reader understood. Throws InputError where the reader cannot be started or the files not be written.
class ReadUpload {
 public:
  ReadUpload(const Upload& upload, const ImportReader& reader);
  /// The document of `nacre import --json` or, where there is none, why, as a sentence.
  Result<nlohmann::ordered_json> document() const;
  /// Its usable specimens, as a measurement set keeps them.
  std::vector<measurement::SpecimenRecord> specimens() const;
  /// Holds `files` (the uploaded ones) and `set` (the measurement set).
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  void write_files(const Upload& upload) const;
  TemporaryFolder folder_{"import"};
  std::string problem_;  ///< empty where the reader came to its end
};

}  // namespace nacre::dashboard
