#pragma once
// The families of a run, as JSON: results of the family stage, and how designs are grouped now.

#include <string>
#include <vector>

#include "dashboard/json_parts.hpp"
#include "families/grouping.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// Which measured designs belong together, and where the grouping comes from.
struct Grouping {
  std::vector<families::SeedFamily> families;
  std::vector<pattern::Pattern> near_pareto;  ///< what a person may choose from
  std::string from;                           ///< `file` (families.toml) or `proposal`
  std::string problem;                        ///< why the file is not used; empty when it is, or when there is none
};

/// The patterns that the run has measured in both tests.
std::vector<families::MeasuredPattern> measured_members(const run::RunRecord& run);

/// Families of the stage after the game with designs, errors of both models and whether they over-fit; and the
/// grouping.
Json families_json(const run::RunRecord& run, const Grouping& grouping);

}  // namespace nacre::dashboard
