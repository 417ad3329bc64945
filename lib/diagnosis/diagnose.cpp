#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/result.hpp"
#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/effect_size.hpp"
#include "diagnosis/experiments.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/procedure.hpp"
#include "diagnosis/sanity.hpp"
#include "diagnosis/verdict.hpp"
#include "material/effect_words.hpp"

namespace nacre::diagnosis {
namespace {

constexpr int kNextExperiments = 4;

std::string names_of(const std::vector<FittedModel>& fits) {
  std::string text;
  for (const FittedModel& fit : fits) {
    if (!text.empty()) text += ", or ";
    text += in_words(fit.effects);
  }
  return text;
}

/// "0.5 pixels (90 % interval 0.45 to 0.55)"
std::string with_interval(const FittedNumber& number, std::string_view unit) {
  return fmt::format("{:.3g}{} (90 % interval {:.3g} to {:.3g})", number.value, material::unit_behind_number(unit),
                     number.interval_low, number.interval_high);
}

/// "droplet mixing = 0.5 pixels (90 % interval 0.45 to 0.55)", and what an effect takes beside it.
std::string size_in_words(const NamedEffect& e) {
  std::string words = fmt::format("{} = {}", material::effect_in_words(e.name),
                                  with_interval({e.parameter, e.interval_low, e.interval_high}, e.unit));
  const auto& numbers = material::find_effect(e.name)->parameters;
  for (std::size_t p = 0; p < e.further.size(); ++p)
    words += fmt::format(", {} {}", numbers[p + 1].meaning, with_interval(e.further[p], numbers[p + 1].unit));
  return words;
}

std::string summary_of(const Diagnosis& d, const Decision& decision) {
  switch (d.verdict) {
    case Verdict::base_sufficient:
      return fmt::format("Nothing is wrong beyond noise: {} (chance of a misfit as large: {:.3f}).", decision.reason,
                         d.p_misfit);
    case Verdict::named: {
      std::string text = "The simulation lacks ";
      for (std::size_t i = 0; i < d.effects.size(); ++i) text += (i ? " and " : "") + size_in_words(d.effects[i]);
      text += fmt::format(": {}.", decision.reason);
      if (d.gain) text += " " + gain_in_words(*d.gain) + choice_in_words(*d.gain);
      return text;
    }
    case Verdict::ambiguous:
      return fmt::format(
          "Something is wrong, and these data cannot tell which: {}.{} The next experiments would separate them.",
          names_of(decision.possible),
          d.common_ground.empty() ? "" : fmt::format(" Common to all of them: {}.", d.common_ground));
    case Verdict::unexplained:
      break;
  }
  std::string text = fmt::format("Something is wrong, and no cause can be named: {}.", decision.reason);
  if (lines_up(d)) {
    text += fmt::format(" The residuals line up most with: {} ({:.1f} standard deviations).", d.contrasts.front().name,
                        d.contrasts.front().statistic);
  } else {
    text +=
        fmt::format(" The residuals line up with nothing that was looked for; the largest are those of {}.", d.loudest);
  }
  return text;
}

/// Of which specimens the rows of a part are.
std::string specimens_in_words(const Observations& observations, std::size_t part) {
  const std::vector<std::size_t> parts = parts_of_rows(observations);
  const auto found = std::ranges::find(parts, part);
  if (found == parts.end()) return "";
  const Row& row = observations.rows[found - parts.begin()];
  if (row.test == tester::TestKind::modulus) return "moduli";
  if (row.test == tester::TestKind::toughness) return "notched specimens";
  if (row.group < 0) return "coupons";
  return observations.groups[row.group].material() + " coupons";
}

std::vector<ResidualRow> residual_rows(const Observations& observations, const FittedModel& base,
                                       const FittedModel& extended) {
  // What numerics share among rows is in the predictions, as far as these residuals tell it.
  const Eigen::VectorXd variances = observations.own_variances();
  const auto with_discretisation = [&](const FittedModel& fit) -> Eigen::VectorXd {
    std::vector<Eigen::Index> all(observations.size());
    std::iota(all.begin(), all.end(), 0);
    return fit.predicted + observations.shared_discretisation(observations.values - fit.predicted, all);
  };
  const Eigen::VectorXd by_base = with_discretisation(base), by_extended = with_discretisation(extended);
  const std::vector<Descriptor> described = descriptors();
  std::vector<ResidualRow> rows;
  for (int i = 0; i < observations.size(); ++i) {
    const Row& row = observations.rows[i];
    if (row.probe != Probe::mean) continue;
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
std::vector<GroupCurves> curves_of(const Workbench& workbench, const Observations& observations,
                                   const FittedModel& base, const FittedModel& extended) {
  std::vector<GroupCurves> curves;
  for (std::size_t g = 0; g < observations.groups.size(); ++g) {
    const Observation& group = observations.groups[g];
    if (group.test == tester::TestKind::modulus || group.curve.empty()) continue;
    curves.push_back({group.design.name(), group.test, group.conditions, group.curve,
                      workbench.curve_at(static_cast<int>(g), base),
                      workbench.curve_at(static_cast<int>(g), extended)});
  }
  return curves;
}

/// The feature whose scatter is told to a person, and its test.
std::pair<Feature, tester::TestKind> shown_scatter(const Observations& observations) {
  using tester::TestKind;
  if (observations.has(TestKind::modulus)) return {Feature::log_modulus, TestKind::modulus};
  if (observations.has(TestKind::toughness)) return {Feature::log_toughness, TestKind::toughness};
  return {Feature::log_peak, TestKind::tensile};
}

std::vector<tester::TestKind> tests_in(const Observations& observations) {
  std::vector<tester::TestKind> tests;
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness, tester::TestKind::tensile})
    if (observations.has(test)) tests.push_back(test);
  return tests;
}

std::vector<tester::TestKind> tests_without_replicates(const Observations& observations) {
  std::vector<tester::TestKind> tests = tests_in(observations);
  std::erase_if(tests, [&](tester::TestKind test) { return observations.replicate_dof(test) > 0; });
  return tests;
}

std::string assumption_in_words(const Observations& observations) {
  const std::vector<tester::TestKind> unreplicated = tests_without_replicates(observations);
  if (unreplicated.empty()) return "";
  if (unreplicated == tests_in(observations))
    return " There are no replicates: a scatter of 2 % was assumed, and every statement is relative to it.";
  std::string tests;
  for (const tester::TestKind test : unreplicated)
    tests += (tests.empty() ? "" : " and ") + std::string(tester::to_string(test));
  return fmt::format(" Specimens of the {} test have no replicates: a scatter of 2 % was assumed for them.", tests);
}

/// Models that the next test should separate: the rivals left, or what an unexplained misfit comes nearest to.
std::vector<FittedModel> models_to_separate(const Evidence& evidence, const Decision& decision) {
  if (decision.verdict == Verdict::ambiguous) return decision.possible;
  if (decision.verdict == Verdict::named) return {decision.possible.front(), evidence.base.fit};
  if (decision.verdict != Verdict::unexplained) return {};
  std::vector<FittedModel> models = evidence.singles;
  std::stable_sort(models.begin(), models.end(),
                   [](const FittedModel& a, const FittedModel& b) { return a.chi2 < b.chi2; });
  models.resize(std::min<std::size_t>(models.size(), 3));
  models.push_back(evidence.base.fit);
  return models;
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

/// What finer elements change of a modulus along the shared directions, root mean square over the layouts: other rows
/// know nothing of them.
double shared_discretisation_sd(const Observations& observations) {
  int moduli = 0;
  for (int row = 0; row < observations.size(); ++row) moduli += is_modulus_of_layout(observations, row) ? 1 : 0;
  return moduli > 0 ? observations.discretisation_shared.norm() / std::sqrt(moduli) : 0.0;
}

/// What the data are like, and what was tried on them.
void describe(Diagnosis& diagnosis, const Evidence& evidence, const Decision& decision) {
  const Observations& observations = evidence.observations;
  diagnosis.verdict = decision.verdict;
  diagnosis.p_misfit = decision.p_misfit;
  diagnosis.p_outside = decision.p_outside;
  diagnosis.contrasts = decision.contrasts;
  diagnosis.loudest = specimens_in_words(observations, decision.loudest_part);
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

/// The summary, and what a reader must know beside it.
std::string summary_with_cautions(const Diagnosis& diagnosis, const Decision& decision,
                                  const Observations& observations, const std::vector<std::string>& at_an_end,
                                  const std::vector<std::string>& out_of_line) {
  std::string text = summary_of(diagnosis, decision);
  if (!out_of_line.empty()) {
    constexpr std::size_t kShown = 3;
    const std::vector<std::string> first(out_of_line.begin(),
                                         out_of_line.begin() + std::min(kShown, out_of_line.size()));
    text +=
        fmt::format(" Caution: replicates do not agree ({}{}), and one wrong value {}: `nacre review` shows which.",
                    fmt::join(first, ", "), out_of_line.size() > kShown ? ", ..." : "",
                    diagnosis.verdict == Verdict::base_sufficient ? "makes scatter so large that it hides what is off"
                                                                  : "looks like a cause that nobody knows");
  }
  for (const SanityCheck& check : diagnosis.sanity) {
    // Elements are in the noise already, as the floor; the other choices ought not to matter at all.
    if (!check.numerical || check.changed == "half the element size") continue;
    text += fmt::format(" Caution: {} changes the {} by {:.1f} %, more than the data's noise.", check.changed,
                        in_words(check.feature), 100.0 * check.largest);
  }
  const bool batches_matter = diagnosis.verdict == Verdict::unexplained ||
                              std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                                          [](const NamedEffect& effect) { return effect.name == "batch_drift"; });
  if (batches_matter && observations.disconnected_batches > 1) {
    text += fmt::format(
        " Caution: the batches fall into {} sets without a common design, so that what batches add looks like what "
        "designs differ by: print one design in every batch.",
        observations.disconnected_batches);
  }
  constexpr double kNoSpecimensDo = 5e-4;
  if (diagnosis.noise_known && diagnosis.replicate_sd < kNoSpecimensDo)
    text +=
        " Caution: replicates agree to a twentieth of a per cent, which no printed specimens do: were their means "
        "typed in for each?";
  if (diagnosis.verdict != Verdict::base_sufficient && !at_an_end.empty()) {
    text += fmt::format(
        " Caution: {} {} at the end of what was searched. Are the inks others than the thesis'? They need ranges of "
        "their own (docs/FORMATS.md, \"Reference tables\").",
        fmt::join(at_an_end, ", "), at_an_end.size() == 1 ? "stands" : "stand");
  }
  return text + assumption_in_words(observations);
}

}  // namespace

bool lines_up(const Diagnosis& diagnosis) {
  constexpr double kLevel = 0.05;
  return !diagnosis.contrasts.empty() && diagnosis.contrasts.front().p_family_wise <= kLevel;
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::base_sufficient:
      return "base_sufficient";
    case Verdict::named:
      return "named";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::unexplained:
      break;
  }
  return "unexplained";
}

Diagnosis undecided(const std::string& why) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::ambiguous;
  diagnosis.summary = "These data cannot tell yet: " + why + ".";
  return diagnosis;
}

