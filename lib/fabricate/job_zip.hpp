#pragma once
// A print job as one file.

#include <filesystem>
#include <functional>
#include <string_view>

namespace nacre::fabricate {

/// Takes bytes in order; false: it takes no more.
using ByteSink = std::function<bool(std::string_view)>;

/// Writes all files below `folder`, in the order of their paths, as a ZIP of a folder of its name. It is made while it
/// is taken: no more than a block of a file is held. Stops where `sink` takes no more. Throws InputError naming the
/// file that cannot be read.
void write_zip(const std::filesystem::path& folder, const ByteSink& sink);

}  // namespace nacre::fabricate
