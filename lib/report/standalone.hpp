#pragma once
// A picture of a page as a file of its own. Programs that print or edit pictures (librsvg, say) know nothing of CSS
// variables and drop what they colour: the style is written out.

#include <string>

namespace nacre::report {

/// Light whatever the viewer's scheme: name space and style sheet are put in.
std::string standalone(const std::string& svg);

}  // namespace nacre::report