std::string gain_in_words(const Gain& gain) {
  // Errors are of logarithms.
  const double before = 100.0 * std::expm1(gain.held_out_error_before),
               after = 100.0 * std::expm1(gain.held_out_error_after);
  const std::string interval =
      fmt::format("90 % interval {:.0f} to {:.0f} %", 100.0 * gain.interval_low, 100.0 * gain.interval_high);
  const std::string_view designs =
      gain.of_coupons ? "held-out coupons the mean error of slopes and stresses" : "held-out designs the mean error";
  if (gain.interval_low > 0.0)
    return fmt::format("On {} falls from {:.3g} to {:.3g} %, by {:.0f} % of itself ({}).", designs, before, after,
                       100.0 * gain.relative_reduction, interval);
  if (gain.interval_high < 0.0)
    return fmt::format(
        "Yet on {} grows from {:.3g} to {:.3g} %: the cause is established, its use for predictions is not.", designs,
        before, after);
  return fmt::format(
      "What it gains is not established: on {} is {:.3g} % without it and {:.3g} % with it (reduction {:.0f} %, {}).",
      designs, before, after, 100.0 * gain.relative_reduction, interval);
}

std::string choice_in_words(const Gain& gain) {
  std::string text;
  if (gain.of_coupons) return text;
  for (const FeatureGain& g : gain.features) {
    const bool counts = g.feature == Feature::log_modulus || g.feature == Feature::log_toughness;
    if (!counts || g.ranking.pairs == 0) continue;
    text += fmt::format(" Of {} pairs of designs that the measurements tell apart by their {}, ", g.ranking.pairs,
                        in_words(g.feature));
    text += g.ranking.before == g.ranking.after
                ? fmt::format("both models rank {} as measured.", g.ranking.after)
                : fmt::format("the extended model ranks {} as measured, the base model {}.", g.ranking.after,
                              g.ranking.before);
  }
  return text;
}

