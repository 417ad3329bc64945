#include "diagnosis/verdict.hpp"

#include <algorithm>

#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/carried_part.hpp"
#include "diagnosis/condition_laws.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/factors.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/name_tests.hpp"
#include "diagnosis/rivals.hpp"
#include "diagnosis/scatter.hpp"
#include "diagnosis/untold_materials.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {
namespace {

Decision unexplained(Decision decision, const std::vector<FittedModel>& tried, Finding finding) {
  decision.verdict = Verdict::unexplained;
  decision.finding = std::move(finding);
  if (!tried.empty()) {
    decision.partial = *std::min_element(tried.begin(), tried.end(),
                                         [](const FittedModel& a, const FittedModel& b) { return a.chi2 < b.chi2; });
  }
  return decision;
}

/// Whether all these models are forms of one effect: the cause is known, its form is open.
bool are_forms_of_one(const std::vector<FittedModel>& models) {
  return std::ranges::all_of(models, [&](const FittedModel& model) {
    return model.effects.size() == 1 && material::find_effect(model.effects.front())->cause() ==
                                            material::find_effect(models.front().effects.front())->cause();
  });
}

/// Names one, or keeps several (`possible` is not empty); none where an unmodelled cause could look the same, or the
/// name predicts designs that it has not seen worse than the base does.
Decision settled(const Evidence& evidence, Decision decision, std::vector<FittedModel> possible, Reason reason) {
  const FittedModel& best = possible.front();
  const NameTests tests = tested_for_a_name(evidence, best);
  decision.p_outside = tests.p_outside;
  if (tests.objection) return unexplained(std::move(decision), possible, *tests.objection);
  const bool one_cause = possible.size() == 1 || are_forms_of_one(possible);
  if (one_cause) {
    decision.gain = gain_of(evidence, best);
    if (decision.gain->interval_high < 0.0)
      return unexplained(std::move(decision), possible, {.reason = Reason::worse_unseen, .nearest = best.effects});
  }
  decision.verdict = one_cause ? Verdict::named : Verdict::ambiguous;
  decision.possible = std::move(possible);
  decision.finding.reason = reason;
  return decision;
}

/// Why an effect whose residuals are noise is not named: it is at its bound.
Finding at_its_bound(const FittedModel& single) {
  return {.reason = Reason::at_bound,
          .nearest = single.effects,
          .value = single.parameters.extensions.at(single.effects.front()).front()};
}

/// Whether an effect of usual size would have been visible on these specimens, by scatter that few replicates tell.
bool something_would_show(const Evidence& evidence) {
  const Procedure& rules = evidence.settings.procedure;
  const Whitener whitener(evidence.observations.covariance());
  return std::ranges::any_of(evidence.base.signatures, [&](const Signature& signature) {
    const Eigen::VectorXd usual = usual_change(signature, rules.fit.typical, evidence.base.fit, whitener);
    const double needed = rules.names.visible_signal * student(dof_behind(evidence.observations, usual));
    return signature_size(evidence.base.fit, usual, whitener).projected >= needed;
  });
}

/// No effect improves the fit beyond chance.
Decision decided_without_effects(const Evidence& evidence, Decision decision) {
  if (evidence.p_misfit < evidence.settings.procedure.levels.unexplained)
    return unexplained(std::move(decision), evidence.singles, {.reason = Reason::no_effect_helps});
  const Change left = largest_change_left(evidence.observations);
  if (!something_would_show(evidence) && left.along.empty()) {
    decision.verdict = Verdict::insufficient;
    decision.finding.reason = Reason::nothing_visible;
    return decision;
  }
  if (left.size > evidence.settings.procedure.levels.matters) {
    decision.verdict = Verdict::insufficient;
    decision.finding = {.reason = Reason::room_is_left, .value = left.size, .along = left.along};
    return decision;
  }
  decision.finding.reason = Reason::residuals_are_noise;
  return decision;
}

Decision decided_among_pairs(const Evidence& evidence, Decision decision) {
  const bool some_pair_fits = std::ranges::any_of(
      evidence.p_pair_fit, [&](double p) { return p >= evidence.settings.procedure.levels.unexplained; });
  std::vector<FittedModel> possible =
      some_pair_fits ? confidence_set(evidence, evidence.pairs, evidence.p_pair_fit) : std::vector<FittedModel>{};
  if (!possible.empty()) return settled(evidence, std::move(decision), std::move(possible), Reason::two_effects);
  std::vector<FittedModel> tried = evidence.singles;
  tried.insert(tried.end(), evidence.pairs.begin(), evidence.pairs.end());
  decision = unexplained(std::move(decision), tried, {.reason = Reason::residuals_stay});
  decision.finding.nearest = decision.partial->effects;
  decision.finding.value = 1.0 - decision.partial->chi2 / evidence.base.fit.chi2;
  return decision;
}

Decision decided_among_effects(const Evidence& evidence, Decision decision) {
  if (!is_noticed(evidence)) return decided_without_effects(evidence, std::move(decision));
  const std::size_t best = best_single(evidence);
  if (evidence.p_fit[best] < evidence.settings.procedure.levels.unexplained)
    return decided_among_pairs(evidence, std::move(decision));
  if (evidence.singles[best].extension_on_bound)
    return unexplained(std::move(decision), {evidence.singles[best]}, at_its_bound(evidence.singles[best]));
  if (evidence.settings.progress) evidence.settings.progress(0.85, "comparing rival effects");
  std::vector<FittedModel> possible = confidence_set(evidence, evidence.singles, evidence.p_fit);
  return settled(evidence, std::move(decision), std::move(possible), Reason::one_effect);
}

/// The name of an effect of the measuring side that explains the part of the data which carries it.
std::optional<Decision> decided_by(const CarriedPart& part, const Evidence& evidence, Decision decision) {
  DiagnosisSettings settings = evidence.settings;
  settings.progress = {};
  Evidence own = gather_evidence(part.data, settings);
  if (own.effects.empty() || !own.factors.empty()) return std::nullopt;
  Decision of_part = decided_among_effects(own, {});
  const std::vector<std::string> name = {part.effect};
  if (of_part.verdict != Verdict::named || of_part.possible.front().effects != name) return std::nullopt;
  const FittedModel& single = *std::ranges::find(evidence.singles, name, &FittedModel::effects);
  const WorstElsewhere worst = worst_elsewhere(evidence.observations, part, single);
  decision.finding = {
      .reason = Reason::carried_part,
      .nearest = name,
      .value = worst.deviations,
      .along = fmt::format("{} of the {} test", in_words(worst.rows.feature), tester::to_string(worst.rows.test))};
  for (const RowClass& rows : part.classes) decision.finding.carriers.push_back(rows.feature);
  decision.verdict = Verdict::named;
  decision.partial.reset();
  decision.p_outside = of_part.p_outside;
  decision.gain = gain_of(evidence, single);
  decision.possible = {single};
  decision.part_fit = of_part.possible.front();
  decision.part = std::make_shared<const Evidence>(std::move(own));
  return decision;
}

/// An effect of the measuring side is named by what carries it whatever misfits elsewhere: by all features that do, or
/// where some of these are spoilt too, by one. The decision as it is where there is none.
Decision decided_by_a_part(const Evidence& evidence, Decision decision) {
  for (const CarriedPart& part : carried_parts(evidence))
    if (std::optional<Decision> named = decided_by(part, evidence, decision)) return *std::move(named);
  return decision;
}

/// Curves of coupons show how a material forgets, at one rate too: a law of that which is none of the library may
/// explain what its effects do not, by itself or beside one of them. The decision as it is where none does.
Decision decided_by_rate_laws(const Evidence& evidence, Decision decision) {
  std::vector<FittedModel> laws = rate_laws_of_curves(evidence);
  if (laws.empty()) return decision;
  decision.partial.reset();
  const Reason reason = laws.front().effects.size() > 1 ? Reason::two_effects : Reason::one_effect;
  return settled(evidence, std::move(decision), std::move(laws), reason);
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

constexpr const char* kPowerLaw = "rate_power_law";

/// Whether some set of factors does without this one, by a factor that has no law. An order or a batch is said to be
/// alike (Cautions::alike), but has a law of its own that was tried.
bool is_explained_without(const std::vector<std::vector<std::string>>& sets, std::string_view name) {
  return std::ranges::any_of(sets, [name](const std::vector<std::string>& set) {
    return !contains(set, name) && std::ranges::any_of(set, is_without_law);
  });
}

/// The law of the strain rate that comes nearest: powers, of which every material at every temperature may have its
/// own, where they act; nothing where no such effect acts.
const FittedModel* nearest_rate_law(const Evidence& evidence) {
  const FittedModel* nearest = nullptr;
  for (const FittedModel& single : evidence.singles) {
    if (single.effects.front() == kPowerLaw) return &single;
    if (have_rate_law(single.effects) && (nearest == nullptr || single.chi2 < nearest->chi2)) nearest = &single;
  }
  return nearest;
}

/// The strain rate as the cause, with the nearest law: exponents of materials and temperatures differ about its own.
Decision named_in_free_form(const Evidence& evidence, const FittedModel& nearest, Decision decision) {
  const Procedure& rules = evidence.settings.procedure;
  const std::vector<std::string>& factors = evidence.factors.front();
  const Observations levelled = with_levels_but_rate(evidence.observations, factors, rules.noise);
  Evidence freed = evidence;
  freed.observations = with_free_exponents(evidence.observations, factors, rules.noise);
  const FittedModel law = fit_model(evidence.model, freed.observations, rules.fit, nearest.effects, nearest.u);
  decision.verdict = Verdict::named;
  decision.partial.reset();
  decision.possible = {law};
  const ExactRefits refits{evidence.model, rules.fit};
  decision.gain = held_out_gain(levelled, evidence.base.fit,
                                {.models = {law}, .observations = &freed.observations, .refits = &refits}, law.effects,
                                rules.gain, evidence.settings.seed);
  decision.freed = std::make_shared<const Evidence>(std::move(freed));
  decision.beside = {factors_but_rate(evidence.observations, factors), true};
  decision.finding = {
      .reason = Reason::free_form, .nearest = law.effects, .value = chance_of_misfit(evidence, nearest)};
  return decision;
}

/// What the factors at work add. The strain rate is a cause by itself, whatever its law, where nothing else explains
/// the data, and none where another factor does as well. Its law is free where none fits, or where it predicts held-out
/// specimens better. A base that needs free levels of a factor is not sufficient.
Decision decided_with_factors(const Evidence& evidence, Decision decision) {
  const bool is_named = decision.verdict == Verdict::named, is_open = decision.verdict == Verdict::unexplained;
  const bool is_of_powers = is_named && decision.possible.front().effects == std::vector<std::string>{kPowerLaw};
  // Of layouts exponents are no material's: a law of the library, or none.
  const bool is_told = contains(told_factors(evidence.factors), kStrainRate) && !has_layouts(evidence.observations);
  const FittedModel* law = nearest_rate_law(evidence);
  if ((is_open || is_of_powers) && is_told && law != nullptr &&
      rises_with_rate(evidence.observations, evidence.factors.front())) {
    Decision free = named_in_free_form(evidence, *law, decision);
    if (is_open || free.gain->held_out_error_after < decision.gain->held_out_error_after) return free;
  }
  const bool is_green = decision.verdict == Verdict::base_sufficient || decision.verdict == Verdict::insufficient;
  const bool is_alias = is_named && have_rate_law(decision.possible.front().effects) &&
                        is_explained_without(evidence.factors, kStrainRate);
  if (!is_green && !is_alias) return decision;
  decision.possible.clear();
  decision.gain.reset();
  decision.verdict = Verdict::unexplained;
  decision.finding = {.reason = Reason::factor};
  return decision;
}

/// Neither green nor named over constants that no ink has, where specimens of these materials would tell.
Decision judged_by_its_materials(const Evidence& evidence, Decision decision) {
  const bool is_named = decision.verdict == Verdict::named;
  if (decision.verdict == Verdict::ambiguous || decision.verdict == Verdict::insufficient) return decision;
  if (decision.part) return decision;  // what misfits elsewhere moves the constants
  decision.untold = is_named ? untold_materials_of(evidence, decision.possible.front()) : untold_materials(evidence);
  if (decision.untold.empty()) return decision;
  decision.finding = {.reason = Reason::other_material};
  decision.partial.reset();
  if (is_named) {
    decision.finding.nearest = decision.possible.front().effects;
    decision.partial = decision.possible.front();
  }
  decision.possible.clear();
  decision.gain.reset();
  decision.verdict = Verdict::ambiguous;
  return decision;
}

}  // namespace

Decision decide(const Evidence& evidence) {
  Decision decision;
  decision.contrasts = judged_contrasts(plain(evidence));
  decision.loudest_part = loudest_part(plain(evidence).base_draws, plain(evidence).base_statistics);
  decision = decided_among_effects(evidence, std::move(decision));
  if (decision.finding.reason == Reason::residuals_stay) decision = decided_by_a_part(evidence, std::move(decision));
  if (decision.verdict == Verdict::unexplained && evidence.factors.empty())
    decision = decided_by_rate_laws(evidence, std::move(decision));
  if (!evidence.factors.empty())
    decision = with_condition_laws(evidence, decided_with_factors(evidence, std::move(decision)));
  return judged_by_its_materials(evidence, std::move(decision));
}

}  // namespace nacre::diagnosis
