#pragma once
// Layouts without the symmetry of patterns, for verification and for tests that discriminate between causes.

#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "pattern/design.hpp"
#include "pattern/layout.hpp"

namespace nacre::pattern {

/// Which way the layers of a laminate run: along_x across the pull (loaded in series), along_y with the pull (in
/// parallel).
enum class LayerDirection { along_x, along_y };

/// Layers of `rigid_pixels` and `soft_pixels` in turn, rigid first (from the top, or from the left). Throws InputError
/// unless both are at least 1 and their sum divides 20, so that the layers also alternate across the edges of the unit.
Layout laminate(LayerDirection direction, int rigid_pixels, int soft_pixels);

/// Squares of `period` pixels, the one in the upper left corner rigid. Throws InputError unless period is 1, 2, 5
/// or 10.
Layout checkerboard(int period);

/// Reads `checkerboard:PERIOD` or `laminate:x:RIGID:SOFT` (or `:y:`), numbers in pixels; nothing when `name` begins
/// with neither word. The error says what was expected.
std::optional<Result<Layout>> coupon_from_name(std::string_view name);

/// The name of a layout that is one of these coupons.
std::optional<std::string> coupon_name(const Layout& layout);

/// A name for people: `checkerboard:2`, `laminate:x:3:2`, otherwise the design's own.
std::string readable_name(const Design& design);

}  // namespace nacre::pattern
