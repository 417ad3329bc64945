#include "score.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "laboratory/effect_kinds.hpp"
#include "laboratory/truth.hpp"
#include "material/extensions.hpp"

namespace nacre::blind_trials {
namespace {

/// What people call an effect: all its forms alike.
std::string cause_of(const std::string& effect) {
  const material::Effect* known = material::find_effect(effect);
  return known == nullptr ? effect : std::string(known->cause());
}

std::vector<std::string> causes_of(std::vector<std::string> effects) {
  std::ranges::transform(effects, effects.begin(), cause_of);
  return effects;
}

bool same(std::vector<std::string> a, std::vector<std::string> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

/// "7 of 9 (78 %, 95 %: 45 to 94 %)": Wilson's interval.
std::string rate(int good, int all) {
  if (all == 0) return "none";
  const double n = all, p = good / n, z = 1.96;
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n),
               half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n);
  return fmt::format("{} of {} ({:.0f} %; 95 %: {:.0f} to {:.0f} %)", good, all, 100 * p,
                     100 * std::max(0.0, middle - half), 100 * (middle + half));
}

std::vector<std::string> names_of(const TrialDiagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const FoundEffect& named : diagnosis.named) names.push_back(named.effect);
  return names;
}

/// The named effects, else the verdict.
std::string outcome_of(const Score& score) {
  return score.diagnosis.verdict == "named" ? fmt::format("{}", fmt::join(names_of(score.diagnosis), "+"))
                                            : score.diagnosis.verdict;
}

/// Family of an effect; empty for an unmodelled cause.
std::string_view family_of(const std::string& effect) {
  for (const laboratory::EffectKind& kind : laboratory::effect_kinds()) {
    if (kind.name != effect) continue;
    return kind.in_library ? material::find_effect(effect)->family : kind.family;
  }
  return {};
}

/// The hidden effect that is hardest to see.
SealedEffect faintest(const Score& score) {
  const auto& hidden = score.diagnosis.hidden;
  return hidden.empty() ? SealedEffect{}
                        : *std::min_element(hidden.begin(), hidden.end(),
                                            [](const SealedEffect& a, const SealedEffect& b) { return a.snr < b.snr; });
}

/// The causes that a trial hides. What a rate law hides at several temperatures is a shift of the rate too.
std::vector<std::string> hidden_causes(const BlindTrial& trial) {
  std::vector<std::string> causes = causes_of(trial.hidden);
  if (trial.kind == "warm" && !causes.empty()) causes.emplace_back("temperature_shift");
  return causes;
}

// Which trials a rate is over, and when it is reached in them.
using Condition = std::function<bool(const Score&)>;

Condition of_kind(std::string_view kind) {
  return [kind](const Score& s) { return s.trial.kind == kind; };
}
Condition visible_of_kind(std::string_view kind) {
  return [kind](const Score& s) { return s.trial.kind == kind && faintest(s).snr >= 8.0; };
}
Condition has_verdict(std::string_view verdict) {
  return [verdict](const Score& s) { return s.diagnosis.verdict == verdict; };
}
bool fair(const Score& s) {
  const SealedEffect hidden = faintest(s);
  return s.trial.kind == "effect" && hidden.snr >= 8.0 &&
         hidden.snr * std::sqrt((1.0 - hidden.collinearity) / 2.0) >= 2.2;
}
bool named_rightly(const Score& s) { return s.right_name; }
bool named_wrongly(const Score& s) {
  return s.diagnosis.verdict == "named" && std::ranges::any_of(s.diagnosis.named, [&](const FoundEffect& named) {
           return std::ranges::count(hidden_causes(s.trial), cause_of(named.effect)) == 0;
         });
}
bool named_of_another_family(const Score& s) { return s.diagnosis.verdict == "named" && !s.right_family; }

/// Of homogeneous specimens: a cause that the diagnosis knows, or another form of one.
Condition visible_homogeneous(bool known) {
  return [known](const Score& s) {
    return s.trial.kind == "homogeneous" && !s.trial.hidden.empty() && faintest(s).snr >= 8.0 &&
           (material::find_effect(s.trial.hidden.front()) != nullptr) == known;
  };
}
/// Of a kind of trial some of which hide nothing: these.
Condition null_of_kind(std::string_view kind) {
  return [kind](const Score& s) { return s.trial.kind == kind && s.trial.hidden.empty(); };
}

struct TrialRate {
  std::string_view name;
  Condition over, reached;
  std::string_view aim;
};

