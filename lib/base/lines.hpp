#pragma once

#include <string_view>
#include <vector>

namespace nacre {

/// Takes the first line off `text`, without its LF or CRLF.
std::string_view take_line(std::string_view& text);

/// All lines of a text; a last one without its end counts.
std::vector<std::string_view> lines_in(std::string_view text);

}  // namespace nacre
