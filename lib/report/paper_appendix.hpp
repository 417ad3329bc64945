#pragma once
// Every measured design by the models of all rounds: Tables A.3 and A.4 of the thesis.

#include "report/exhibit.hpp"
#include "report/paper_source.hpp"

namespace nacre::report {

Exhibit modulus_appendix(const PaperSource& source);    // Table A.3: E
Exhibit toughness_appendix(const PaperSource& source);  // Table A.4: T

}  // namespace nacre::report
