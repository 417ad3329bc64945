#include "pattern/mutation.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "pattern/constraints.hpp"
#include "thesis/constants.hpp"

namespace nacre::pattern {
namespace {

struct Pixel {
  int row = 0, column = 0;
};

Pixel random_pixel(RandomStream& random) {
  const int index = random.index(kPixels);
  return {index / kSide, index % kSide};
}

Pattern with_flipped_pixel(Pattern pattern, RandomStream& random) {
  const Pixel pixel = random_pixel(random);
  pattern.set(pixel.row, pixel.column, !pattern.rigid(pixel.row, pixel.column));
  return pattern;
}

/// Bresenham's line: both ends included, one pixel per step along the longer axis.
Pattern with_line(Pattern pattern, RandomStream& random) {
  const Pixel from = random_pixel(random), to = random_pixel(random);
  const bool value = random.index(2) == 1;
  const int rows = std::abs(to.row - from.row), columns = std::abs(to.column - from.column);
  const int row_step = to.row > from.row ? 1 : -1, column_step = to.column > from.column ? 1 : -1;
  Pixel at = from;
  for (int error = columns - rows;;) {
    pattern.set(at.row, at.column, value);
    if (at.row == to.row && at.column == to.column) return pattern;
    const int doubled = 2 * error;
    if (doubled > -rows) {
      error -= rows;
      at.column += column_step;
    }
    if (doubled < columns) {
      error += columns;
      at.row += row_step;
    }
  }
}

Pattern with_square(Pattern pattern, RandomStream& random) {
  const Pixel corner = random_pixel(random);
  const int size = 1 + random.index(kSide - std::max(corner.row, corner.column));
  const bool value = !pattern.rigid(corner.row, corner.column);
  for (int r = corner.row; r < corner.row + size; ++r) {
    for (int c = corner.column; c < corner.column + size; ++c) pattern.set(r, c, value);
  }
  return pattern;
}

}  // namespace

Pattern mutation_attempt(const Pattern& parent, MutationKind kind, RandomStream& random) {
  static_assert(thesis::kPixelMutation + thesis::kLineMutation + thesis::kSquareMutation == 1.0);
  const double way = kind == MutationKind::single_pixel ? 0.0 : random.uniform();
  if (way < thesis::kPixelMutation) return with_flipped_pixel(parent, random);
  if (way < thesis::kPixelMutation + thesis::kLineMutation) return with_line(parent, random);
  return with_square(parent, random);
}

Pattern flipped_if_mostly_soft(const Pattern& pattern) {
  if (pattern.rigid_count() >= kMinimumRigidCount) return pattern;
  Pattern flipped(pattern.bits() ^ kAllFreePixels);
  flipped.set(0, 0, true);
  return flipped;
}

Pattern mutate(const Pattern& parent, MutationKind kind, RandomStream& random) {
  Pattern child = parent;
  do {
    child = flipped_if_mostly_soft(mutation_attempt(child, kind, random));
  } while (!is_feasible(child));
  return child;
}

std::optional<Pattern> mutate_until(const Pattern& parent, MutationKind kind, RandomStream& random,
                                    const std::function<bool(const Pattern&)>& acceptable, int& attempts_left) {
  for (Pattern child = parent; attempts_left > 0;) {
    --attempts_left;
    child = flipped_if_mostly_soft(mutation_attempt(child, kind, random));
    if (is_feasible(child) && acceptable(child)) return child;
  }
  return std::nullopt;
}

std::optional<Pattern> mutate_or_roll_back(const Pattern& parent, MutationKind kind, RandomStream& random) {
  const Pattern child = flipped_if_mostly_soft(mutation_attempt(parent, kind, random));
  if (!is_feasible(child)) return std::nullopt;
  return child;
}

}  // namespace nacre::pattern
