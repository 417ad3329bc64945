#pragma once
// What a person sees while something takes long: bars, times, lines that fit the terminal.

#include <cstdio>
#include <string>
#include <string_view>

namespace nacre::runtime {

/// Columns of the terminal behind a file descriptor; 0 when it is none.
int terminal_columns(int file_descriptor);

/// `[#####.....]` of `cells` cells for a progress of 0..1; all dots below 0 (unknown).
std::string bar(double progress, int cells);

/// Writes a line. Not fmt::print, which throws where the disk is full or the reader has gone: a line that is lost must
/// not end what it tells of.
void print_line(std::FILE* out, std::string_view line);

/// "8 s", "2 min 5 s", "3 h 12 min"; empty below 0 (unknown).
std::string in_words(double seconds);

/// "less than a minute", "about 4 min", "about 3 h"; empty below 0 (unknown).
std::string about_in_words(double seconds);
/// "less than a minute left", "about 4 min left", "about 3 h left"; empty below 0 (unknown).
std::string time_left_in_words(double seconds);

/// At most `columns` characters of `text`; never cuts a UTF-8 character in two, and drops control characters.
std::string fitted(std::string_view text, int columns);

}  // namespace nacre::runtime