std::vector<TrialRate> rates() {
  const Condition in_set = [](const Score& s) { return s.in_set; };
  const Condition right_family = [](const Score& s) { return s.right_family; };
  const Condition right_set = [](const Score& s) { return s.diagnosis.verdict == "ambiguous" && s.in_set; };
  return {
      {"nulls: base sufficient", of_kind("null"), has_verdict("base_sufficient"), ">= 97 %"},
      {"nulls: any name", of_kind("null"), has_verdict("named"), "<= 2 % at the upper bound"},
      {"right single name, SNR >= 8 and distance >= 2.2", fair, named_rightly, ">= 95 %"},
      {"true cause within the set, SNR >= 8", visible_of_kind("effect"), in_set, ">= 99 %"},
      {"confident wrong name, all effects", of_kind("effect"), named_wrongly, ""},
      {"unmodelled cause, SNR >= 8: unexplained", visible_of_kind("outside"), has_verdict("unexplained"), ">= 90 %"},
      {"unmodelled cause, all: unexplained", of_kind("outside"), has_verdict("unexplained"), ""},
      {"unmodelled cause: a name", of_kind("outside"), has_verdict("named"), "<= 3 %"},
      {"evenly along one condition, SNR >= 8: unexplained", visible_of_kind("even"), has_verdict("unexplained"),
       ">= 90 %"},
      {"smooth distortion of the moduli: a name", of_kind("distorted"), has_verdict("named"), "0"},
      {"smooth distortion of the moduli: base sufficient", of_kind("distorted"), has_verdict("base_sufficient"), ""},
      {"evenly along one condition: a name", of_kind("even"), has_verdict("named"), "<= 3 %"},
      {"another form of a known effect: a name of another family", of_kind("form"), named_of_another_family, ""},
      {"another form, SNR >= 8: its family named", visible_of_kind("form"), right_family, ""},
      {"two at once, both SNR >= 8: both named", visible_of_kind("double"), named_rightly, ""},
      {"two at once: a wrong name", of_kind("double"), named_wrongly, ""},
      {"fracture, nothing hidden: base sufficient", null_of_kind("fracture"), has_verdict("base_sufficient"),
       ">= 97 %"},
      {"fracture, nothing hidden: any name", null_of_kind("fracture"), has_verdict("named"), "0"},
      {"fracture, SNR >= 8: right name", visible_of_kind("fracture"), named_rightly, ">= 90 %"},
      {"fracture: a name of another family", of_kind("fracture"), named_of_another_family, "0"},
      {"homogeneous, a known cause, SNR >= 8: right name", visible_homogeneous(true), named_rightly, ">= 95 %"},
      {"homogeneous, another form: a name of another family", visible_homogeneous(false), named_of_another_family, "0"},
      {"homogeneous, nothing hidden: base sufficient", null_of_kind("homogeneous"), has_verdict("base_sufficient"),
       ">= 97 %"},
      {"homogeneous, nothing hidden: any name", null_of_kind("homogeneous"), has_verdict("named"), "0"},
      {"loops of coupons, SNR >= 8: its family named", visible_of_kind("loops"), right_family, ">= 95 %"},
      {"loops of coupons: a name of another family", visible_of_kind("loops"), named_of_another_family, "0"},
      {"loops of coupons, nothing hidden: base sufficient", null_of_kind("loops"), has_verdict("base_sufficient"),
       ">= 97 %"},
      {"two machines, SNR >= 8: right name", visible_of_kind("machines"), named_rightly, ">= 95 %"},
      {"two machines that are alike: base sufficient", null_of_kind("machines"), has_verdict("base_sufficient"),
       ">= 97 %"},
      {"two machines: a wrong name", of_kind("machines"), named_wrongly, "0"},
      {"seven decades of the rate, SNR >= 8: right name", visible_of_kind("spectrum"), named_rightly, ">= 95 %"},
      {"seven decades, nothing hidden: base sufficient", null_of_kind("spectrum"), has_verdict("base_sufficient"),
       ">= 97 %"},
      {"rates at three temperatures, SNR >= 8: rate and shift named", visible_of_kind("warm"), named_rightly,
       ">= 95 %"},
      {"temperatures without effect: base sufficient", null_of_kind("warm"), has_verdict("base_sufficient"), ">= 97 %"},
      {"rates at three temperatures: a wrong name", of_kind("warm"), named_wrongly, "0"},
      {"collinear causes: right single name", of_kind("alike"), named_rightly, ""},
      {"pair: reported as a set", of_kind("pair"), right_set, ">= 95 %"},
      {"pair: resolved by the tests it orders, four at most", of_kind("resolved"), named_rightly, ">= 80 %"},
  };
}

std::string row_of(std::string_view name, const std::string& reached, std::string_view aim) {
  return aim.empty() ? fmt::format("| {} | {} | |\n", name, reached)
                     : fmt::format("| {} | {} | {} |\n", name, reached, aim);
}

