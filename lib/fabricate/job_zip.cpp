#include "fabricate/job_zip.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include "base/result.hpp"

namespace nacre::fabricate {
namespace {

namespace fs = std::filesystem;

using Archive = std::unique_ptr<archive, decltype(&archive_write_free)>;
using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

la_ssize_t hand_on(archive* to, void* sink, const void* bytes, std::size_t count) {
  if ((*static_cast<const ByteSink*>(sink))({static_cast<const char*>(bytes), count}))
    return static_cast<la_ssize_t>(count);
  archive_set_error(to, ECANCELED, "nobody takes it");
  return -1;
}

/// Regular files alone: nothing behind a link belongs to the job.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.symlink_status().type() == fs::file_type::regular) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// False where the sink takes no more.
bool add(archive* to, const fs::path& file, const fs::path& name) {
  std::ifstream from(file, std::ios::binary);
  if (!from) throw InputError::format("{}: cannot be read: {}", file.string(), std::strerror(errno));
  const Entry entry(archive_entry_new(), archive_entry_free);
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(fs::file_size(file)));
  if (archive_write_header(to, entry.get()) != ARCHIVE_OK) return false;
  std::array<char, 1 << 16> block;
  while (from.read(block.data(), block.size()), from.gcount() > 0)
    if (archive_write_data(to, block.data(), static_cast<std::size_t>(from.gcount())) < 0) return false;
  return true;
}

}  // namespace

void write_zip(const fs::path& folder, const ByteSink& sink) {
  const Archive zip(archive_write_new(), archive_write_free);
  archive_write_set_format_zip(zip.get());
  archive_write_set_bytes_in_last_block(zip.get(), 1);  // no filling
  if (archive_write_open(zip.get(), const_cast<ByteSink*>(&sink), nullptr, hand_on, nullptr) != ARCHIVE_OK) return;
  for (const fs::path& file : files_below(folder))
    if (!add(zip.get(), file, folder.filename() / fs::relative(file, folder))) return;
  archive_write_close(zip.get());
}

}  // namespace nacre::fabricate
