#pragma once
// Which near-Pareto designs belong together (thesis 2.4.1, where a person decides): a proposal, and the file in which a
// person changes it.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optimize/pareto.hpp"
#include "pattern/layout.hpp"

namespace nacre::families {

/// A measured design.
struct Member {
  pattern::Pattern pattern;
  optimize::Performance performance;
};

/// Designs that resemble one another.
struct Family {
  std::string name;
  std::vector<pattern::Pattern> seeds;
  bool operator==(const Family&) const = default;
};

inline constexpr std::size_t kLongestFamilyName = 64;  ///< bytes

/// Letters, digits, - and _ (folders are named after families), not digits alone: those mean a round.
bool is_family_name(std::string_view name);

/// How much a measured design counts in the family's own calibration (thesis 2.4.1): 1 for its seeds, 0.1 for others.
double calibration_weight(const Family& family, const pattern::Pattern& measured);

/// The designs of rank <= maximum_rank, in the order given.
std::vector<Member> near_pareto(std::span<const Member> measured, int maximum_rank = 2);

/// Groups designs by average linkage. The distance of two designs is that of their patterns (earth mover's) plus that
/// of their properties (relative to the range), each over its mean. The number of families, 1 to `largest_count`, is
/// the one whose mean silhouette is largest; one family when none exceeds 0.25, where groups are no more than chance.
/// Families are named `family-1`, ... by falling modulus of their stiffest member.
std::vector<Family> proposed_families(std::span<const Member> designs, int largest_count = 6);

/// families.toml: `[[family]] name, seeds = ["key", ...]`.
std::string to_toml(const std::vector<Family>& families);
/// Reads it back. Throws InputError naming file, line and what was expected: a name (letters, digits, - and _; each
/// once) and at least one pattern key; a pattern belongs to one family.
std::vector<Family> read_families(const std::filesystem::path& file);
/// The same from text; `source` names the place in errors.
std::vector<Family> parse_families(std::string_view text, const std::string& source);

}  // namespace nacre::families
