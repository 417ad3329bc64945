#pragma once
// First stage of thesis 2.3.4: samples near the gamut's boundary and above the benchmark lines.

#include <span>
#include <vector>

#include "explore/search.hpp"

namespace nacre::select {

/// Whether no point of the polyline through `benchmark`, in the order given, is at least as good in both properties
/// (l1). Always true without a benchmark; a single point is a polyline, too.
bool above_polyline(const optimize::Performance& performance, std::span<const optimize::Performance> benchmark);

/// Toughness of l2: that of the stiffest sample (the toughest of them where several are). The gamut must not be empty.
double stiffest_sample_toughness_pa(std::span<const explore::Evaluated> gamut);

/// Samples of rank <= maximum_rank within the whole gamut, above l1, not below l2, not among `measured`; each pattern
/// once, in the gamut's order.
std::vector<explore::Evaluated> candidates(std::span<const explore::Evaluated> gamut,
                                           std::span<const pattern::Pattern> measured,
                                           std::span<const optimize::Performance> benchmark, int maximum_rank);

}  // namespace nacre::select
