#include "measurement/tester_encoding.hpp"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/csv.hpp"
#include "measurement/tester_vocabulary.hpp"

namespace nacre::measurement {
namespace {

/// Umlauts and accents between Latin letters: no pair of bytes of another encoding looks like that.
std::size_t western_letters(std::string_view bytes) {
  const auto is_latin = [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
  };
  std::size_t found = 0;
  for (std::size_t i = 1; i + 1 < bytes.size(); ++i)
    found += static_cast<unsigned char>(bytes[i]) >= 0xC0 && is_latin(bytes[i - 1]) && is_latin(bytes[i + 1]);
  return found;
}

void append_utf8(std::string& text, std::uint32_t point) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xC0 | point >> 6);
    put(0x80 | (point & 0x3F));
  } else if (point < 0x10000) {
    put(0xE0 | point >> 12);
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  } else {
    put(0xF0 | point >> 18);
    put(0x80 | (point >> 12 & 0x3F));
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  }
}

constexpr std::uint32_t kReplacementCharacter = 0xFFFD;

Result<std::string> from_utf16(std::string_view bytes, bool low_byte_first) {
  if (bytes.size() % 2 != 0) return fail("UTF-16 text with half a character at its end, expected a whole file");
  const auto unit_at = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(low_byte_first ? a | b << 8 : b | a << 8);
  };
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const std::uint32_t unit = unit_at(i);
    const bool is_surrogate = unit >= 0xD800 && unit < 0xE000;
    const std::uint32_t low = is_surrogate && i + 3 < bytes.size() ? unit_at(i + 2) : 0;
    if (unit < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
      append_utf8(text, 0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00));
      i += 2;
    } else {
      append_utf8(text, is_surrogate ? kReplacementCharacter : unit);  // half a pair has no meaning
    }
  }
  return text;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// Windows-1252; its few signs between 0x80 and 0x9F that headings do not hold become a question mark.
std::string from_windows_1252(std::string_view bytes) {
  constexpr std::uint32_t kApostrophe = 0x2019, kEnDash = 0x2013, kPerMille = 0x2030;
  std::string text;
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    const std::uint32_t point = value == 0x92   ? kApostrophe
                                : value == 0x96 ? kEnDash
                                : value == 0x89 ? kPerMille
                                                : value;
    append_utf8(text, point >= 0x80 && point < 0xA0 ? '?' : point);
  }
  return text;
}

/// `bytes` in an encoding that iconv knows; nothing where they do not fit it.
std::optional<std::string> from_named(const char* encoding, std::string_view bytes) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string text(3 * bytes.size() + 16, '\0');
  std::string source(bytes);
  char *in = source.data(), *out = text.data();
  std::size_t in_left = source.size(), out_left = text.size();
  const std::size_t converted = iconv(converter, &in, &in_left, &out, &out_left);
  iconv_close(converter);
  if (converted == static_cast<std::size_t>(-1) || in_left != 0) return std::nullopt;
  text.resize(text.size() - out_left);
  return text;
}

/// Bytes that are neither UTF-8 nor UTF-16: of the encodings whose text holds words of headings the one with most.
DecodedText from_bytes(std::string_view bytes, std::span<const std::string> hints) {
  constexpr std::array kNames = {std::pair("CP932", "Shift-JIS"), std::pair("GBK", "GBK"),
                                 std::pair("EUC-JP", "EUC-JP"), std::pair("BIG5", "Big5"), std::pair("CP949", "CP949")};
  DecodedText best{from_windows_1252(bytes), "Windows-1252"};
  std::size_t most = western_letters(bytes);
  for (const auto& [name, shown] : kNames) {
    std::optional<std::string> text = from_named(name, bytes);
    if (!text) continue;
    std::size_t words = east_asian_words(*text);
    for (const std::string& hint : hints) words += !hint.empty() && text->find(hint) != std::string::npos ? 2 : 0;
    if (words <= most) continue;
    most = words;
    best = {std::move(*text), shown};
  }
  return best;
}

/// UTF-16 without a mark: Latin text has a zero in every other byte.
std::optional<bool> unmarked_utf16(std::string_view bytes) {
  std::array<std::size_t, 2> zeros{};
  const std::size_t looked_at = std::min<std::size_t>(bytes.size(), 400) & ~std::size_t{1};
  for (std::size_t i = 0; i < looked_at; ++i) zeros[i % 2] += bytes[i] == '\0';
  if (looked_at < 8) return std::nullopt;
  if (zeros[1] * 2 > looked_at * 8 / 10 && zeros[0] == 0) return true;
  if (zeros[0] * 2 > looked_at * 8 / 10 && zeros[1] == 0) return false;
  return std::nullopt;
}

}  // namespace

Result<DecodedText> decoded(std::string_view bytes, std::span<const std::string> hints) {
  const auto utf16 = [](std::string_view units, bool low_byte_first) -> Result<DecodedText> {
    auto text = from_utf16(units, low_byte_first);
    if (!text) return tl::unexpected(text.error());
    return DecodedText{std::move(*text), "UTF-16"};
  };
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("\xD0\xCF\x11\xE0"))
    return fail("is a workbook, expected a text file: export or save it as CSV");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (bytes.starts_with("\xFF\xFE")) return utf16(bytes.substr(2), true);
  if (bytes.starts_with("\xFE\xFF")) return utf16(bytes.substr(2), false);
  if (const auto low_byte_first = unmarked_utf16(bytes)) return utf16(bytes, *low_byte_first);
  if (bytes.find('\0') != std::string_view::npos) return fail("holds zero bytes, expected a text file");
  if (is_utf8(bytes)) return DecodedText{std::string(bytes), "UTF-8"};
  return from_bytes(bytes, hints);
}

Result<std::string> utf8_from_instrument(std::string_view bytes) {
  auto text = decoded(bytes);
  if (!text) return tl::unexpected(text.error());
  return std::move(text->text);
}

}  // namespace nacre::measurement