std::string rate_table(const std::vector<Score>& scores) {
  std::string text = "| score | reached | aim |\n| --- | --- | --- |\n";
  for (const TrialRate& each : rates()) {
    int all = 0, right = 0;
    for (const Score& s : scores)
      if (each.over(s)) ++all, right += each.reached(s);
    text += row_of(each.name, rate(right, all), each.aim);
  }
  return text;
}

/// Errors of the sizes of rightly named effects.
std::string size_rows(const std::vector<Score>& scores) {
  std::vector<double> errors;
  int covered = 0, sized = 0;
  for (const Score& s : scores) {
    if (s.parameter_error < 0.0) continue;
    ++sized, covered += s.covered;
    if (faintest(s).snr >= 16.0) errors.push_back(s.parameter_error);
  }
  std::sort(errors.begin(), errors.end());
  return row_of("size: median error, SNR >= 16",
                errors.empty() ? "none" : fmt::format("{:.1f} % of {}", 100 * errors[errors.size() / 2], errors.size()),
                "<= 5 %") +
         row_of("size: 90 % intervals hold it", rate(covered, sized), "85 to 95 %");
}

std::string confusion_table(const std::vector<Score>& scores) {
  std::map<std::string, std::map<std::string, int>> confusion;
  std::map<std::string, int> outcomes;
  for (const Score& s : scores) {
    const std::string hidden = s.trial.hidden.empty() ? "nothing" : fmt::format("{}", fmt::join(s.trial.hidden, "+"));
    ++confusion[s.trial.kind + ": " + hidden][outcome_of(s)];
    ++outcomes[outcome_of(s)];
  }
  std::string text = "| hidden |", rule = "\n| --- |";
  for (const auto& [outcome, count] : outcomes) text += fmt::format(" {} |", outcome), rule += " --- |";
  text += rule;
  for (const auto& [hidden, row] : confusion) {
    text += fmt::format("\n| {} |", hidden);
    for (const auto& [outcome, count] : outcomes)
      text += row.contains(outcome) ? fmt::format(" {} |", row.at(outcome)) : " |";
  }
  return text + "\n";
}

std::string trial_table(const std::vector<Score>& scores) {
  std::string text =
      "| trial | SNR | collinearity | ceiling | outcome | set | size error |\n| --- | --- | --- | --- | --- | --- | "
      "--- |\n";
  for (const Score& s : scores) {
    const SealedEffect hidden = faintest(s);
    std::string set;
    for (const auto& model : s.diagnosis.possible)
      set += (set.empty() ? "" : " / ") + fmt::format("{}", fmt::join(model, "+"));
    text += fmt::format("| {} | {:.1f} | {:.2f} | {:.2f} | {} | {} | {} |\n", s.trial.name, hidden.snr,
                        hidden.collinearity, hidden.ceiling, outcome_of(s), set,
                        s.parameter_error < 0.0 ? "" : fmt::format("{:.0f} %", 100 * s.parameter_error));
  }
  return text;
}

}  // namespace

Score score_of(const BlindTrial& trial, const TrialDiagnosis& diagnosis) {
  Score score{trial, diagnosis};
  score.right_name = diagnosis.verdict == "named" && same(causes_of(names_of(diagnosis)), hidden_causes(trial));
  score.in_set = std::any_of(diagnosis.possible.begin(), diagnosis.possible.end(),
                             [&](const auto& model) { return same(causes_of(model), hidden_causes(trial)); });
  if (trial.hidden.empty()) return score;
  score.right_family =
      diagnosis.verdict == "named" && std::ranges::all_of(diagnosis.named, [&](const FoundEffect& named) {
        return material::find_effect(named.effect)->family == family_of(trial.hidden.front());
      });
  // Of homogeneous specimens the first parameter may be that of a phase which none of them holds.
  if (!score.right_name || trial.kind == "homogeneous" || trial.kind == "warm") return score;
  const FoundEffect& named = *std::find_if(diagnosis.named.begin(), diagnosis.named.end(), [&](const FoundEffect& n) {
    return cause_of(n.effect) == cause_of(trial.hidden.front());
  });
  const double size = diagnosis.hidden.front().size;
  score.parameter_error = std::abs(named.size / size - 1.0);
  score.covered = named.low90 <= size && size <= named.high90;
  return score;
}

std::string report_of(const std::vector<Score>& scores) {
  return rate_table(scores) + size_rows(scores) + "\n" + confusion_table(scores) + "\n" + trial_table(scores);
}

}  // namespace nacre::blind_trials
