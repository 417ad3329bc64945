#pragma once
// Writing an import into a measurement set, which may exist: its specimens stay.

#include <filesystem>
#include <string>

#include "measurement/import.hpp"

namespace nacre::measurement {

/// Writes the import of `sheet` into the measurement set `folder`: a new one, or one that gains specimens. A specimen
/// that the set holds with the same test keeps the set's validity and note (`import` then says these). A known name
/// with another test is moved to the rejected, or, with `replace`, takes the place, validity and note of the old one.
/// Throws InputError when the set cannot be read or written.
void write_import(const std::filesystem::path& folder, const std::string& sheet, Import& import, bool replace = false);

}  // namespace nacre::measurement
