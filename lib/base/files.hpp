#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace nacre {

/// The whole file as bytes. Throws InputError naming the file and the system's reason.
std::string read_file(const std::filesystem::path& path);

/// Writes aside, syncs to disk, renames: a reader sees the old or the new content, never a part, and a full disk loses
/// nothing. Throws InputError naming the file and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace nacre
