#pragma once
// Exhibits of the families that measurements propose: Figures 3-12 and 3-13 of the thesis.

#include "report/exhibit.hpp"
#include "report/paper_source.hpp"

namespace nacre::report {

Exhibit family_exhibit(const PaperSource& source);        // Figure 3-12
Exhibit family_curve_exhibit(const PaperSource& source);  // Figure 3-13

}  // namespace nacre::report
