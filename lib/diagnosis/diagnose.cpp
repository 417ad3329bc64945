#include "diagnosis/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/result.hpp"
#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/condition_laws.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/effect_size.hpp"
#include "diagnosis/experiments.hpp"
#include "diagnosis/explanations.hpp"
#include "diagnosis/factors.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/other_materials.hpp"
#include "diagnosis/procedure.hpp"
#include "diagnosis/sanity.hpp"
#include "diagnosis/verdict.hpp"
#include "diagnosis/words.hpp"

namespace nacre::diagnosis {
namespace {

/// The specimens of the rows of a part.
RowsOf rows_of(const Observations& observations, std::size_t part) {
  const std::vector<std::size_t> parts = parts_of_rows(observations);
  const auto found = std::ranges::find(parts, part);
  if (found == parts.end()) return {};
  const DataRow& row = observations.rows[found - parts.begin()];
  if (row.kind == RowKind::constant) return {RowsOf::Kind::constants};
  if (row.test == tester::TestKind::modulus) return {RowsOf::Kind::moduli};
  if (row.test == tester::TestKind::toughness)
    return {RowsOf::Kind::notched,
            row.group >= 0 && is_notched_bulk(observations.groups[row.group]) ? "homogeneous" : ""};
  return {RowsOf::Kind::coupons, row.group < 0 ? "" : observations.groups[row.group].material()};
}

std::vector<ResidualRow> residual_rows(const Observations& observations, const FittedModel& base,
                                       const Observations& extending, const FittedModel& extended) {
  // The predictions contain what the rows share, as expected from these residuals.
  const Eigen::VectorXd variances = observations.own_variances();
  const auto with_shared = [](const Observations& own, const FittedModel& fit) -> Eigen::VectorXd {
    std::vector<Eigen::Index> all(own.size());
    std::iota(all.begin(), all.end(), 0);
    return fit.predicted + own.expected_shared(own.values - fit.predicted, all);
  };
  const Eigen::VectorXd by_base = with_shared(observations, base), by_extended = with_shared(extending, extended);
  const std::vector<Descriptor> described = descriptors();
  std::vector<ResidualRow> rows;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.kind != RowKind::mean) continue;
    const Observation& g = observations.group_of(i);
    ResidualRow shown{g.design.name(),
                      g.test,
                      g.conditions,
                      row.feature,
                      row.group,
                      observations.values[i],
                      by_base[i],
                      by_extended[i],
                      std::sqrt(variances[i]),
                      {}};
    for (const Descriptor& descriptor : described) shown.descriptors.push_back(descriptor.of(g));
    rows.push_back(std::move(shown));
  }
  return rows;
}

/// Curves at both fits: fracture tests from the run nearest to the fit, coupons computed.
std::vector<GroupCurves> curves_of(const Data& data, const FittedModel& base, const FittedModel& extended) {
  const Observations& observations = data.observations;
  std::vector<GroupCurves> curves;
  for (std::size_t g = 0; g < observations.groups.size(); ++g) {
    const Observation& group = observations.groups[g];
    if (group.test == tester::TestKind::modulus || group.curve.empty()) continue;
    curves.push_back({group.design.name(), group.test, group.conditions, group.curve,
                      curve_at(data, static_cast<int>(g), base), curve_at(data, static_cast<int>(g), extended)});
  }
  return curves;
}

/// The feature whose scatter is reported, and its test.
std::pair<Feature, tester::TestKind> shown_scatter(const Observations& observations) {
  using tester::TestKind;
  if (observations.has(TestKind::modulus)) return {Feature::log_modulus, TestKind::modulus};
  if (observations.has(TestKind::toughness)) return {Feature::log_toughness, TestKind::toughness};
  return {Feature::log_peak, TestKind::tensile};
}

/// A model fitted to all data at the size of its effect that a part of them told.
FittedModel with_size_of(const Evidence& evidence, const FittedModel& whole, const FittedModel& part) {
  Eigen::VectorXd u = whole.u;
  const Eigen::Index sizes = u.size() - whole.base_count;
  u.tail(sizes) = part.u.tail(sizes);
  std::vector<int> held(sizes);
  std::iota(held.begin(), held.end(), whole.base_count);
  return fit_model(evidence.model, evidence.observations, evidence.settings.procedure.fit, whole.effects, u, held);
}

