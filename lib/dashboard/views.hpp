#pragma once
// What the page shows, as JSON (docs/FORMATS.md, "Dashboard"). SI units.

#include <nlohmann/json.hpp>

#include "dashboard/desk.hpp"
#include "families/grouping.hpp"
#include "store/run_record.hpp"

namespace nacre::dashboard {

using Json = nlohmann::ordered_json;

/// A value, or null where there is none.
template <typename Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Strains and stresses as two arrays, at most 400 points; null for an empty curve.
Json curve_json(const tester::Curve& curve);

/// Errors of one moment; null when nothing was compared.
Json errors_json(const sysid::PredictionErrors& errors);

/// Per round: standing, errors, model, size of the gamut, proposals, measured front; and every measured pattern.
Json rounds_json(const store::RunRecord& run, const std::map<int, int>& gamut_sizes);

/// All that a run knows of one design: proposals, specimens with curves, what models said, cracks.
Json design_json(const store::RunRecord& run, const pattern::Design& design);

/// Which measured designs belong together, and who says so.
struct Grouping {
  std::vector<families::SeedFamily> families;
  std::vector<pattern::Pattern> near_pareto;  ///< what a person may choose from
  std::string from;                           ///< `file` (families.toml) or `proposal`
  std::string problem;                        ///< why the file is not taken; empty when it is, or when there is none
};

/// The patterns that the run has measured in both tests.
std::vector<families::MeasuredPattern> measured_members(const store::RunRecord& run);

/// Families of the stage after the game with designs, errors of both models and whether they over-fit; and the
/// grouping.
Json families_json(const store::RunRecord& run, const Grouping& grouping);

/// A family's variants as gamut_bytes() takes them.
store::RecordedGamut gamut_of_family(const store::RecordedFamily& family);

/// Specimens, groups of replicates with proposed outliers, orders, proposed designs with their state.
Json laboratory_json(const Laboratory& laboratory);

/// The verdict of a round: from the message where there is one, else from the database; null when there is neither.
Json diagnosis_json(const store::RunRecord& run, const std::optional<diagnosis_t>& message, int round);

/// Nodes with state, progress, time left and counters. `is_over`: the run's last round is closed, so that nobody need
/// speak.
Json nodes_json(const std::vector<NodeReport>& nodes, bool is_over);

}  // namespace nacre::dashboard
