#pragma once
// Exhibits of the game itself: Figures 3-2 to 3-4 and 3-7, Tables 3.3 to 3.5 of the thesis.

#include "report/exhibit.hpp"
#include "report/paper_source.hpp"

namespace nacre::report {

Exhibit gamut_exhibit(const PaperSource& source);          // Figure 3-2
Exhibit hypervolume_exhibit(const PaperSource& source);    // Figure 3-3
Exhibit best_exhibit(const PaperSource& source);           // Figure 3-4, Table 3.3
Exhibit base_material_exhibit(const PaperSource& source);  // Table 3.4
Exhibit error_exhibit(const PaperSource& source);          // Figure 3-7, Table 3.5

}  // namespace nacre::report
