#pragma once
// The parts of write_file_atomically(), also for links and folders that must appear whole, and for files that are
// written piece by piece.

#include <filesystem>
#include <string_view>

namespace nacre {

/// A temporary name in the same folder, `path`.HOST-PID-COUNT.part, which no other process and no other call gives out:
/// the content is written there whole, then renamed.
std::filesystem::path name_aside(const std::filesystem::path& path);

/// Syncs the folder's entries to disk, where the file system can: a new name is safe only then.
void sync_folder(const std::filesystem::path& folder);

/// A file that is written piece by piece and appears whole, or not at all. All throw as write_file_atomically() does.
class FileAside {
 public:
  /// Opens a file beside `link_or_file`, or beside what that links to.
  explicit FileAside(const std::filesystem::path& link_or_file);
  /// Takes away what was not kept.
  ~FileAside();
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;
  void append(std::string_view bytes);
  /// Syncs to disk and renames; nothing may be appended any more.
  void keep();

 private:
  [[noreturn]] void give_up(int reason) const;
  std::filesystem::path path_, aside_;
  int fd_ = -1;
};

}  // namespace nacre
