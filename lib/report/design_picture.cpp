#include "report/design_picture.hpp"

#include <fmt/format.h>

#include "report/svg.hpp"

namespace nacre::report {
namespace {

/// Rigid pixels as one path, a run of a row at a time.
std::string pixels_path(const pattern::Layout& layout) {
  std::string path;
  for (int row = 0; row < pattern::kSide; ++row) {
    for (int column = 0; column < pattern::kSide;) {
      int end = column;
      while (end < pattern::kSide && layout.rigid(row, end)) ++end;
      if (end > column) path += fmt::format("M{} {}h{}v1h-{}Z", column, row, end - column, end - column);
      column = end + 1;
    }
  }
  return path;
}

std::string phase_sample(std::string_view phase) {
  return fmt::format(
      "<svg class=\"unit\" viewBox=\"0 0 1 1\" width=\"13\" height=\"13\" role=\"img\" aria-label=\"colour of {0} "
      "pixels\"><rect class=\"{0}\" width=\"1\" height=\"1\"/></svg>",
      phase);
}

}  // namespace

std::string design_picture(const pattern::Design& design, int side) {
  std::string content;
  if (const pattern::Layout* layout = design.layout()) {
    content = fmt::format("<path class=\"rigid\" d=\"{}\"/>", pixels_path(*layout));
  } else {
    content =
        fmt::format("<rect class=\"rigid\" width=\"20\" height=\"20\" opacity=\"{:.2f}\"/>", design.rigid_fraction());
  }
  return fmt::format(
      "<svg class=\"unit\" viewBox=\"0 0 20 20\" width=\"{0}\" height=\"{0}\" role=\"img\" aria-label=\"unit of {1}\">"
      "<rect class=\"soft\" width=\"20\" height=\"20\"/>{2}</svg>",
      side, escaped(design.name()), content);
}

std::string phase_legend() {
  return fmt::format("<span class=\"legend\">{} rigid</span> <span class=\"legend\">{} soft</span>",
                     phase_sample("rigid"), phase_sample("soft"));
}

}  // namespace nacre::report
