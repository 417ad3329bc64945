#include "diagnosis/words.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/counted.hpp"
#include "diagnosis/factors.hpp"
#include "diagnosis/gain_words.hpp"
#include "material/effect_words.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {
namespace {

/// "0.5 pixels (90 % interval 0.45 to 0.55)"
std::string with_interval(const FittedNumber& number, std::string_view unit) {
  return fmt::format("{:.3g}{} (90 % interval {:.3g} to {:.3g})", number.value, material::unit_behind_number(unit),
                     number.interval_low, number.interval_high);
}

/// Parameter and further ones: a number of each.
std::vector<FittedNumber> numbers_of(const NamedEffect& e) {
  std::vector<FittedNumber> numbers = {{e.parameter, e.interval_low, e.interval_high}};
  numbers.insert(numbers.end(), e.further.begin(), e.further.end());
  return numbers;
}

/// "a compliance of the machine "old" = 1e-10 1/Pa (90 % interval ...) beyond that of "new"".
std::string machine_in_words(const NamedEffect& e, std::size_t k, const std::string& first) {
  const FittedNumber number = numbers_of(e)[k];
  const std::string& machine = e.each[k];
  if (e.name == "gain_of_one_machine")
    return fmt::format("a gain of the machine \"{}\", which reads {} times as much as \"{}\"", machine,
                       with_interval({1.0 + number.value, 1.0 + number.interval_low, 1.0 + number.interval_high}, "1"),
                       first);
  const bool is_second = number.value > 0.0;
  const auto [low, high] = std::minmax({std::abs(number.interval_low), std::abs(number.interval_high)});
  return fmt::format("a compliance of the machine \"{}\" = {} beyond that of \"{}\"", is_second ? machine : first,
                     with_interval({std::abs(number.value), low, high}, e.unit), is_second ? first : machine);
}

/// A number for each machine but the first, or for each material.
std::string each_in_words(const NamedEffect& e, const std::vector<std::string>& machines) {
  const bool are_machines = material::find_effect(e.name)->one_for_each == "machine";
  const std::string first = machines.size() > e.each.size() ? machines.front() : "not noted";
  std::vector<std::string> words;
  for (std::size_t k = 0; k < e.each.size(); ++k)
    words.push_back(are_machines ? machine_in_words(e, k, first)
                                 : fmt::format("{} of {} = {}", material::effect_in_words(e.name), e.each[k],
                                               with_interval(numbers_of(e)[k], e.unit)));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// "droplet mixing = 0.5 pixels (90 % interval 0.45 to 0.55)", and the further parameters of an effect.
std::string size_in_words(const NamedEffect& e, const std::vector<std::string>& machines) {
  const material::Effect& effect = *material::find_effect(e.name);
  if (!e.each.empty()) return each_in_words(e, machines);
  if (!e.derived.empty()) {
    std::vector<std::string> told;
    for (std::size_t p = 0; p < e.derived.size(); ++p)
      if (const material::DerivedNumber& derived = effect.derived[p]; is_told(e.derived[p], derived))
        told.push_back(fmt::format("{} {}", derived.meaning, with_interval(e.derived[p], derived.unit)));
    return fmt::format("{}, {}", material::effect_in_words(e.name), fmt::join(told, ", "));
  }
  std::string words = fmt::format("{} = {}", material::effect_in_words(e.name),
                                  with_interval({e.parameter, e.interval_low, e.interval_high}, e.unit));
  const auto& numbers = effect.parameters;
  for (std::size_t p = 0; p < e.further.size(); ++p)
    words += fmt::format(", {} {}", numbers[p + 1].meaning, with_interval(e.further[p], numbers[p + 1].unit));
  return words;
}

/// Both readings of a constant that layouts want otherwise than its own specimens; empty where the strongest contrast
/// is of another kind.
std::string constants_in_words(const Diagnosis& d) {
  const std::optional<int> material = d.contrasts.front().view.material;
  if (!material || !d.base_fit.modulus || !d.base_fit.coupon) return "";
  const double in_layouts_pa = to_vector(*d.base_fit.modulus)[*material],
               in_coupons_pa = to_vector(*d.base_fit.coupon)[*material];
  return fmt::format(
      " The base fits best with an E of the {} material of {:.3g} Pa in layouts, {:.2f} times that of its own "
      "specimens: the model lacks an effect, or printing inside a layout changes the material (thesis 3.2.4).",
      kConstantMaterials[*material], in_layouts_pa, in_layouts_pa / in_coupons_pa);
}

/// Behind "comes nearest, but": why the nearest effects have no name.
std::string objection_in_words(const Finding& finding) {
  switch (finding.reason) {
    case Reason::weak_signal:
      return fmt::format(
          "{} has a signal-to-noise ratio of only {:.1f}: an unmodelled cause could look the same (a name needs "
          "{:.1f}, "
          "more replicates raise the ratio)",
          finding.nearest.size() > 1 ? "the signature of one of them" : "its signature", finding.value, finding.needed);
    case Reason::contrast:
      return fmt::format("the contrast \"{}\" alone explains more: an unmodelled cause acts along it", finding.along);
    case Reason::condition:
      return fmt::format(
          "one factor on all specimens of the same {} explains these data as well: an unmodelled cause may act along "
          "it "
          "(homogeneous coupons of each {} would show which)",
          finding.along, finding.along);
    case Reason::worse_unseen:
      return "designs that were held out of the fit are predicted worse with it than without: what it explains is not "
             "what happens elsewhere";
    default:
      return fmt::format(
          "an unmodelled cause could look the same: data drawn from a discrepancy model, which knows no physics, "
          "favour "
          "a known effect by as much with probability {:.2f} (a name needs {:.2f} or less)",
          finding.value, finding.needed);
  }
}

/// "strain rate and temperature, or of strain rate and machine"
std::string factors_in_words(const std::vector<std::vector<std::string>>& sets) {
  std::vector<std::string> words;
  for (const std::vector<std::string>& factors : sets) words.push_back(fmt::format("{}", fmt::join(factors, " and ")));
  return fmt::format("{}", fmt::join(words, ", or of "));
}

/// "strain of the toe, stress at the peak": each once, whatever the tests
std::string features_in_words(const std::vector<Feature>& features) {
  std::vector<std::string_view> words;
  for (const Feature feature : features)
    if (std::ranges::find(words, in_words(feature)) == words.end()) words.push_back(in_words(feature));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// The step that decided.
std::string reason_in_words(const Diagnosis& d) {
  const Finding& finding = d.finding;
  switch (finding.reason) {
    case Reason::residuals_are_noise:
      return "no known effect improves the fit beyond chance, and the residuals are noise";
    case Reason::no_effect_helps:
      return "the residuals are larger than noise, but no known effect improves the fit beyond chance: an unmodelled "
             "cause acts";
    case Reason::residuals_stay:
      return fmt::format(
          "even with the best one or two known effects ({}, which takes {:.3g} % of chi squared away) the residuals "
          "stay larger than noise: an unmodelled cause, or another form of a known one, acts",
          in_words(finding.nearest), 100.0 * finding.value);
    case Reason::at_bound: {
      const material::Effect& effect = *material::find_effect(finding.nearest.front());
      return fmt::format("{} comes nearest, but its size, {:.3g}{}, is at its bound: one beyond it may be the cause",
                         material::effect_in_words(effect.name), finding.value,
                         material::unit_behind_number(effect.parameters.front().unit));
    }
    case Reason::one_effect:
      return "fitted jointly with the base model, it explains the data";
    case Reason::two_effects:
      return "no single effect explains the data, these together do";
    case Reason::other_material:
      if (!finding.nearest.empty())
        return fmt::format(
            "{} explains these data only with {}, beyond the range of these inks: it is another material, which needs "
            "ranges of its own, or something else is wrong",
            in_words(finding.nearest), in_words(d.untold));
      return fmt::format(
          "the base model fits with {}, beyond the range of these inks: it is another material, which needs ranges of "
          "its own, or an effect is missing",
          in_words(d.untold));
    case Reason::factor:
      return fmt::format("free levels of {} explain these data, and no one law of that is told",
                         factors_in_words(d.factors));
    case Reason::free_form:
      return fmt::format(
          "whatever the law, the data change with the strain rate where all else is equal, and free levels of {} "
          "explain them. This law comes nearest (chance of its misfit {:.3g}); its numbers are means, about which "
          "materials and conditions differ",
          factors_in_words(d.factors), finding.value);
    case Reason::carried_part:
      return fmt::format(
          "it explains the features that carry it ({}). Elsewhere the residuals stay larger than noise, most in {} "
          "({:.1f} standard deviations): something else is wrong there, which this name does not explain",
          features_in_words(finding.carriers), finding.along, finding.value);
    case Reason::nothing_visible:
      return "nothing contradicts the base model, but none of the effects that act on these tests would have been "
             "visible at its usual size";
    case Reason::further_column:
      return fmt::format("the data change with {} beyond chance, which no known effect is about", finding.along);
    case Reason::room_is_left:
      return fmt::format(
          "nothing contradicts the base model, but they leave room for a change of stiffness by {:.0f} % "
          "with the {}",
          100.0 * finding.value, finding.along);
    default:
      return fmt::format("{} comes nearest, but {}", in_words(finding.nearest), objection_in_words(finding));
  }
}

std::string models_in_words(const std::vector<std::vector<std::string>>& models) {
  std::string text;
  for (const auto& effects : models) text += (text.empty() ? "" : ", or ") + in_words(effects);
  return text;
}

/// What else the data depend on: effects were judged where it is equal.
std::string levels_in_words(const Diagnosis& d) {
  if (d.factors.empty()) return "";
  std::vector<std::string> others = without_law(d.factors.front());
  for (const NamedEffect& effect : d.effects) std::erase(others, material::find_effect(effect.name)->law_of);
  if (others.empty()) return "";
  return fmt::format(" The data depend on {} too, and no law of that is told: everything was judged where it is equal.",
                     fmt::join(others, " and "));
}

std::string named_in_words(const Diagnosis& d) {
  std::string text = "The simulation lacks ";
  for (std::size_t i = 0; i < d.effects.size(); ++i)
    text += (i ? " and " : "") + size_in_words(d.effects[i], d.machines);
  text += fmt::format(": {}.", reason_in_words(d));
  if (d.possible.size() > 1)
    text += fmt::format(" Its form is open: {} explain these data equally well.", models_in_words(d.possible));
  if (d.gain) text += " " + gain_in_words(*d.gain) + choice_in_words(*d.gain);
  return text + levels_in_words(d);
}

std::string unexplained_in_words(const Diagnosis& d) {
  const std::string text = fmt::format("The base model misfits, and no cause can be named: {}.", reason_in_words(d));
  if (!lines_up(d))
    return text + fmt::format(" The residuals line up with no contrast beyond chance; the largest are those of {}.",
                              in_words(d.loudest));
  const Contrast& strongest = d.contrasts.front();
  return text +
         fmt::format(" The residuals line up most with: {} ({:.1f} standard deviations).", strongest.name,
                     strongest.statistic) +
         constants_in_words(d);
}

std::string verdict_in_words(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::base_sufficient:
      return fmt::format("The base model is sufficient: {} (chance of a misfit as large: {:.3f}).", reason_in_words(d),
                         d.p_misfit);
    case Verdict::named:
      return named_in_words(d);
    case Verdict::ambiguous:
      if (!d.untold.empty()) return fmt::format("These data cannot tell: {}.", reason_in_words(d));
      return fmt::format(
          "The base model misfits, and these data cannot tell which effect is the cause: {}.{} The next experiments "
          "would separate them.",
          models_in_words(d.possible),
          d.common_ground.kind == CommonGround::Kind::nothing
              ? ""
              : fmt::format(" Common to all of them: {}.", in_words(d.common_ground)));
    case Verdict::insufficient:
      return insufficient_in_words(reason_in_words(d));
    case Verdict::unexplained:
      break;
  }
  return unexplained_in_words(d);
}

std::string other_materials_in_words(const std::vector<OtherMaterial>& materials) {
  std::string text;
  for (const OtherMaterial& other : materials)
    text += fmt::format(
        " E of {}, {:.3g} Pa, lies outside the range of these inks (another material, another state of "
        "it, or an error of the machine): layouts are judged against what was measured.",
        other.by_own_specimens ? fmt::format("the {} specimens", kConstantMaterials[other.material])
                               : fmt::format("{} by its blends", kConstantMaterials[other.material]),
        other.modulus_pa);
  return text;
}

/// Why replicates that do not agree matter, and which they are.
std::string disagreement_in_words(const std::vector<std::string>& out_of_line, Verdict verdict) {
  if (out_of_line.empty()) return "";
  constexpr std::size_t kShown = 3;
  const std::vector<std::string> first(out_of_line.begin(), out_of_line.begin() + std::min(kShown, out_of_line.size()));
  return fmt::format(" Caution: replicates do not agree ({}{}), and one wrong value {}: `nacre review` shows which.",
                     fmt::join(first, ", "), out_of_line.size() > kShown ? ", ..." : "",
                     verdict == Verdict::base_sufficient ? "makes scatter so large that it hides a misfit"
                                                         : "looks like an unmodelled cause");
}

/// The element size is in the noise already, as the discretisation floor; the other choices ought not to matter at all.
std::string discretisation_in_words(const std::vector<SanityCheck>& checks) {
  std::string text;
  for (const SanityCheck& check : checks) {
    if (!check.numerical || check.changed == DiscretisationChange::half_element) continue;
    text += fmt::format(
        " Caution: {} changes the simulated {} by {:.1f} %, more than the data's noise: part of a misfit may be "
        "discretisation error.",
        in_words(check.changed), in_words(check.feature), 100.0 * check.largest);
  }
  return text;
}

std::string batches_in_words(const Diagnosis& d) {
  const bool matter =
      d.verdict == Verdict::unexplained ||
      std::ranges::any_of(d.effects, [](const NamedEffect& effect) { return effect.name == "batch_drift"; });
  if (!matter || d.cautions.disconnected_batches < 2) return "";
  return fmt::format(
      " Caution: the batches fall into {} sets without a common design, so that differences between batches look like "
      "differences between designs: print one design in every batch.",
      d.cautions.disconnected_batches);
}

/// What the strongest contrast cannot be told from.
std::string alike_in_words(const Diagnosis& d) {
  if (d.cautions.alike.empty()) return "";
  return fmt::format(" These data cannot part {} from {}: a specimen under each of both would.",
                     d.contrasts.front().view.against, fmt::join(d.cautions.alike, " and "));
}

/// Why machines that differ get no law.
std::string machines_in_words(const Cautions& cautions) {
  if (cautions.machines_not_compared)
    return " What differs between the machines may be the specimens: no piece and no batch was tested on both, or on "
           "all.";
  if (cautions.rival_laws.empty()) return "";
  std::vector<std::string> laws;
  for (const std::string& law : cautions.rival_laws) laws.push_back(material::effect_in_words(law));
  return fmt::format(" These data cannot part {}: materials of other stiffness under both conditions would.",
                     fmt::join(laws, " from "));
}

std::string bounds_in_words(const Diagnosis& d) {
  const std::vector<ModulusAtBound>& at_bounds = d.cautions.at_bounds;
  if (d.verdict == Verdict::base_sufficient || !d.untold.empty() || at_bounds.empty()) return "";
  return fmt::format(
      " Caution: {} {} at the bound of the search. Are the inks others than the thesis'? They need ranges of their own "
      "(docs/FORMATS.md, \"Reference tables\").",
      in_words(at_bounds), at_bounds.size() == 1 ? "is" : "are");
}

std::string assumption_in_words(const Diagnosis& d) {
  const std::vector<tester::TestKind>& unreplicated = d.cautions.unreplicated;
  if (unreplicated.empty()) return "";
  if (d.cautions.nothing_replicated)
    return fmt::format(
        " There are no replicates: a scatter of {:.3g} % was assumed, and every statement depends on it.",
        100.0 * d.assumed_sd);
  std::string tests;
  for (const tester::TestKind test : unreplicated)
    tests += (tests.empty() ? "" : " and ") + std::string(tester::to_string(test));
  return fmt::format(" Specimens of the {} test have no replicates: a scatter of {:.3g} % was assumed for them.", tests,
                     100.0 * d.assumed_sd);
}

}  // namespace

std::string in_words(const std::vector<std::string>& effects) {
  if (effects.empty()) return "the base model";
  return material::effect_in_words(fmt::format("{}", fmt::join(effects, " with ")));
}

std::string in_words(const std::vector<ModulusAtBound>& moduli) {
  std::vector<std::string> words;
  for (const ModulusAtBound& each : moduli)
    words.push_back(fmt::format("{} = {:.3g} Pa{}", material::modulus_parameter_names()[each.material], each.modulus_pa,
                                each.of_coupons ? " of coupons" : ""));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string_view in_words(DiscretisationChange change) {
  switch (change) {
    case DiscretisationChange::half_time_step:
      return "half the time step";
    case DiscretisationChange::half_rate:
      return "half the simulated rate";
    case DiscretisationChange::doubled_recording:
      return "doubled recording";
    case DiscretisationChange::half_element:
      break;
  }
  return "half the element size";
}

std::string in_words(const CommonGround& ground) {
  switch (ground.kind) {
    case CommonGround::Kind::nothing:
      return "";
    case CommonGround::Kind::effect:
      return "effect " + ground.name;
    case CommonGround::Kind::family:
      return "family " + ground.name;
    case CommonGround::Kind::material_side:
      return "material side";
    case CommonGround::Kind::measurement_side:
      break;
  }
  return "measurement side";
}

std::string in_words(const RowsOf& rows) {
  switch (rows.kind) {
    case RowsOf::Kind::none:
      return "";
    case RowsOf::Kind::constants:
      return "constants of layouts against those of coupons";
    case RowsOf::Kind::moduli:
      return "moduli";
    case RowsOf::Kind::notched:
      return rows.material.empty() ? "notched specimens" : fmt::format("notched {} specimens", rows.material);
    case RowsOf::Kind::coupons:
      break;
  }
  return rows.material.empty() ? "coupons" : rows.material + " coupons";
}

std::string in_words(const ConditionTrend& trend) {
  const std::string of = fmt::format("{} of {}", to_string(trend.quantity), trend.of);
  if (trend.exponent_low != trend.exponent_high)
    return fmt::format("{} goes with the strain rate to the power {:.3g} (90 % interval {:.3g} to {:.3g})", of,
                       trend.exponent, trend.exponent_low, trend.exponent_high);
  return fmt::format("{} is {:.3g} times as large at {} {} as at {} (90 % interval {:.3g} to {:.3g})", of, trend.ratio,
                     trend.condition, trend.to, trend.from, trend.low, trend.high);
}

std::string trends_in_words(const DataSummary& data) {
  if (data.trends.empty()) return "";
  constexpr std::size_t kMost = 3;
  constexpr double kSure = 0.05;
  std::vector<std::string> sure;
  for (const ConditionTrend& trend : data.trends)
    if (trend.chance < kSure && sure.size() < kMost) sure.push_back(in_words(trend));
  if (sure.empty()) return " By themselves the data change with no condition beyond scatter.";
  return fmt::format(" By themselves the data show: {}.", fmt::join(sure, "; "));
}

std::string summary_of(const Diagnosis& d) {
  std::string text = verdict_in_words(d) + other_materials_in_words(d.cautions.other_materials) + alike_in_words(d) +
                     machines_in_words(d.cautions) + disagreement_in_words(d.cautions.out_of_line, d.verdict) +
                     discretisation_in_words(d.sanity) + batches_in_words(d);
  if (d.cautions.replicates_are_equal)
    text +=
        " Caution: replicates agree to a twentieth of a per cent, which no printed specimens do: were their means "
        "typed in for each? Enter the value of every specimen.";
  return text + bounds_in_words(d) + assumption_in_words(d);
}

std::string insufficient_in_words(const std::string& why) { return "These data cannot tell yet: " + why + "."; }

}  // namespace nacre::diagnosis
