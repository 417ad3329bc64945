#pragma once
// How every known effect fared. Two effects of signal-to-noise ratio s and collinearity c are s sqrt((1 - c) / 2)
// apart.

#include <optional>
#include <span>
#include <vector>

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// The smallest strength of an effect at which a `value`, given at some ascending strengths, reaches `wanted`:
/// interpolated between them in log scale, the larger of two where the value at the smaller is 0; empty beyond them.
std::optional<double> smallest_strength(std::span<const double> strengths, const std::vector<double>& value,
                                        double wanted);

/// Every known effect: fitted size and drop, absorption, signal-to-noise ratio at the fitted size where the effect was
/// noticed and at a typical one otherwise (0.3 of its range), and its nearest rival among the effects that act.
std::vector<CandidateEffect> candidates_of(const Evidence& evidence, const Decision& decision);

/// The most specific property that all possible models share.
CommonGround common_ground(const std::vector<std::vector<std::string>>& possible);

}  // namespace nacre::diagnosis
