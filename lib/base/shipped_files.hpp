#pragma once
// Where that stands which comes with nacre: data/, launch/ (scenarios), the page, the manual.

#include <filesystem>
#include <optional>
#include <string>

namespace nacre {

/// For a library in a program that is not nacre's: what is found beside the program is looked for beside this folder
/// from now on, as if the program lay there. Before any other thread looks.
void set_program_folder(const std::filesystem::path& folder);

/// Of a program installed as PREFIX/bin/PROGRAM: PREFIX/share/nacre. Nothing for one that runs where it was built.
std::optional<std::filesystem::path> installed_folder();

/// The folder that holds data/ and launch/: the installed one, else the source tree above the program, else the
/// working folder.
std::filesystem::path shipped_folder();

/// The folder that holds what a build makes beside programs, commit and web/: the installed one, else the build's.
std::filesystem::path built_folder();

/// The commit that the program was built from, "+changes" appended when the sources differed from it; "unknown" where
/// they were no git repository. From the file that every build writes, so that no program depends on it.
std::string build_commit();

}  // namespace nacre
