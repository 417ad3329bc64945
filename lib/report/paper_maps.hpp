#pragma once
// Exhibits of the subfamilies' maps: Figures 3-16 to 3-18, Table A.7 of the thesis.

#include "report/exhibit.hpp"
#include "report/paper_source.hpp"

namespace nacre::report {

Exhibit map_exhibit(const PaperSource& source);            // Figure 3-16
Exhibit interpolation_exhibit(const PaperSource& source);  // Figure 3-17
Exhibit refinement_exhibit(const PaperSource& source);     // Figure 3-18
Exhibit growth_appendix(const PaperSource& source);        // Table A.7

}  // namespace nacre::report
