#pragma once
// Designs as small pictures, soft and rigid in the colours of page_style.hpp.

#include <string>

#include "pattern/design.hpp"

namespace nacre::report {

/// The unit of a design as a picture of 20 x 20 pixels; a homogeneous material as a plain square. `side` in px.
std::string design_picture(const pattern::Design& design, int side);

/// Which colour is soft and which rigid, as HTML for a paragraph.
std::string phase_legend();

}  // namespace nacre::report
