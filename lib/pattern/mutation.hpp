#pragma once
// The mutation operator of the exploration (thesis 2.3.3) and its two simpler baselines (3.2.5).

#include <functional>
#include <optional>

#include "base/random.hpp"
#include "pattern/layout.hpp"

namespace nacre::pattern {

/// Kind of a mutation attempt.
enum class MutationKind {
  three_way,    ///< flip a pixel, rewrite a line or rewrite a square
  single_pixel  ///< flip a pixel
};

/// One attempt, mirrored over the whole pattern, constraints not looked at. The result may equal the parent (a line
/// rewritten by its own values). Pixels, line ends and a square's corner are uniform over the 20 x 20 pixels, the size
/// of a square uniform from 1 to the largest that fits.
Pattern mutation_attempt(const Pattern& parent, MutationKind kind, RandomStream& random);

/// Repair rule 1: below 50 % rigid, every pixel is flipped and the four corner pixels are made rigid.
Pattern flipped_if_mostly_soft(const Pattern& pattern);

/// A mutation with repair: attempts, each followed by rule 1, are applied one after another until no constraint is
/// violated. Ends with probability one; from a random feasible parent it takes 1.0 to 1.4 attempts on average, 2.5 at
/// 85 % rigid (measured over 5000 parents; the longest run was 121).
Pattern mutate(const Pattern& parent, MutationKind kind, RandomStream& random);

/// The same, until `acceptable` holds too (for example: not a duplicate). `attempts_left` is counted down; nothing once
/// it is 0.
std::optional<Pattern> mutate_until(const Pattern& parent, MutationKind kind, RandomStream& random,
                                    const std::function<bool(const Pattern&)>& acceptable, int& attempts_left);

/// One attempt followed by rule 1, or nothing when the result violates a constraint: the attempt is rolled back.
/// Repeated on the same parent this never leaves the parent's neighbourhood (baseline 2).
std::optional<Pattern> mutate_or_roll_back(const Pattern& parent, MutationKind kind, RandomStream& random);

}  // namespace nacre::pattern
