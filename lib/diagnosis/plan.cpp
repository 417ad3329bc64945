#include "diagnosis/plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/result.hpp"
#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/data.hpp"
#include "diagnosis/features.hpp"
#include "diagnosis/possible_tests.hpp"
#include "diagnosis/scatter.hpp"
#include "diagnosis/signatures.hpp"
#include "diagnosis/words.hpp"
#include "material/effect_library.hpp"
#include "measurement/held_strain.hpp"
#include "measurement/pauses.hpp"
#include "tester/modulus.hpp"
#include "tester/tensile.hpp"

namespace nacre::diagnosis {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;

/// Strains along the programme of a planned coupon: one that is held occurs twice, without force none is left.
std::vector<double> planned_strains(const SpecimenRecord& specimen) {
  constexpr int kSteps = 40;
  const tester::Loading pauses = measurement::pauses_of(specimen).value_or(tester::Loading{});
  if (!pauses.has_pauses()) return unload_history();
  std::vector<double> strains = tester::strain_path(pauses, pauses.turns.front() / kSteps);
  const double last = strains.back();
  strains.push_back(last);
  if (pauses.dwell_s)
    for (int i = kSteps - 1; i >= 0; --i) strains.push_back(last * i / kSteps);
  return strains;
}

/// Values for specimens that have none: those of the start parameters.
void fill_in(std::vector<SpecimenRecord>& specimens, const DiagnosisSettings& settings) {
  sysid::LocalSimulator simulator(settings.fidelity, settings.threads, settings.store);
  std::vector<measurement::Replicates> notched;
  std::vector<SpecimenRecord*> of;
  for (SpecimenRecord& specimen : specimens) {
    specimen.valid = true;
    specimen.modulus_pa.reset();
    specimen.toughness_pa.reset();
    if (specimen.test == TestKind::modulus) {
      const auto result =
          tester::test_modulus({specimen.design, settings.start, specimen.conditions, settings.fidelity});
      if (result) specimen.modulus_pa = result->modulus_pa;
    } else if (specimen.test == TestKind::tensile) {
      const std::vector<double> history = specimen.curve.empty() ? planned_strains(specimen) : specimen.curve.strain;
      if (auto curve =
              tester::test_tensile({specimen.design, settings.start, specimen.conditions, settings.fidelity}, history))
        specimen.curve = *std::move(curve);
    } else {
      measurement::Replicates one;
      one.design = specimen.design;
      one.conditions = specimen.conditions;
      notched.push_back(one);
      of.push_back(&specimen);
    }
  }
  if (notched.empty()) return;
  std::vector<std::size_t> items(notched.size());
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = i;
  material::ParameterSet start = settings.start;
  start.extensions.clear();
  const auto predictions = simulator.simulate(notched, {{"planned", start, false, true, items}});
  for (std::size_t i = 0; i < of.size(); ++i) {
    of[i]->toughness_pa = predictions[0][i].toughness_pa;
    of[i]->curve = predictions[0][i].curve;
    of[i]->valid = predictions[0][i].toughness_pa.has_value();
  }
}

/// Behind every name in UTF-8. Groups have the conditions of the first specimen by name among those that differ within
/// the tolerance: that must be one of the set, never one that is only proposed.
constexpr std::string_view kBehindAllNames = "\xff";

SpecimenRecord specimen_of(const PossibleTest& test, int replicate) {
  SpecimenRecord specimen;
  specimen.design = test.design;
  specimen.test = test.test;
  specimen.conditions = test.conditions;
  specimen.specimen = kBehindAllNames;
  specimen.specimen += fmt::format("{} {} {} {} {} {}", test.design.name(), tester::to_string(test.test),
                                   test.conditions.orientation_deg, test.conditions.strain_rate_per_s,
                                   test.conditions.thickness_mm, replicate);
  if (test.pauses.has_pauses()) {
    specimen.other_columns[std::string(measurement::kLoadingColumn)] = tester::to_string(test.pauses);
    specimen.specimen += fmt::format(" held {}", *hold_of(test));
  }
  if (test.surroundings.held) {
    specimen.other_columns[std::string(measurement::kHoldColumn)] = fmt::format("{}", *hold_of(test));
    specimen.specimen += " held";
  }
  return specimen;
}

/// Tests that a person would order together, by the name of their bundle.
std::map<std::string, std::vector<PossibleTest>> bundles(const Observations& observations, const TestRules& rules) {
  std::map<std::string, std::vector<PossibleTest>> result;
  for (const PossibleTest& test : possible_tests(observations, rules)) {
    const bool twin = is_twin(test.way.kind);
    if (is_told_by_modulus(test)) continue;
    auto& tests = result[bundle_in_words(test)];
    if (!twin || tests.size() < static_cast<std::size_t>(rules.bundle)) tests.push_back(test);
  }
  return result;
}

/// The design matrix of the linear model: derivatives of all rows by the base constants (base.jacobian) and signatures
/// of all acting effects, with the covariance of the rows. Every subset of rows is judged by its part of it.
struct DesignMatrix {
  Observations observations;
  Procedure procedure;
  FittedModel base;
  Eigen::MatrixXd covariance;
  std::vector<Signature> signatures = {};
};

/// Base and covariance at the start parameters, with the scatter that is assumed.
DesignMatrix design_matrix_of(const Data& data, const DiagnosisSettings& settings, const AssumedScatter& scatter) {
  Observations observations = data.observations;
  for (ReplicateScatter& each : observations.scatter)
    each.covariance = covariance_of(scatter, settings.procedure.noise);
  const CoordinateMap map = data.model.base_map();
  FittedModel base = linearised(data.model, {}, map.coordinates(settings.start));
  if (settings.floor.mesh_amplitude > 0.0 && observations.has(TestKind::modulus)) {
    observations.discretisation_shared = settings.floor.mesh_amplitude * data.model.mesh_change(map, base.u);
    observations.discretisation_sd = settings.floor.mesh_remainder_sd;
  }
  const Eigen::MatrixXd covariance = observations.covariance();
  return {std::move(observations), settings.procedure, std::move(base), covariance};
}

/// Without a search for the constants: those that are given are the truth.
DiagnosisSettings as_given(DiagnosisSettings settings) {
  settings.search_budget = 0;
  return settings;
}

/// Cuts coupons of both at the end of the shorter curve: how far somebody pulled is no signature of a cause.
void cut_at_common_strain(std::vector<SpecimenRecord>& specimens, std::vector<SpecimenRecord>& changed,
                          const CurveReading& reading) {
  for (std::size_t i = 0; i < std::min(specimens.size(), changed.size()); ++i) {
    tester::Curve &one = specimens[i].curve, &other = changed[i].curve;
    if (specimens[i].test != TestKind::tensile || one.empty() || other.empty() || is_unloaded(one, reading)) continue;
    const double strain = std::min(one.strain.back(), other.strain.back());
    one = tester::cut_at(one, strain);
    other = tester::cut_at(other, strain);
  }
}

/// Signatures of all effects in some rows, whitened and projected off what the base imitates there; zero where the
/// effect would be no candidate on these rows alone.
struct PlannedSignatures {
  std::vector<Eigen::MatrixXd> projected;  ///< rows x TestRules::planned_sizes, per signature
  std::vector<double> absorption;          ///< at a typical size
};

PlannedSignatures planned_signatures_of(const DesignMatrix& matrix, const std::vector<Eigen::Index>& rows) {
  const FittedModel base = matrix.base.restricted(rows);
  const Whitener whitener(matrix.covariance(rows, rows));
  PlannedSignatures planned;
  const TestRules& rules = matrix.procedure.tests;
  const auto sizes = static_cast<Eigen::Index>(rules.planned_sizes.size());
  for (const Signature& signature : matrix.signatures) {
    Eigen::MatrixXd changes = signature.changes(rows, Eigen::seqN(0, sizes));
    const Eigen::VectorXd most = signature.changes.leftCols(sizes).cwiseAbs().rowwise().maxCoeff();
    if (!has_signature(*material::find_effect(signature.effect), most, matrix.observations, rows)) changes.setZero();
    planned.projected.push_back(projected_signatures(base, changes, whitener));
    planned.absorption.push_back(signature_size(base, changes.col(rules.planned_typical), whitener).absorption());
  }
  return planned;
}

/// Effect k as a diagnosis would judge it at every size: signal, distance to the nearest rival of typical size.
PlannedEffect judged(PlannedEffect planned, const DesignMatrix& matrix, const PlannedSignatures& signatures,
                     std::size_t k) {
  const TestRules& rules = matrix.procedure.tests;
  const NameRules& names = matrix.procedure.names;
  std::vector<double> signals, distance;
  for (std::size_t i = 0; i < rules.planned_sizes.size(); ++i) {
    const auto own = signatures.projected[k].col(static_cast<Eigen::Index>(i));
    double nearest = 0.0;
    std::string rival;
    for (std::size_t j = 0; j < signatures.projected.size(); ++j) {
      const auto other = signatures.projected[j].col(rules.planned_typical);
      const double lengths = own.norm() * other.norm();
      if (j == k || lengths < 1e-6) continue;
      const double cosine = std::min(1.0, std::abs(own.dot(other)) / lengths);
      if (cosine > nearest) nearest = cosine, rival = matrix.signatures[j].effect;
    }
    signals.push_back(own.norm());
    distance.push_back(own.norm() * std::sqrt((1.0 - nearest) / 2.0));
    if (i == static_cast<std::size_t>(rules.planned_typical))
      planned.nearest_rival = rival, planned.rival_cosine = nearest;
  }
  planned.absorption = signatures.absorption[k];
  planned.signal_to_noise = signals[rules.planned_typical];
  const material::EffectParameter& parameter = material::find_effect(planned.name)->parameters.front();
  const auto value = [&](const std::optional<double>& strength) {
    return strength ? std::optional(material::value_at_strength(parameter, *strength)) : std::nullopt;
  };
  // As a diagnosis decides: a name needs a signature that no collinear effect imitates.
  const auto nameable = smallest_strength(rules.planned_sizes, signals, names.nameable_signal()),
             apart = smallest_strength(rules.planned_sizes, distance, names.distinct);
  planned.smallest_seen = value(smallest_strength(rules.planned_sizes, signals, names.visible_signal));
  planned.smallest_told_apart = nameable && apart ? value(std::max(*nameable, *apart)) : std::nullopt;
  planned.status = planned.smallest_told_apart ? PlanStatus::told_apart
                   : planned.smallest_seen     ? PlanStatus::visible
                                               : PlanStatus::invisible;
  return planned;
}

/// Every effect, as a diagnosis of these rows alone would judge it.
std::vector<PlannedEffect> judge(const DesignMatrix& matrix, const std::vector<Eigen::Index>& rows) {
  const PlannedSignatures signatures = planned_signatures_of(matrix, rows);
  std::vector<PlannedEffect> effects;
  for (const material::Effect& effect : material::effect_library()) {
    PlannedEffect planned;
    planned.name = effect.name;
    planned.family = effect.family;
    planned.unit = effect.parameters.front().unit;
    const auto found = std::ranges::find(matrix.signatures, effect.name, &Signature::effect);
    const auto k = static_cast<std::size_t>(found - matrix.signatures.begin());
    const bool shown = found != matrix.signatures.end() && signatures.projected[k].norm() >= 1e-6;
    effects.push_back(shown ? judged(std::move(planned), matrix, signatures, k) : std::move(planned));
  }
  return effects;
}

double strength_told_apart(const PlannedEffect& effect) {
  if (!effect.smallest_told_apart) return 1.0;
  return std::clamp(
      material::strength_of(material::find_effect(effect.name)->parameters.front(), *effect.smallest_told_apart), 1e-3,
      1.0);
}

PlannedAddition compare(const std::string& words, const std::vector<PossibleTest>& tests,
                        const std::vector<PlannedEffect>& before, const std::vector<PlannedEffect>& after,
                        const TestRules& rules) {
  PlannedAddition addition;
  addition.words = words;
  addition.replicates = rules.replicates;
  for (const PossibleTest& test : tests) addition.specimens.push_back(specimen_in_words(test));
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double gained = std::log(strength_told_apart(before[k]) / strength_told_apart(after[k]));
    addition.score += std::max(gained, 0.0);
    const bool worth_telling = before[k].status != after[k].status || gained > std::log(rules.worth_telling);
    if (worth_telling)
      addition.changes.push_back({before[k].name, before[k].status, after[k].status, after[k].smallest_told_apart});
  }
  return addition;
}

}  // namespace

