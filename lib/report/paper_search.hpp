#pragma once
// The exhibit of the search: Figure 3-9 of the thesis.

#include "report/exhibit.hpp"
#include "report/paper_source.hpp"

namespace nacre::report {

Exhibit search_exhibit(const PaperSource& source);

}  // namespace nacre::report
