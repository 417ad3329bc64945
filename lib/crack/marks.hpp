#pragma once
// Place and time of each toughening mechanism in a specimen, for films.

#include <string_view>
#include <vector>

#include "crack/crack_record.hpp"

namespace nacre::crack {

enum class MarkKind { deflection, branching, bridging, soft_arrest, guidance };
inline constexpr int kMarkKinds = 5;
std::string_view to_string(MarkKind kind);

struct Mark {
  MarkKind kind = MarkKind::deflection;
  int element = 0;            ///< in the middle of the mechanism
  double strain = 0.0;        ///< shown from here on
  double until_strain = 0.0;  ///< and up to here; infinity: to the end
  bool operator==(const Mark&) const = default;
};

/// Smallest deviation of the path from its height (elements; two pixels) that is marked as deflection.
inline constexpr int kSmallestDeflectionElements = 4;
/// Shortest arrest that is marked, as a share of the strain between the path's first and last failure.
inline constexpr double kShortestArrest = 0.05;
/// Fewest consecutive elements of the path in soft material or interfaces that are marked as guided (three pixels).
inline constexpr int kShortestGuidedRun = 6;

/// Marks of a crack in the notched specimen as it was before the test: deflection, where the path is farthest above or
/// below its beginning; branching, at the tip of each branch; bridging, in the middle of each intact ligament in
/// the path; arrest, where the tip waits in front of soft material, while it waits; guidance, in the middle of each
/// guided stretch. By kind, along the path. None without a path. The strains are those of record.order.
std::vector<Mark> marks_of(const fem::Grid& notched, const CrackRecord& record);

/// The tip of each branch of a record, longest first: record.branches of them.
std::vector<int> branch_tips(const fem::Grid& notched, const CrackRecord& record);

}  // namespace nacre::crack
