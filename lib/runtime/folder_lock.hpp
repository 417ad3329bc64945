#pragma once
// The lock of a node's folder (RUN/nodes/NODE/lock): one process at a time runs the node or works on what is its own.

#include <filesystem>

namespace nacre::runtime {

/// Holds FOLDER/lock until the object dies or the process ends, however it does.
class FolderLock {
 public:
  /// Waits a second for whoever only works there for a moment. Throws InputError: another process holds it, or it
  /// cannot be opened; NoSpace on a full disk.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace nacre::runtime
