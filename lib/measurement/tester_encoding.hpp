#pragma once
// First stage of reading an export: bytes of an instrument -> UTF-8.

#include <span>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace nacre::measurement {

/// Text and the encoding in which it was written.
struct DecodedText {
  std::string text;      ///< UTF-8 without byte-order mark
  std::string encoding;  ///< `UTF-8`, `UTF-16`, `Windows-1252`, `Shift-JIS`, `GBK`
};

/// UTF-8, UTF-16 of either byte order (marked, or recognised by its zero bytes), Shift-JIS or GBK where they make words
/// that stand in headings (or one of `hints`, names that the reader of the file looks for), otherwise Windows-1252.
/// Error: the file is not text (a workbook, a picture, a cut UTF-16 character), with what was expected.
Result<DecodedText> decoded(std::string_view bytes, std::span<const std::string> hints = {});

/// The text alone.
Result<std::string> utf8_from_instrument(std::string_view bytes);

}  // namespace nacre::measurement
