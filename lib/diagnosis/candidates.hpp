#pragma once
// Thresholds of a name, and how every known effect fared. Two effects of signal-to-noise ratio s and collinearity c are
// s sqrt((1 - c) / 2) apart.

#include <optional>
#include <span>
#include <vector>

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// Signal-to-noise ratio below which one effect cannot be distinguished from none with 5 % error, and distance from
/// which two are distinguished.
inline constexpr double kVisibleSignal = 3.8, kToldApart = 2.2;
/// Share of the named effect's signal that is left after a collinear effect of another family is projected off,
/// sqrt(1 - 0.8^2): collinearities of up to 0.76 were observed between effects of different families. The rest is
/// visible from a signal-to-noise ratio of 6.3 on: below it no name is given.
inline constexpr double kLeftByCollinearEffect = 0.6, kNameableSignal = kVisibleSignal / kLeftByCollinearEffect;
/// A rival leaves the set only when data from it would so seldom resemble ours.
inline constexpr double kExclusionLevel = 0.005;
/// By how much -2 log likelihood with each model's own discretisation error must be larger for a rival to leave when
/// draws exclude it too: a Bayes factor of 200, as the exclusion level of the draws; and when they do not: out even if
/// specimens scattered 1.7 times as much as replicates say.
inline constexpr double kOwnLead = 10.6, kCertainLead = 3.0 * kOwnLead;
/// In chi squared: by how much the strongest contrast may explain more than a named effect, the size of a tie under
/// noise and rounding; and by how much an effect must beat one factor on all specimens of a condition
/// (even_directions()).
/// Where the factor is true the lead is normal with mean -d^2 and deviation 2 d, d the distance between the two; at the
/// worst d chance reaches 7.6 in 0.3 % of sets, the level of a name (docs/decisions/0022).
inline constexpr double kContrastTie = 2.0, kEvenLead = 7.6;

/// The smallest strength of an effect at which a `value`, given at some ascending strengths, reaches `wanted`:
/// interpolated between them in log scale, the larger of two where the value at the smaller is 0; empty beyond them.
std::optional<double> smallest_strength(std::span<const double> strengths, const std::vector<double>& value,
                                        double wanted);

/// Every known effect: fitted size and drop, absorption, signal-to-noise ratio at the fitted size where the effect was
/// noticed and at a typical one otherwise (0.3 of its range), and its nearest rival among the effects that act.
std::vector<CandidateEffect> candidates_of(const Evidence& evidence, const Decision& decision);

/// The most specific property that all possible models share: an effect, a family, the material or measurement side;
/// empty: none.
std::string common_ground(const std::vector<std::vector<std::string>>& possible);

}  // namespace nacre::diagnosis
