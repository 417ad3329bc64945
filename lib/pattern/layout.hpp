#pragma once

#include <array>
#include <bitset>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace nacre::pattern {

/// Pixels along one side of a unit (thesis 2.1).
inline constexpr int kSide = 20;
inline constexpr int kPixels = kSide * kSide;
/// Pixels along one side of the upper-left quarter, and the free pixels of a pattern: the quarter's upper triangle.
inline constexpr int kQuarter = kSide / 2;
inline constexpr int kQuarterPixels = kQuarter * kQuarter;
inline constexpr int kFreePixels = kQuarter * (kQuarter + 1) / 2;
/// One bit for every free pixel: the bits of the wholly rigid pattern.
inline constexpr std::uint64_t kAllFreePixels = (std::uint64_t{1} << kFreePixels) - 1;

/// Any 20 x 20 arrangement of soft (0) and rigid (1) pixels; row 0 at the top, column 0 at the left.
/// Coupons (laminates, checkerboards) are layouts; proposals are patterns, see Pattern.
class Layout {
 public:
  Layout() = default;
  bool rigid(int row, int column) const { return bits_[row * kSide + column]; }
  void set(int row, int column, bool is_rigid) { bits_[row * kSide + column] = is_rigid; }
  int rigid_count() const { return bits_.count(); }
  double rigid_fraction() const { return rigid_count() / static_cast<double>(kPixels); }
  /// The layout turned by 90 degrees counter-clockwise.
  Layout rotated() const;
  Layout transposed() const;
  bool has_eightfold_symmetry() const;
  bool operator==(const Layout&) const = default;

 private:
  std::bitset<kPixels> bits_;
};

/// A layout that is invariant under reflections and 90-degree rotations (thesis 2.1): 55 free bits.
/// For r = 0..9, c = r..9 of the upper-left quarter, in that order, bit b = 0..54 is pixel (r, c), bit 0 least
/// significant (docs/FORMATS.md).
class Pattern {
 public:
  Pattern() = default;
  /// Bits above 54 must be zero.
  explicit Pattern(std::uint64_t bits) : bits_(bits) {}
  std::uint64_t bits() const { return bits_; }
  bool rigid(int row, int column) const { return (bits_ >> free_index(row, column)) & 1u; }
  /// Sets pixel (row, column) and all its mirror images.
  void set(int row, int column, bool is_rigid);
  int rigid_count() const;
  double rigid_fraction() const { return rigid_count() / static_cast<double>(kPixels); }
  Layout layout() const;
  /// 14 lower-case hex digits.
  std::string key() const;
  /// Index 0..54 of the free pixel that pixel (row, column) is an image of.
  static int free_index(int row, int column);
  /// How many of the 400 pixels are images of free pixel `index`: 4 on the diagonal, else 8.
  static int orbit_size(int index);
  /// The pattern of a symmetric layout; nothing when the layout lacks the symmetry.
  static std::optional<Pattern> from_layout(const Layout& layout);
  auto operator<=>(const Pattern&) const = default;

 private:
  std::uint64_t bits_ = 0;
};

/// Number of the 400 pixels in which two patterns differ (the L1 distance of Eq. 2.14).
int pixel_difference(const Pattern& a, const Pattern& b);

/// Key of a layout: the pattern's 14 hex digits when it is symmetric, else `L` + 100 hex digits (rows top to bottom,
/// left bit first, so that the first digit's highest bit is pixel (0, 0)).
std::string key_of(const Layout& layout);

/// Reads a key of either kind. The error says what was expected.
Result<Layout> layout_from_key(std::string_view key);

/// 20 lines of 20 characters 0 (soft) or 1 (rigid).
std::string to_text(const Layout& layout);

/// Reads the 20 lines (LF or CRLF, byte-order mark and trailing blank lines allowed). The error names line and column
/// and what was expected; `source` is the name used for the place.
Result<Layout> layout_from_text(std::string_view text, std::string_view source);

}  // namespace nacre::pattern
