#pragma once
// The build sheet as people read it at the printer and at the testing machine.

#include "fabricate/build_sheet.hpp"

namespace nacre::fabricate {

/// One page, which shows the pictures of its folder (build_sheet.hpp).
std::string build_sheet_html(const Job& job, const WrittenJob& written);

}  // namespace nacre::fabricate
