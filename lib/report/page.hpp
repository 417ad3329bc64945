#pragma once
// A page of exhibits: one self-contained HTML file, no script, nothing from outside, readable offline.

#include <string>
#include <vector>

#include "report/exhibit.hpp"

namespace nacre::report {

/// How a page begins, before its exhibits.
struct PageHead {
  std::string title;         ///< plain; of the browser's tab
  std::string eyebrow;       ///< plain; above the heading: what kind of page it is
  std::string heading;       ///< plain
  std::string content = {};  ///< HTML
};

/// Head, links to the exhibits, exhibits. The policy in its head forbids the page every outside resource and every
/// script, should a text ever slip through.
std::string render_page(const PageHead& head, const std::vector<Exhibit>& exhibits);

}  // namespace nacre::report
