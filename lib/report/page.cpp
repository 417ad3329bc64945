#include "report/page.hpp"

#include <fmt/format.h>

#include "report/page_style.hpp"
#include "report/svg.hpp"

namespace nacre::report {

std::string render_page(const PageHead& head, const std::vector<Exhibit>& exhibits) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "img-src data:\">\n"
      "<title>{}</title>\n<style>{}{}{}{}{}</style>\n</head>\n<body>\n<main>\n",
      escaped(head.title), phase_colours(), kLightColours, kDarkColours, kFigureStyle, kPageStyle);
  page += fmt::format("<header>\n<p class=\"eyebrow\">{}</p>\n<h1>{}</h1>\n{}{}</header>\n", escaped(head.eyebrow),
                      escaped(head.heading), head.content, exhibits.empty() ? "" : render_contents(exhibits));
  for (const Exhibit& exhibit : exhibits) page += render_exhibit(exhibit);
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace nacre::report
