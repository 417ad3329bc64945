#include "pattern/layout.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <vector>

#include <fmt/format.h>

#include "base/lines.hpp"

namespace nacre::pattern {
namespace {

constexpr std::size_t kPatternKeyDigits = 14;
constexpr std::size_t kLayoutKeyDigits = kPixels / 4;

/// Free pixel of every pixel of the quarter; the lower triangle mirrors the upper one.
constexpr std::array<std::array<int, kQuarter>, kQuarter> make_free_indices() {
  std::array<std::array<int, kQuarter>, kQuarter> indices{};
  int next = 0;
  for (int r = 0; r < kQuarter; ++r) {
    for (int c = r; c < kQuarter; ++c) {
      indices[r][c] = next;
      indices[c][r] = next;
      ++next;
    }
  }
  return indices;
}
constexpr auto kFreeIndices = make_free_indices();
static_assert(kFreeIndices[9][9] == kFreePixels - 1);

/// One bit for each free pixel that lies on the quarter's diagonal: those have 4 images, the others 8.
constexpr std::uint64_t make_diagonal_mask() {
  std::uint64_t mask = 0;
  for (std::size_t r = 0; r < kQuarter; ++r) mask |= std::uint64_t{1} << kFreeIndices[r][r];
  return mask;
}
constexpr std::uint64_t kDiagonalMask = make_diagonal_mask();

int image_count(std::uint64_t free_pixels) {
  return 8 * std::popcount(free_pixels & ~kDiagonalMask) + 4 * std::popcount(free_pixels & kDiagonalMask);
}

std::optional<unsigned> lower_hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  return std::nullopt;
}

Result<Layout> layout_from_pattern_digits(std::string_view key) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const auto digit = lower_hex_digit(key[i]);
    if (!digit) return fail("key \"{}\", character {}: expected a lower-case hex digit", key, i + 1);
    bits = bits << 4 | *digit;
  }
  if ((bits & ~kAllFreePixels) != 0) {
    return fail("key \"{}\": a pattern has {} bits, expected at most {:014x}", key, kFreePixels, kAllFreePixels);
  }
  return Pattern(bits).layout();
}

Result<Layout> layout_from_full_digits(std::string_view key) {
  Layout layout;
  for (std::size_t i = 0; i < kLayoutKeyDigits; ++i) {
    const auto digit = lower_hex_digit(key[i + 1]);
    if (!digit) return fail("key \"{}\", character {}: expected a lower-case hex digit", key, i + 2);
    for (int b = 0; b < 4; ++b) {
      const int pixel = static_cast<int>(4 * i) + b;
      layout.set(pixel / kSide, pixel % kSide, (*digit >> (3 - b)) & 1u);
    }
  }
  return layout;
}

}  // namespace

Layout Layout::rotated() const {
  Layout turned;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) turned.set(kSide - 1 - c, r, rigid(r, c));
  }
  return turned;
}

Layout Layout::transposed() const {
  Layout mirrored;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) mirrored.set(c, r, rigid(r, c));
  }
  return mirrored;
}

bool Layout::has_eightfold_symmetry() const { return *this == rotated() && *this == transposed(); }

int Pattern::free_index(int row, int column) {
  assert(row >= 0 && row < kSide && column >= 0 && column < kSide);
  const int r = std::min(row, kSide - 1 - row), c = std::min(column, kSide - 1 - column);
  return kFreeIndices[r][c];
}

int Pattern::orbit_size(int index) {
  assert(index >= 0 && index < kFreePixels);
  return image_count(std::uint64_t{1} << index);
}

void Pattern::set(int row, int column, bool is_rigid) {
  const std::uint64_t bit = std::uint64_t{1} << free_index(row, column);
  bits_ = is_rigid ? bits_ | bit : bits_ & ~bit;
}

int Pattern::rigid_count() const { return image_count(bits_); }

Layout Pattern::layout() const {
  Layout layout;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) layout.set(r, c, rigid(r, c));
  }
  return layout;
}

std::string Pattern::key() const { return fmt::format("{:014x}", bits_); }

std::optional<Pattern> Pattern::from_layout(const Layout& layout) {
  Pattern pattern;
  for (int r = 0; r < kQuarter; ++r) {
    for (int c = r; c < kQuarter; ++c) pattern.set(r, c, layout.rigid(r, c));
  }
  if (pattern.layout() != layout) return std::nullopt;
  return pattern;
}

int pixel_difference(const Pattern& a, const Pattern& b) { return image_count(a.bits() ^ b.bits()); }

std::string key_of(const Layout& layout) {
  if (const auto pattern = Pattern::from_layout(layout)) return pattern->key();
  std::string key = "L";
  for (int pixel = 0; pixel < kPixels; pixel += 4) {
    unsigned digit = 0;
    for (int b = 0; b < 4; ++b) digit = digit << 1 | (layout.rigid((pixel + b) / kSide, (pixel + b) % kSide) ? 1u : 0u);
    key += "0123456789abcdef"[digit];
  }
  return key;
}

Result<Layout> layout_from_key(std::string_view key) {
  if (key.size() == kPatternKeyDigits && key[0] != 'L') return layout_from_pattern_digits(key);
  if (key.size() == kLayoutKeyDigits + 1 && key[0] == 'L') return layout_from_full_digits(key);
  return fail("key \"{}\": expected {} lower-case hex digits (a symmetric pattern) or L and {} of them (any layout)",
              key, kPatternKeyDigits, kLayoutKeyDigits);
}

std::string to_text(const Layout& layout) {
  std::string text;
  text.reserve(kSide * (kSide + 1));
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) text += layout.rigid(r, c) ? '1' : '0';
    text += '\n';
  }
  return text;
}

namespace {

/// An offending byte in an error.
std::string shown(char c) {
  const bool printable = c >= 0x20 && c < 0x7f;
  return printable ? fmt::format("'{}'", c) : fmt::format("byte 0x{:02x}", static_cast<unsigned char>(c));
}

}  // namespace

Result<Layout> layout_from_text(std::string_view text, std::string_view source) {
  constexpr std::string_view kExpected = "expected 20 lines of 20 characters 0 (soft) or 1 (rigid)";
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // editors put the mark of UTF-8 before plain text
  std::vector<std::string_view> lines = lines_in(text);
  while (!lines.empty() && lines.back().find_first_not_of(" \t") == std::string_view::npos) lines.pop_back();
  Layout layout;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    if (r == kSide) return fail("{}: line {}, column 1: more than {} lines, {}", source, r + 1, kSide, kExpected);
    const std::string_view line = lines[r];
    for (std::size_t c = 0; c < std::min<std::size_t>(line.size(), kSide); ++c) {
      if (line[c] != '0' && line[c] != '1') {
        return fail("{}: line {}, column {}: {}, {}", source, r + 1, c + 1, shown(line[c]), kExpected);
      }
      layout.set(r, c, line[c] == '1');
    }
    if (line.size() != kSide) {
      return fail("{}: line {}, column {}: the line has {} characters, {}", source, r + 1,
                  std::min<std::size_t>(line.size(), kSide) + 1, line.size(), kExpected);
    }
  }
  if (lines.size() != kSide) {
    return fail("{}: line {}, column 1: the text ends after {} lines, {}", source, lines.size() + 1, lines.size(),
                kExpected);
  }
  return layout;
}

}  // namespace nacre::pattern
