#include "diagnosis/sanity.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "measurement/consistency.hpp"
#include "measurement/surroundings.hpp"
#include "tester/modulus.hpp"
#include "tester/refinement.hpp"
#include "tester/toughness.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

struct DiscretisationVariant {
  DiscretisationChange changed;
  tester::Discretisation discretisation;
};

std::vector<DiscretisationVariant> variants() {
  using enum DiscretisationChange;
  DiscretisationVariant step{half_time_step, {}}, rate{half_rate, {}}, recording{doubled_recording, {}},
      element{half_element, {}};
  step.discretisation.time_step_scale = 0.5;
  rate.discretisation.rate_scale = 0.5;
  recording.discretisation.recording_scale = 2;
  element.discretisation.refinement = 2;
  return {step, rate, recording, element};
}

/// Upright layouts of one test under the usual conditions: least, middling and most rigid.
std::vector<int> three_groups(const Observations& observations, TestKind test) {
  const tester::TestConditions usual = usual_conditions(observations, test);
  std::vector<int> groups;
  for (std::size_t g = 0; g < observations.groups.size(); ++g) {
    const Observation& group = observations.groups[g];
    if (group.test == test && group.design.layout() && group.conditions == usual) groups.push_back(static_cast<int>(g));
  }
  std::stable_sort(groups.begin(), groups.end(), [&](int a, int b) {
    return observations.groups[a].design.rigid_fraction() < observations.groups[b].design.rigid_fraction();
  });
  if (groups.size() <= 3) return groups;
  return {groups.front(), groups[groups.size() / 2], groups.back()};
}

FeatureValues features_with(const Observation& group, const material::ParameterSet& set, tester::Fidelity fidelity,
                            const DiscretisationVariant& variant, const CurveReading& reading) {
  FeatureValues values;
  const tester::Simulation simulation{group.design, tester::refined(set, variant.discretisation.refinement),
                                      group.conditions, fidelity};
  if (group.test == TestKind::modulus) {
    if (const auto result = tester::test_modulus(simulation, variant.discretisation))
      value_of(values, Feature::log_modulus) = std::log(result->modulus_pa);
  } else if (const auto result = tester::test_toughness(simulation, variant.discretisation)) {
    values = fracture_features(result->curve, reading);
  }
  return values;
}

}  // namespace

std::vector<SanityCheck> check_discretisation(const Observations& observations, const material::ParameterSet& set,
                                              tester::Fidelity fidelity, double numerical) {
  std::vector<DiscretisationVariant> tried = {{{}, {}}};  // as it is, then refined
  for (const DiscretisationVariant& variant : variants()) tried.push_back(variant);
  const Eigen::VectorXd deviations = observations.covariance().diagonal().cwiseSqrt();
  std::vector<SanityCheck> checks;
  for (const auto test : {TestKind::modulus, TestKind::toughness}) {
    const std::vector<int> groups = three_groups(observations, test);
    std::vector<std::vector<FeatureValues>> values(groups.size(), std::vector<FeatureValues>(tried.size()));
    parallel_for(groups.size() * tried.size(), [&](int job) {
      const std::size_t g = static_cast<std::size_t>(job) / tried.size(),
                        v = static_cast<std::size_t>(job) % tried.size();
      // A static test has neither time step nor rate.
      if (test == TestKind::modulus && v != 0 && tried[v].discretisation.refinement == 1) return;
      values[g][v] = features_with(observations.groups[groups[g]], set, fidelity, tried[v], observations.reading);
    });
    for (std::size_t v = 1; v < tried.size(); ++v) {
      for (const Feature feature : {Feature::log_modulus, Feature::log_toughness, Feature::log_peak}) {
        SanityCheck check{tried[v].changed, feature, 0.0, 0.0, false};
        for (std::size_t g = 0; g < groups.size(); ++g) {
          const auto &before = value_of(values[g][0], feature), &after = value_of(values[g][v], feature);
          if (!before || !after) continue;
          check.largest = std::max(check.largest, std::abs(*after - *before));
          for (int i = 0; i < observations.size(); ++i) {
            const DataRow& row = observations.rows[i];
            if (row.group == groups[g] && row.feature == feature)
              check.allowed = std::max(check.allowed, deviations[i]);
          }
        }
        if (check.allowed == 0.0) continue;
        check.numerical = check.largest > numerical * check.allowed;
        checks.push_back(check);
      }
    }
  }
  return checks;
}

std::vector<std::string> groups_out_of_line(const std::vector<measurement::SpecimenRecord>& specimens) {
  // How machines differ is for the diagnosis to say.
  std::map<std::string, std::vector<measurement::SpecimenRecord>> of_machine;
  for (const measurement::SpecimenRecord& specimen : specimens)
    of_machine[measurement::surroundings_of(specimen).machine].push_back(specimen);
  std::vector<std::string> groups;
  for (const auto& [machine, own] : of_machine)
    for (const measurement::ReplicateGroup& group : measurement::review_replicates(own))
      if (!group.proposed.empty() || group.state == measurement::GroupState::inconsistent)
        groups.push_back(fmt::format("{} of {}", tester::to_string(group.test), group.design.name()));
  // One design under several conditions is said once.
  std::set<std::string> said;
  std::erase_if(groups, [&](const std::string& group) { return !said.insert(group).second; });
  return groups;
}

}  // namespace nacre::diagnosis