FittedConstants constants_of(const Evidence& evidence, const FittedModel& fit) {
  const Basis& basis = evidence.model.basis();
  FittedConstants constants;
  if (basis.modulus) constants.modulus = fit.parameters.modulus;
  if (basis.toughness) constants.toughness = fit.parameters.toughness;
  if (basis.coupon) constants.coupon = evidence.model.map(fit.effects).coupon_parameters(fit.u).modulus;
  constants.extensions = fit.parameters.extensions;
  return constants;
}

/// Discretisation error of a modulus along the shared directions, root mean square over the layouts: other rows have
/// none.
double shared_discretisation_sd(const Observations& observations) {
  int moduli = 0;
  for (int row = 0; row < observations.size(); ++row) moduli += is_modulus_of_layout(observations, row) ? 1 : 0;
  return moduli > 0 ? observations.discretisation_shared.norm() / std::sqrt(moduli) : 0.0;
}

/// Verdict, noise of the data, base fit and candidates.
void describe(Diagnosis& diagnosis, const Evidence& evidence, const Decision& decision) {
  const Observations& observations = evidence.observations;
  diagnosis.contrast_level = evidence.settings.procedure.levels.contrast;
  diagnosis.assumed_sd = evidence.settings.procedure.noise.assumed_sd;
  diagnosis.verdict = decision.verdict;
  diagnosis.finding = decision.finding;
  diagnosis.untold = decision.untold;
  diagnosis.factors = evidence.factors;
  diagnosis.machines = observations.machines;
  std::erase(diagnosis.machines, "");  // not noted
  diagnosis.p_misfit = plain(evidence).p_misfit;
  diagnosis.p_outside = decision.p_outside;
  diagnosis.contrasts = decision.contrasts;
  diagnosis.loudest = rows_of(observations, decision.loudest_part);
  const auto [feature, test] = shown_scatter(observations);
  diagnosis.replicate_sd = observations.replicate_sd(feature, test);
  diagnosis.noise_known = observations.replicate_dof(test) > 0;
  diagnosis.discretisation_sd = observations.discretisation_sd;
  diagnosis.discretisation_shared_sd = shared_discretisation_sd(observations);
  diagnosis.base_fit = constants_of(evidence, evidence.base.fit);
  diagnosis.candidates = candidates_of(evidence, decision);
  for (const FittedModel& fit : decision.possible) diagnosis.possible.push_back(fit.effects);
  diagnosis.common_ground = common_ground(diagnosis.possible);
  for (const Descriptor& descriptor : descriptors()) diagnosis.descriptors.push_back(descriptor.name);
}

/// Of the data and their noise.
Cautions cautions_of(const Observations& observations, const Diagnosis& diagnosis, const DiagnosisSettings& settings) {
  Cautions cautions;
  cautions.other_materials = other_materials(observations, settings.ranges, settings.procedure.constants);
  cautions.nothing_replicated = true;
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness, tester::TestKind::tensile}) {
    if (!observations.has(test)) continue;
    if (observations.replicate_dof(test) > 0)
      cautions.nothing_replicated = false;
    else
      cautions.unreplicated.push_back(test);
  }
  cautions.replicates_are_equal =
      diagnosis.noise_known && diagnosis.replicate_sd < settings.procedure.cautions.equal_replicates;
  cautions.disconnected_batches = observations.disconnected_batches;
  return cautions;
}

/// Replicates that differ along a column which no effect is about are no scatter: nothing is green over them.
Decision judged_along_columns(Decision decision, const std::vector<measurement::SpecimenRecord>& specimens,
                              const Procedure& rules) {
  if (decision.verdict != Verdict::base_sufficient && decision.verdict != Verdict::insufficient) return decision;
  const DataSummary data = summary_of_data(specimens, rules.noise);
  const ConditionTrend* trend = trend_along_a_further_column(data, rules.levels.unexplained);
  if (trend == nullptr) return decision;
  decision.verdict = Verdict::unexplained;
  decision.finding = {.reason = Reason::further_column, .along = trend->condition};
  return decision;
}

}  // namespace

