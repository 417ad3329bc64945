#pragma once
// The parts of write_file_atomically(), also for links and folders that must appear whole.

#include <filesystem>

namespace nacre {

/// A temporary name in the same folder, `path`.HOST-PID-COUNT.part, which no other process and no other call gives out:
/// the content is written there whole, then renamed.
std::filesystem::path name_aside(const std::filesystem::path& path);

/// Syncs the folder's entries to disk, where the file system can: a new name is safe only then.
void sync_folder(const std::filesystem::path& folder);

}  // namespace nacre
