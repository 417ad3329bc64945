#pragma once
// The build sheet as people read it at the printer and at the testing machine.

#include "fabricate/build_sheet.hpp"

namespace nacre::fabricate {

/// One self-contained page, with a drawing of each tray.
std::string build_sheet_html(const Job& job, const std::vector<WrittenModel>& written);

}  // namespace nacre::fabricate