Diagnosis diagnose(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings) {
  if (settings.bootstraps * settings.name_level < 2.0) {
    throw InputError::format("{} bootstraps cannot reach the level {} of a name, expected at least {:.0f}",
                             settings.bootstraps, settings.name_level, std::ceil(2.0 / settings.name_level));
  }
  const auto report = [&](double share, std::string_view phase) {
    if (settings.progress) settings.progress(share, phase);
  };
  Workbench workbench(specimens, settings);
  Evidence evidence = gather_evidence(workbench, settings);
  const Observations& observations = evidence.observations;
  const Decision decision = decide(evidence);

  Diagnosis diagnosis;
  describe(diagnosis, evidence, decision);
  const FittedModel& decided = !decision.possible.empty() ? decision.possible.front()
                               : decision.partial         ? *decision.partial
                                                          : evidence.base.fit;
  FittedModel extended = decided;
  if (decision.verdict == Verdict::named) {
    report(0.92, "the size of what is named");
    NamedModel named = measure_size(evidence, decided);
    extended = std::move(named.fit);
    diagnosis.effects = std::move(named.effects);
  }
  diagnosis.extended_fit = constants_of(evidence, extended);
  diagnosis.residuals = residual_rows(observations, evidence.base.fit, extended);
  diagnosis.curves = curves_of(workbench, observations, evidence.base.fit, extended);
  if (decision.verdict == Verdict::named || decision.verdict == Verdict::unexplained) {
    std::vector<FittedModel> models = evidence.singles;
    // As it was decided, sizes free: folds must not know a size that all the data told.
    if (decided.effects.size() > 1) models.push_back(decided);
    const Gain gain =
        held_out_gain(observations, evidence.base.fit, models, decided.effects, drop_needed(evidence), settings.seed);
    // What the nearest effect gains where none is named is a partial gain, and said to be one.
    (decision.verdict == Verdict::named ? diagnosis.gain : diagnosis.partial_gain) = gain;
  }
  report(0.95, "choosing the next experiments");
  diagnosis.next_experiments = next_experiments(evidence, models_to_separate(evidence, decision), kNextExperiments);
  if (workbench.runs()) diagnosis.simulations = workbench.runs()->simulations();
  diagnosis.procedure = procedure_hash(settings);
  report(0.98, "other numerics on three specimens");
  if (settings.check_discretisation)
    diagnosis.sanity = check_discretisation(observations, evidence.base.fit.parameters, settings.fidelity);
  const CoordinateMap map(evidence.model.basis(), decided.effects);
  diagnosis.summary = summary_with_cautions(diagnosis, decision, observations, map.moduli_at_an_end(decided.u),
                                            groups_out_of_line(specimens));
  report(1.0, "done");
  return diagnosis;
}

}  // namespace nacre::diagnosis
