#pragma once
// The delimiter of a testing machine's export, and what its cells hold.

#include <cstddef>
#include <string_view>
#include <vector>

namespace nacre::measurement {

using Cells = std::vector<std::string_view>;  ///< of one line

/// Whether a line holds nothing but blanks, delimiters and quotes.
bool is_blank(std::string_view line);
/// Whether a text holds a letter, of any script.
bool has_letter(std::string_view text);
bool is_number(std::string_view cell);
/// The same, or a number with its unit behind it.
bool is_measured(std::string_view cell);
/// How many cells are not empty.
std::size_t filled(const Cells& cells);

/// How many cells of a file's lines are numbers with a delimiter, less twice those that are not.
double score_of(const std::vector<std::string_view>& lines, char delimiter);
/// The delimiter with which most cells are numbers; '\0' where there is none. Runs of blanks are not tried.
char delimiter_of(const std::vector<std::string_view>& lines);

}  // namespace nacre::measurement
