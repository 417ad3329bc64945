#pragma once
// The report's sections as HTML, each complete with heading, words and figures. Where data are still missing a section
// says what is awaited.

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "store/run_record.hpp"

namespace nacre::report {

/// How the game stands, in a few sentences; the page's head.
std::string standing_section(const store::RunRecord& run, const std::string& run_id);
/// The same without the heading.
std::string standing_sentences(const store::RunRecord& run);
std::string gamut_section(const store::RunRecord& run);
std::string round_section(const store::RunRecord& run);
std::string error_section(const store::RunRecord& run);
std::string best_designs_section(const store::RunRecord& run);
std::string proposal_section(const store::RunRecord& run);
std::string curve_section(const store::RunRecord& run);
std::string diagnosis_section(const store::RunRecord& run);
std::string specimen_section(const store::RunRecord& run);

// Pieces that the sections share. Texts are HTML: whatever comes from a message has to be escaped before.
std::string section(std::string_view anchor, std::string_view heading, const std::string& content);
std::string paragraph(std::string_view words, std::string_view classes = "");
/// What is still missing, in place of a figure.
std::string awaited(std::string_view what);
std::string table_row(const std::vector<std::string>& cells, std::string_view classes = "");
/// `header` and `rows` are finished table rows; wide tables scroll by themselves.
std::string table(const std::string& header, const std::string& rows, std::string_view classes = "");
std::string header_row(std::initializer_list<std::string_view> cells);

/// A verdict of a diagnosis as a sentence.
std::string verdict_in_words(const std::string& verdict);

}  // namespace nacre::report
