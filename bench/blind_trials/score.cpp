#include "score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/files.hpp"

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
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n), half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n);
  return fmt::format("{} of {} ({:.0f} %; 95 %: {:.0f} to {:.0f} %)", good, all, 100 * p, 100 * (middle - half), 100 * (middle + half));
}

std::string answer_of(const Score& score) { return score.verdict == "named" ? fmt::format("{}", fmt::join(score.named, "+")) : score.verdict; }

template <class Wanted, class Good>
std::string rate_over(const std::vector<Score>& scores, Wanted wanted, Good good) {
  int all = 0, right = 0;
  for (const Score& s : scores)
    if (wanted(s)) ++all, right += good(s);
  return rate(right, all);
}

}  // namespace

Score score_trial(const Trial& trial, const std::filesystem::path& folder) {
  const auto diagnosis = nlohmann::json::parse(read_file(folder / "diagnosis.json"));
  const toml::table truth = toml::parse(read_file(folder / "set.truth.toml"));
  Score score{trial, diagnosis["verdict"], {}, diagnosis["possible"], false, false, -1.0, false, 0.0, 0.0, 0.0, 0.0};
  for (const auto& effect : diagnosis["effects"]) score.named.push_back(effect["name"]);
  score.right_name = score.verdict == "named" && same(score.named, trial.hidden);
  score.in_set = std::any_of(score.possible.begin(), score.possible.end(), [&](const auto& model) { return same(model, trial.hidden); });
  if (const toml::array* signals = truth["signal"].as_array(); signals != nullptr && !signals->empty()) {
    const toml::table& first = *signals->get(0)->as_table();
    score.s = first["s"].value_or(0.0), score.rho = first["rho"].value_or(0.0), score.ceiling = first["ceiling"].value_or(0.0);
  }
  if (score.right_name && !trial.hidden.empty()) {
    const toml::array* effects = truth["effect"].as_array();
    const auto& named = diagnosis["effects"][0];
    for (std::size_t k = 0; effects != nullptr && k < effects->size(); ++k) {
      const toml::table& hidden = *effects->get(k)->as_table();
      if (hidden["name"].value_or(std::string()) != named["name"].get<std::string>()) continue;
      const toml::array* numbers = hidden["value"].as_array();
      const double value = numbers != nullptr ? numbers->get(0)->value_or(0.0) : hidden["value"].value_or(0.0);
      score.parameter_error = std::abs(named["parameter"].get<double>() / value - 1.0);
      score.covered = named["interval90"][0].get<double>() <= value && value <= named["interval90"][1].get<double>();
    }
  }
  if (diagnosis["gain"].is_object()) score.gain = diagnosis["gain"]["relative_reduction"];
  return score;
}

std::string report_of(const std::vector<Score>& scores) {
  const auto kind = [](const char* name) { return [name](const Score& s) { return s.trial.kind == name; }; };
  const auto fair = [](const Score& s) { return s.trial.kind == "effect" && s.s >= 8.0 && s.s * std::sqrt((1.0 - s.rho) / 2.0) >= 2.2; };
  const auto visible = [](const Score& s) { return s.trial.kind == "effect" && s.s >= 8.0; };
  std::string text = "| score | reached | aim |\n| --- | --- | --- |\n";
  text += fmt::format("| nulls: base sufficient | {} | >= 97 % |\n", rate_over(scores, kind("null"), [](const Score& s) { return s.verdict == "base_sufficient"; }));
  text += fmt::format("| nulls: any name | {} | <= 2 % at the upper bound |\n", rate_over(scores, kind("null"), [](const Score& s) { return s.verdict == "named"; }));
  text += fmt::format("| right single name, s >= 8 and distance >= 2.2 | {} | >= 95 % |\n", rate_over(scores, fair, [](const Score& s) { return s.right_name; }));
  text += fmt::format("| true cause within the set, s >= 8 | {} | >= 99 % |\n", rate_over(scores, visible, [](const Score& s) { return s.in_set; }));
  text += fmt::format("| confident wrong name, all effects | {} | |\n", rate_over(scores, kind("effect"), [](const Score& s) { return s.verdict == "named" && !s.right_name; }));
  text += fmt::format("| out of library: unexplained | {} | >= 90 % |\n", rate_over(scores, kind("outside"), [](const Score& s) { return s.verdict == "unexplained"; }));
  text += fmt::format("| out of library: a name | {} | <= 3 % |\n", rate_over(scores, kind("outside"), [](const Score& s) { return s.verdict == "named"; }));
  text += fmt::format("| two at once: both named | {} | |\n", rate_over(scores, kind("double"), [](const Score& s) { return s.right_name; }));
  text += fmt::format("| pair: reported as a set | {} | >= 95 % |\n", rate_over(scores, kind("pair"), [](const Score& s) { return s.verdict == "ambiguous" && s.in_set; }));
  std::vector<double> errors;
  int covered = 0, sized = 0;
  for (const Score& s : scores) {
    if (s.parameter_error < 0.0) continue;
    ++sized, covered += s.covered;
    if (s.s >= 16.0) errors.push_back(s.parameter_error);
  }
  std::sort(errors.begin(), errors.end());
  text += fmt::format("| size: median error, s >= 16 | {} | <= 5 % |\n", errors.empty() ? "none" : fmt::format("{:.1f} % of {}", 100 * errors[errors.size() / 2], errors.size()));
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
    for (const auto& [answer, count] : answers) text += row.contains(answer) ? fmt::format(" {} |", row.at(answer)) : " |";
  }
  text += "\n\n| trial | s | rho | ceiling | answer | set | size error |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Score& s : scores) {
    std::string set;
    for (const auto& model : s.possible) set += (set.empty() ? "" : " / ") + fmt::format("{}", fmt::join(model, "+"));
    text += fmt::format("| {} | {:.1f} | {:.2f} | {:.2f} | {} | {} | {} |\n", s.trial.name, s.s, s.rho, s.ceiling, answer_of(s), set, s.parameter_error < 0.0 ? "" : fmt::format("{:.0f} %", 100 * s.parameter_error));
  }
  return text;
}

}  // namespace nacre::blind_trials
