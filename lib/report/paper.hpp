#pragma once
// The figures and tables of the thesis from a run of one's own (`nacre report`): one page, and every figure as SVG and
// CSV, every table as CSV.

#include <filesystem>
#include <string>
#include <vector>

#include "report/exhibit.hpp"
#include "report/paper_source.hpp"

namespace nacre::report {

/// All of them, in the order of the thesis.
std::vector<Exhibit> exhibits_of(const PaperSource& source);

/// The page: self-contained, no script, nothing from outside; light and dark, and light on paper.
std::string render_paper(const PaperSource& source, const std::vector<Exhibit>& exhibits);

/// Writes FOLDER/index.html and a file for every figure and table. Throws InputError.
void write_paper(const std::filesystem::path& folder, const PaperSource& source);

}  // namespace nacre::report