Diagnosis diagnose(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings) {
  if (settings.bootstraps * settings.procedure.levels.name < 2.0) {
    throw InputError::format("{} bootstraps cannot reach the level {} of a name, expected at least {:.0f}",
                             settings.bootstraps, settings.procedure.levels.name,
                             std::ceil(2.0 / settings.procedure.levels.name));
  }
  const auto report = [&](double share, std::string_view phase) {
    if (settings.progress) settings.progress(share, phase);
  };
  const Evidence evidence = gather_evidence(data_of(specimens, settings), settings);
  const Observations& observations = evidence.observations;
  const Decision decision = judged_along_columns(decide(evidence), specimens, settings.procedure);

  Diagnosis diagnosis;
  describe(diagnosis, evidence, decision);
  const FittedModel& decided = !decision.possible.empty() ? decision.possible.front()
                               : decision.partial         ? *decision.partial
                                                          : evidence.base.fit;
  const Evidence& extending = decision.freed ? *decision.freed : evidence;
  FittedModel extended = decided;
  if (decision.verdict == Verdict::named) {
    report(0.92, "sizes of the named effects");
    NamedModel named =
        decision.part ? measure_size(*decision.part, *decision.part_fit) : measure_size(extending, decided);
    extended = decision.part ? with_size_of(evidence, decided, named.fit) : std::move(named.fit);
    diagnosis.effects = std::move(named.effects);
  }
  diagnosis.extended_fit = constants_of(evidence, extended);
  diagnosis.residuals = residual_rows(observations, evidence.base.fit, extending.observations, extended);
  diagnosis.curves = curves_of(evidence, evidence.base.fit, extended);
  if (decision.verdict == Verdict::named) diagnosis.gain = decision.gain;
  if (decision.verdict == Verdict::unexplained) diagnosis.partial_gain = gain_of(evidence, decided);
  report(0.95, "choosing the next experiments");
  const CoordinateMap map = evidence.model.map(decided.effects);
  diagnosis.next_experiments =
      next_experiments(evidence, explanations_to_separate(evidence, decision), settings.procedure.tests);
  if (!decision.untold.empty())
    diagnosis.next_experiments =
        specimens_of_materials(observations, decision.untold, settings.procedure.tests.replicates);
  if (evidence.fractures) diagnosis.simulations = evidence.fractures->simulations();
  if (settings.fractures) diagnosis.simulations = settings.fractures->simulations;
  diagnosis.procedure = procedure_hash(settings);
  report(0.98, "discretisation error of three specimens");
  if (settings.check_discretisation)
    diagnosis.sanity = check_discretisation(observations, evidence.base.fit.parameters, settings.fidelity,
                                            settings.procedure.cautions.numerical);
  diagnosis.cautions = cautions_of(observations, diagnosis, settings);
  diagnosis.cautions.at_bounds = map.moduli_at_bounds(decided.u);
  diagnosis.cautions.out_of_line = groups_out_of_line(specimens);
  for (const FittedModel& rival : decision.rivals) diagnosis.cautions.rival_laws.push_back(rival.effects.back());
  const std::vector<std::string> told = told_factors(evidence.factors);
  diagnosis.cautions.machines_not_compared = observations.machines.size() > 1 &&
                                             std::ranges::count(told, "machine") > 0 &&
                                             !machines_are_compared(observations);
  if (lines_up(diagnosis)) diagnosis.cautions.alike = conditions_alike(plain(evidence), diagnosis.contrasts.front());
  diagnosis.summary = summary_of(diagnosis);
  report(1.0, "done");
  return diagnosis;
}

Diagnosis diagnose_or_say_why_not(const std::vector<measurement::SpecimenRecord>& specimens,
                                  const DiagnosisSettings& settings) {
  try {
    return diagnose(specimens, settings);
  } catch (const NothingMeasured& nothing) {
    return insufficient(nothing.what());
  }
}

}  // namespace nacre::diagnosis
