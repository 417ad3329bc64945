#pragma once

#include <optional>
#include <span>
#include <vector>

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// Signal-to-noise below which one effect cannot be told from none with 5 % error, and distance from which two are told
/// apart.
inline constexpr double kVisibleSignal = 3.8, kToldApart = 2.2;
/// What a cause of another kind that looks like the named one leaves of its signal, sqrt(1 - 0.8^2): cosines of up to
/// 0.76 were seen between effects of different families. That is noticed from a signal-to-noise of 6.3 on: below it no
/// name is given.
inline constexpr double kLeftByLookalike = 0.6, kNameableSignal = kVisibleSignal / kLeftByLookalike;
/// A rival leaves the set only when data from it would so seldom look like ours.
inline constexpr double kExclusionLevel = 0.005;
/// By how much -2 log likelihood with each model's own numerics must be larger for a rival to leave when draws exclude
/// it too: odds of one to 200, as the exclusion level of the draws has it; and when they do not: out even if specimens
/// scattered 1.7 times as much as replicates say.
inline constexpr double kOwnLead = 10.6, kCertainLead = 3.0 * kOwnLead;
/// In chi squared: by how much the strongest contrast may explain more than a named effect, what noise and rounding
/// make of a tie; and by how much an effect must beat one factor on all specimens of a condition (even_directions()).
/// Where the factor is true the lead is normal with mean -d^2 and deviation 2 d, d the distance between the two; at the
/// worst d chance reaches 7.6 in 0.3 % of sets, the level of a name (docs/decisions/0022).
inline constexpr double kContrastTie = 2.0, kEvenLead = 7.6;

/// The smallest strength of an effect at which what is `judged` at some ascending ones reaches `wanted`: between them
/// in log scale, the larger of two where the smaller leaves nothing; nothing beyond them.
std::optional<double> smallest_strength(std::span<const double> strengths, const std::vector<double>& judged,
                                        double wanted);

/// What became of every effect of the library: fitted size and drop, absorption, signal-to-noise at the fitted size
/// where it was noticed and at a typical one otherwise (0.3 of its range), and its nearest rival among the effects that
/// act.
std::vector<CandidateEffect> candidates_of(const Evidence& evidence, const Decision& decision);

/// The finest thing that all possible models share: an effect, a family, the material or measurement side; empty:
/// nothing.
std::string common_ground(const std::vector<std::vector<std::string>>& possible);

}  // namespace nacre::diagnosis
