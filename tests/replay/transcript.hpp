#pragma once
// A golden game for readers: a line for whatever a node hears, says, asks to be worked out and gets. A change of what
// nodes say reads there like a change of any text.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::golden {

/// One message as "CHANNEL field=value ...": fields in the order of its type, without those that are zero or empty.
/// Numbers have four digits, so that another processor's exp and log change nothing. Structs of numbers and texts are
/// {value value ...}, longer lists NAME[COUNT]#HASH of such text, named by their first texts where they are few.
std::string line_of(std::string_view channel, const std::string& payload);

/// What the journals of `run` hold: lines "NODE says CHANNEL ...", node by node.
std::vector<std::string> recorded_lines(const std::filesystem::path& run);

/// The same with what fresh cores say and ask now when they hear what is recorded. Work is not done again.
std::vector<std::string> lines_of_now(const std::filesystem::path& run, const std::filesystem::path& scratch);

/// Lines that were ("- ") and that are now ("+ "), with the line before them; at most `most`. Empty: no difference.
std::string difference(const std::vector<std::string>& was, const std::vector<std::string>& now, int most = 40);

/// FOLDER/transcript.txt of a golden game, line by line. Throws InputError.
std::vector<std::string> read_transcript(const std::filesystem::path& folder);
void write_transcript(const std::vector<std::string>& lines, const std::filesystem::path& folder);

}  // namespace nacre::golden
