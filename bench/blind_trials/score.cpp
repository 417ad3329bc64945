#include "score.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "material/extensions.hpp"
#include "virtual_lab/truth.hpp"

namespace nacre::blind_trials {
namespace {

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

std::vector<std::string> names_of(const Answer& answer) {
  std::vector<std::string> names;
  for (const Named& named : answer.named) names.push_back(named.effect);
  return names;
}

std::string answer_of(const Score& score) {
  return score.answer.verdict == "named" ? fmt::format("{}", fmt::join(names_of(score.answer), "+"))
                                         : score.answer.verdict;
}

/// Of the library; empty for what is of none.
std::string_view family_of(const std::string& effect) {
  for (const virtual_laboratory::EffectKind& kind : virtual_laboratory::effect_kinds()) {
    if (kind.name != effect) continue;
    return kind.in_library ? material::find_effect(effect)->family : kind.family;
  }
  return {};
}

/// The hidden effect that is hardest to see.
Hidden faintest(const Score& score) {
  const auto& hidden = score.answer.hidden;
  return hidden.empty() ? Hidden{}
                        : *std::min_element(hidden.begin(), hidden.end(),
                                            [](const Hidden& a, const Hidden& b) { return a.s < b.s; });
}

template <class Wanted, class Good>
std::string rate_over(const std::vector<Score>& scores, Wanted wanted, Good good) {
  int all = 0, right = 0;
  for (const Score& s : scores)
    if (wanted(s)) ++all, right += good(s);
  return rate(right, all);
}

}  // namespace

Score score_of(const Trial& trial, const Answer& answer) {
  Score score{trial, answer};
  score.right_name = answer.verdict == "named" && same(names_of(answer), trial.hidden);
  score.in_set = std::any_of(answer.possible.begin(), answer.possible.end(),
                             [&](const auto& model) { return same(model, trial.hidden); });
  if (trial.hidden.empty()) return score;
  score.right_family = answer.verdict == "named" && std::ranges::all_of(answer.named, [&](const Named& named) {
                         return material::find_effect(named.effect)->family == family_of(trial.hidden.front());
                       });
  if (!score.right_name) return score;
  const Named& named = *std::find_if(answer.named.begin(), answer.named.end(),
                                     [&](const Named& n) { return n.effect == trial.hidden.front(); });
  const double size = answer.hidden.front().size;
  score.parameter_error = std::abs(named.size / size - 1.0);
  score.covered = named.low90 <= size && size <= named.high90;
  return score;
}

std::string report_of(const std::vector<Score>& scores) {
  const auto kind = [](const char* name) { return [name](const Score& s) { return s.trial.kind == name; }; };
  const auto fair = [](const Score& s) {
    return s.trial.kind == "effect" && faintest(s).s >= 8.0 &&
           faintest(s).s * std::sqrt((1.0 - faintest(s).rho) / 2.0) >= 2.2;
  };
  const auto visible = [](const Score& s) { return s.trial.kind == "effect" && faintest(s).s >= 8.0; };
  const auto wrong_name = [](const Score& s) {
    const auto names = names_of(s.answer);
    return s.answer.verdict == "named" && std::any_of(names.begin(), names.end(), [&](const auto& name) {
             return std::find(s.trial.hidden.begin(), s.trial.hidden.end(), name) == s.trial.hidden.end();
           });
  };
  std::string text = "| score | reached | aim |\n| --- | --- | --- |\n";
  text += fmt::format(
      "| nulls: base sufficient | {} | >= 97 % |\n",
      rate_over(scores, kind("null"), [](const Score& s) { return s.answer.verdict == "base_sufficient"; }));
  text += fmt::format("| nulls: any name | {} | <= 2 % at the upper bound |\n",
                      rate_over(scores, kind("null"), [](const Score& s) { return s.answer.verdict == "named"; }));
  text += fmt::format("| right single name, s >= 8 and distance >= 2.2 | {} | >= 95 % |\n",
                      rate_over(scores, fair, [](const Score& s) { return s.right_name; }));
  text += fmt::format("| true cause within the set, s >= 8 | {} | >= 99 % |\n",
                      rate_over(scores, visible, [](const Score& s) { return s.in_set; }));
  text += fmt::format("| confident wrong name, all effects | {} | |\n", rate_over(scores, kind("effect"), wrong_name));
  const auto is_unexplained = [](const Score& s) { return s.answer.verdict == "unexplained"; };
  text += fmt::format(
      "| out of library, s >= 8: unexplained | {} | >= 90 % |\n",
      rate_over(
          scores, [](const Score& s) { return s.trial.kind == "outside" && faintest(s).s >= 8.0; }, is_unexplained));
  text +=
      fmt::format("| out of library, all: unexplained | {} | |\n", rate_over(scores, kind("outside"), is_unexplained));
  text += fmt::format("| out of library: a name | {} | <= 3 % |\n",
                      rate_over(scores, kind("outside"), [](const Score& s) { return s.answer.verdict == "named"; }));
  text += fmt::format(
      "| another form of a library effect: a name of another family | {} | |\n",
      rate_over(scores, kind("form"), [](const Score& s) { return s.answer.verdict == "named" && !s.right_family; }));
  text += fmt::format("| another form, s >= 8: its family named | {} | |\n",
                      rate_over(
                          scores, [](const Score& s) { return s.trial.kind == "form" && faintest(s).s >= 8.0; },
                          [&](const Score& s) { return s.right_family; }));
  const auto both_visible = [](const Score& s) { return s.trial.kind == "double" && faintest(s).s >= 8.0; };
  text += fmt::format("| two at once, both s >= 8: both named | {} | |\n",
                      rate_over(scores, both_visible, [](const Score& s) { return s.right_name; }));
  text += fmt::format("| two at once: a wrong name | {} | |\n", rate_over(scores, kind("double"), wrong_name));
  text += fmt::format("| alike: right single name | {} | |\n",
                      rate_over(scores, kind("alike"), [](const Score& s) { return s.right_name; }));
  text += fmt::format(
      "| pair: reported as a set | {} | >= 95 % |\n",
      rate_over(scores, kind("pair"), [](const Score& s) { return s.answer.verdict == "ambiguous" && s.in_set; }));
  text += fmt::format("| pair: resolved by the tests it orders, four at most | {} | >= 80 % |\n",
                      rate_over(scores, kind("resolved"), [](const Score& s) { return s.right_name; }));
  std::vector<double> errors;
  int covered = 0, sized = 0;
  for (const Score& s : scores) {
    if (s.parameter_error < 0.0) continue;
    ++sized, covered += s.covered;
    if (faintest(s).s >= 16.0) errors.push_back(s.parameter_error);
  }
  std::sort(errors.begin(), errors.end());
  text += fmt::format(
      "| size: median error, s >= 16 | {} | <= 5 % |\n",
      errors.empty() ? "none" : fmt::format("{:.1f} % of {}", 100 * errors[errors.size() / 2], errors.size()));
  text += fmt::format("| size: 90 % intervals hold it | {} | 85 to 95 % |\n", rate(covered, sized));

  std::map<std::string, std::map<std::string, int>> confusion;
  std::map<std::string, int> answers;
  for (const Score& s : scores) {
    const std::string hidden = s.trial.hidden.empty() ? "nothing" : fmt::format("{}", fmt::join(s.trial.hidden, "+"));
    ++confusion[s.trial.kind + ": " + hidden][answer_of(s)];
    ++answers[answer_of(s)];
  }
  text += "\n| hidden |";
  for (const auto& [answer, count] : answers) text += fmt::format(" {} |", answer);
  text += "\n| --- |";
  for (std::size_t i = 0; i < answers.size(); ++i) text += " --- |";
  for (const auto& [hidden, row] : confusion) {
    text += fmt::format("\n| {} |", hidden);
    for (const auto& [answer, count] : answers)
      text += row.contains(answer) ? fmt::format(" {} |", row.at(answer)) : " |";
  }
  text +=
      "\n\n| trial | s | rho | ceiling | answer | set | size error |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Score& s : scores) {
    const Hidden hidden = faintest(s);
    std::string set;
    for (const auto& model : s.answer.possible)
      set += (set.empty() ? "" : " / ") + fmt::format("{}", fmt::join(model, "+"));
    text += fmt::format("| {} | {:.1f} | {:.2f} | {:.2f} | {} | {} | {} |\n", s.trial.name, hidden.s, hidden.rho,
                        hidden.ceiling, answer_of(s), set,
                        s.parameter_error < 0.0 ? "" : fmt::format("{:.0f} %", 100 * s.parameter_error));
  }
  return text;
}

}  // namespace nacre::blind_trials
