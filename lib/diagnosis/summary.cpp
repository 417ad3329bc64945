#include "diagnosis/summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "material/effect_words.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {
namespace {

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

/// "droplet mixing = 0.5 pixels (90 % interval 0.45 to 0.55)", and the further parameters of an effect.
std::string size_in_words(const NamedEffect& e) {
  std::string words = fmt::format("{} = {}", material::effect_in_words(e.name),
                                  with_interval({e.parameter, e.interval_low, e.interval_high}, e.unit));
  const auto& numbers = material::find_effect(e.name)->parameters;
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

std::string summary_of(const Diagnosis& d, const Decision& decision, const Levels& levels) {
  switch (d.verdict) {
    case Verdict::base_sufficient:
      return fmt::format("The base model is sufficient: {} (chance of a misfit as large: {:.3f}).", decision.reason,
                         d.p_misfit);
    case Verdict::named: {
      std::string text = "The simulation lacks ";
      for (std::size_t i = 0; i < d.effects.size(); ++i) text += (i ? " and " : "") + size_in_words(d.effects[i]);
      text += fmt::format(": {}.", decision.reason);
      if (d.gain) text += " " + gain_in_words(*d.gain) + choice_in_words(*d.gain);
      return text;
    }
    case Verdict::ambiguous:
      if (!decision.untold.empty()) return fmt::format("These data cannot tell: {}.", decision.reason);
      return fmt::format(
          "The base model misfits, and these data cannot tell which effect is the cause: {}.{} The next experiments "
          "would separate them.",
          names_of(decision.possible),
          d.common_ground.empty() ? "" : fmt::format(" Common to all of them: {}.", d.common_ground));
    case Verdict::unexplained:
      break;
  }
  std::string text = fmt::format("The base model misfits, and no cause can be named: {}.", decision.reason);
  if (lines_up(d, levels)) {
    text += fmt::format(" The residuals line up most with: {} ({:.1f} standard deviations).", d.contrasts.front().name,
                        d.contrasts.front().statistic);
    text += constants_in_words(d);
  } else {
    text +=
        fmt::format(" The residuals line up with no contrast beyond chance; the largest are those of {}.", d.loudest);
  }
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
    return " There are no replicates: a scatter of 2 % was assumed, and every statement depends on it.";
  std::string tests;
  for (const tester::TestKind test : unreplicated)
    tests += (tests.empty() ? "" : " and ") + std::string(tester::to_string(test));
  return fmt::format(" Specimens of the {} test have no replicates: a scatter of 2 % was assumed for them.", tests);
}

}  // namespace

std::string gain_in_words(const Gain& gain) {
  // Errors are of logarithms.
  const double before = 100.0 * std::expm1(gain.held_out_error_before),
               after = 100.0 * std::expm1(gain.held_out_error_after);
  const std::string interval =
      fmt::format("90 % interval {:.0f} to {:.0f} %", 100.0 * gain.interval_low, 100.0 * gain.interval_high);
  const std::string_view designs =
      gain.of_coupons ? "held-out coupons the mean error of slopes and stresses" : "held-out designs the mean error";
  if (gain.interval_low > 0.0)
    return fmt::format("On {} falls from {:.3g} to {:.3g} %, a reduction by {:.0f} % ({}).", designs, before, after,
                       100.0 * gain.relative_reduction, interval);
  if (gain.interval_high < 0.0)
    return fmt::format(
        "Yet on {} grows from {:.3g} to {:.3g} %: the cause is established, its use for predictions is not.", designs,
        before, after);
  return fmt::format(
      "Its gain is not established: on {} is {:.3g} % without it and {:.3g} % with it (reduction {:.0f} %, {}).",
      designs, before, after, 100.0 * gain.relative_reduction, interval);
}

std::string choice_in_words(const Gain& gain) {
  std::string text;
  if (gain.of_coupons) return text;
  for (const FeatureGain& g : gain.features) {
    const bool counts = g.feature == Feature::log_modulus || g.feature == Feature::log_toughness;
    if (!counts || g.ranking.pairs == 0) continue;
    text += fmt::format(" Of {} pairs of designs that differ measurably in {}, ", g.ranking.pairs, in_words(g.feature));
    text += g.ranking.before == g.ranking.after
                ? fmt::format("both models rank {} as measured.", g.ranking.after)
                : fmt::format("the extended model ranks {} as measured, the base model {}.", g.ranking.after,
                              g.ranking.before);
  }
  return text;
}

std::string summary_with_cautions(const Diagnosis& diagnosis, const Decision& decision,
                                  const Observations& observations, const std::vector<ModulusAtBound>& at_bounds,
                                  const std::vector<OtherMaterial>& others, const std::vector<std::string>& out_of_line,
                                  const Procedure& procedure) {
  std::string text = summary_of(diagnosis, decision, procedure.levels) + in_words(others) +
                     disagreement_in_words(out_of_line, diagnosis.verdict);
  for (const SanityCheck& check : diagnosis.sanity) {
    // The element size is in the noise already, as the discretisation floor; the other choices ought not to matter at
    // all.
    if (!check.numerical || check.changed == "half the element size") continue;
    text += fmt::format(
        " Caution: {} changes the simulated {} by {:.1f} %, more than the data's noise: part of a misfit may be "
        "discretisation error.",
        check.changed, in_words(check.feature), 100.0 * check.largest);
  }
  const bool batches_matter = diagnosis.verdict == Verdict::unexplained ||
                              std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                                          [](const NamedEffect& effect) { return effect.name == "batch_drift"; });
  if (batches_matter && observations.disconnected_batches > 1) {
    text += fmt::format(
        " Caution: the batches fall into {} sets without a common design, so that differences between batches look "
        "like "
        "differences between designs: print one design in every batch.",
        observations.disconnected_batches);
  }
  if (diagnosis.noise_known && diagnosis.replicate_sd < procedure.cautions.equal_replicates)
    text +=
        " Caution: replicates agree to a twentieth of a per cent, which no printed specimens do: were their means "
        "typed in for each? Enter the value of every specimen.";
  if (diagnosis.verdict != Verdict::base_sufficient && decision.untold.empty() && !at_bounds.empty()) {
    text += fmt::format(
        " Caution: {} {} at the bound of the search. Are the inks others than the thesis'? They need ranges of their "
        "own "
        "(docs/FORMATS.md, \"Reference tables\").",
        in_words(at_bounds), at_bounds.size() == 1 ? "is" : "are");
  }
  return text + assumption_in_words(observations);
}

}  // namespace nacre::diagnosis
