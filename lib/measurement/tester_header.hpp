#pragma once
// The header of a testing machine's export: maker, date, operator, machine.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace nacre::measurement {

inline constexpr std::size_t kMostHeaderLines = 2000;  ///< number of lines that are searched for a heading

/// Of a file's lines: blocks of MTS 793 are parts of one test.
bool is_mts_793(std::span<const std::string_view> lines);

/// "Instron Bluehill", "ZwickRoell testXpert", "MTS", or "table" where none is recognised.
std::string maker_of(std::span<const std::string_view> lines, char delimiter);

/// `date`, `operator` and `machine` from the lines before the heading: `Key,Value`, `Key: Value` or `Key : Value`, in
/// English, German or French; the first of a kind counts.
std::map<std::string, std::string> header_of(std::span<const std::string_view> lines, char delimiter);

}  // namespace nacre::measurement
