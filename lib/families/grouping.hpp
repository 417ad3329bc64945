#pragma once
// Which near-Pareto designs belong together (thesis 2.4.1, where a person decides): a proposal, which a person may edit
// (families_file.hpp).

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optimize/pareto.hpp"
#include "pattern/layout.hpp"

namespace nacre::families {

/// A measured pattern.
struct MeasuredPattern {
  pattern::Pattern pattern;
  optimize::Performance performance;
};

/// Similar designs, from which a family grows.
struct SeedFamily {
  std::string name;
  std::vector<pattern::Pattern> seeds;
  bool operator==(const SeedFamily&) const = default;
};

/// Weight of a measured design in the family's own calibration (thesis 2.4.1): 1 for its seeds, 0.1 for others.
double calibration_weight(const SeedFamily& family, const pattern::Pattern& measured);

/// The designs of rank <= maximum_rank, in the order given.
std::vector<MeasuredPattern> near_pareto(std::span<const MeasuredPattern> measured, int maximum_rank = 2);

/// Groups designs by average linkage. The distance of two designs is that of their patterns (earth mover's) plus that
/// of their properties (relative to the range), each over its mean. The number of families, 1 to `largest_count`, is
/// the one whose mean silhouette is largest; one family when none exceeds 0.25, below which groups are chance.
/// Families are named `family-1`, ... by falling modulus of their stiffest member.
std::vector<SeedFamily> proposed_families(std::span<const MeasuredPattern> designs, int largest_count = 6);

}  // namespace nacre::families
