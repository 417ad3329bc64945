#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace nacre {

/// The whole file as bytes. Throws InputError naming the file and the system's reason.
std::string read_file(const std::filesystem::path& path);

/// The same for a regular file of at most `most_bytes`: a device, a pipe or a larger file is an InputError.
std::string read_file_up_to(const std::filesystem::path& path, std::size_t most_bytes);

/// The path without a slash at its end, so that its last part is the folder's name: `RUN/` -> `RUN`.
std::filesystem::path without_last_slash(const std::filesystem::path& path);

/// The path as a word of a shell command: in single quotes where it needs them.
std::string shell_word(const std::filesystem::path& path);

/// Makes a folder and those above it; one that exists already is fine. Throws InputError naming it and the reason,
/// NoSpace where that is a full disk.
void make_folder(const std::filesystem::path& folder);

/// Writes aside, syncs to disk, renames: a reader sees the old or the new content, never a part, and a full disk loses
/// nothing. Throws InputError naming the file and the system's reason, NoSpace where that is a full disk.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace nacre