std::string_view to_string(PlanStatus status) {
  switch (status) {
    case PlanStatus::told_apart:
      return "told_apart";
    case PlanStatus::visible:
      return "visible";
    case PlanStatus::invisible:
      return "invisible";
    case PlanStatus::not_shown:
      break;
  }
  return "not_shown";
}

Plan plan_diagnosis(std::vector<SpecimenRecord> specimens, const DiagnosisSettings& settings,
                    const AssumedScatter& scatter, bool additions) {
  std::erase_if(specimens, [](const SpecimenRecord& specimen) { return !specimen.valid; });
  fill_in(specimens, settings);
  const TestRules& rules = settings.procedure.tests;
  const Observations alone =
      observe(specimens, settings.floor.log_modulus_sd, settings.fracture_discretisation, settings.procedure);
  const auto added = additions ? bundles(alone, rules) : std::map<std::string, std::vector<PossibleTest>>{};
  std::vector<SpecimenRecord> all = specimens, more;
  for (const auto& [words, tests] : added)
    for (const PossibleTest& test : tests)
      for (int r = 0; r < rules.replicates; ++r) more.push_back(specimen_of(test, r));
  fill_in(more, settings);
  all.insert(all.end(), more.begin(), more.end());
  const Data data = data_of(all, as_given(settings));
  DesignMatrix matrix = design_matrix_of(data, settings, scatter);
  const Observations& observations = matrix.observations;
  matrix.signatures = signatures_on(data.model, matrix.base, data.effects, rules.planned_sizes);

  const auto rows_with = [&](const std::vector<PossibleTest>& tests) {
    const auto is_planned = [&](const Observation& group) {
      return std::ranges::any_of(alone.groups,
                                 [&](const Observation& other) {
                                   return other.design == group.design && other.test == group.test &&
                                          other.conditions == group.conditions && other.unloaded == group.unloaded &&
                                          other.pauses == group.pauses &&
                                          other.surroundings.held == group.surroundings.held;
                                 }) ||
             std::ranges::any_of(tests, [&](const PossibleTest& test) { return would_join(test, group); });
    };
    // Where the other additions alone are homogeneous, nothing ties the constants of layouts to those of coupons.
    const bool has_constants = std::ranges::any_of(observations.groups, [&](const Observation& group) {
      return group.design.mixture() != nullptr && is_planned(group);
    });
    std::vector<Eigen::Index> rows;
    for (int i = 0; i < observations.size(); ++i) {
      const DataRow& row = observations.rows[i];
      const bool counts =
          row.kind == RowKind::constant ? has_constants : row.group < 0 || is_planned(observations.group_of(i));
      if (counts) rows.push_back(i);
    }
    return rows;
  };
  Plan plan;
  plan.specimens = static_cast<int>(specimens.size());
  plan.groups = static_cast<int>(alone.groups.size());
  plan.effects = judge(matrix, rows_with({}));
  for (const auto& [words, tests] : added) {
    PlannedAddition addition = compare(words, tests, plan.effects, judge(matrix, rows_with(tests)), rules);
    if (!addition.changes.empty()) plan.additions.push_back(std::move(addition));
  }
  std::stable_sort(plan.additions.begin(), plan.additions.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return plan;
}

double signal_of_change(std::vector<SpecimenRecord> specimens, std::vector<SpecimenRecord> changed,
                        const DiagnosisSettings& settings, const AssumedScatter& scatter) {
  cut_at_common_strain(specimens, changed, settings.procedure.curves);
  const Data data = data_of(specimens, as_given(settings));
  const DesignMatrix matrix = design_matrix_of(data, settings, scatter);
  const Observations other =
      observe(changed, settings.floor.log_modulus_sd, settings.fracture_discretisation, settings.procedure);
  if (other.size() != matrix.observations.size())
    throw InputError::format("the changed specimens show {} features, expected {}", other.size(),
                             matrix.observations.size());
  return signature_size(matrix.base, other.values - matrix.observations.values, Whitener(matrix.covariance)).projected;
}

}  // namespace nacre::diagnosis
