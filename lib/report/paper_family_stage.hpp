#pragma once
// Exhibits of the family stage: Figures 3-14 and 3-15, Tables 3.6, 3.7, A.5 and A.6 of the thesis.

#include "report/exhibit.hpp"
#include "report/paper_source.hpp"

namespace nacre::report {

Exhibit seed_error_exhibit(const PaperSource& source);         // Figure 3-14, Table 3.6
Exhibit family_gamut_exhibit(const PaperSource& source);       // Figure 3-15
Exhibit validation_exhibit(const PaperSource& source);         // Table 3.7
Exhibit family_modulus_appendix(const PaperSource& source);    // Table A.5
Exhibit family_toughness_appendix(const PaperSource& source);  // Table A.6

}  // namespace nacre::report
