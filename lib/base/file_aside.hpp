#pragma once
// What write_file_atomically() is made of, for links and folders that appear whole, too.

#include <filesystem>

namespace nacre {

/// A name beside `path` for what is written whole before it takes the name itself: HOST-PID-COUNT.part behind it, which
/// no other process and no other call gives out.
std::filesystem::path name_aside(const std::filesystem::path& path);

/// A new name is on disk only when its folder's entry is, where the file system can say so.
void sync_folder(const std::filesystem::path& folder);

}  // namespace nacre
