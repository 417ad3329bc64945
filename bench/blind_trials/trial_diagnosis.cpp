#include "trial_diagnosis.hpp"

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "diagnosis/procedure.hpp"
#include "material/extensions.hpp"

namespace nacre::blind_trials {
namespace {

/// The size of effect `name` in a truth file; 0 where it is not hidden.
double hidden_size(const toml::table& truth, const std::string& name) {
  const toml::array* effects = truth["effect"].as_array();
  for (std::size_t k = 0; effects != nullptr && k < effects->size(); ++k) {
    const toml::table& effect = *effects->get(k)->as_table();
    if (effect["name"].value_or(std::string()) != name) continue;
    const toml::array* numbers = effect["value"].as_array();
    return numbers != nullptr ? numbers->get(0)->value_or(0.0) : effect["value"].value_or(0.0);
  }
  return 0.0;
}

SealedEffect hidden_effect(const toml::table& truth, const std::string& name) {
  SealedEffect hidden;
  hidden.size = hidden_size(truth, name);
  const toml::array* signals = truth["signal"].as_array();
  for (std::size_t k = 0; signals != nullptr && k < signals->size(); ++k) {
    const toml::table& signal = *signals->get(k)->as_table();
    if (signal["name"].value_or(std::string()) != name) continue;
    hidden.snr = signal["s"].value_or(0.0), hidden.collinearity = signal["rho"].value_or(0.0),
    hidden.ceiling = signal["ceiling"].value_or(0.0);
  }
  return hidden;
}

/// The signal-to-noise ratio of an effect of this size by the smallest one that the diagnosis would see, as if it grew
/// with its strength. Fracture tests have no other: what the base imitates is known by an emulator only.
double seen_signal(const nlohmann::json& diagnosis, const std::string& name, double size) {
  const double visible = diagnosis::NameRules{}.visible_signal;
  for (const auto& candidate : diagnosis["candidates"]) {
    if (candidate["name"] != name || !candidate["smallest_seen"].is_number()) continue;
    const material::EffectParameter& parameter = material::find_effect(name)->parameters.front();
    return visible * std::abs(material::strength_of(parameter, size)) /
           std::abs(material::strength_of(parameter, candidate["smallest_seen"].get<double>()));
  }
  return 0.0;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

template <class Item>
std::string joined(const std::vector<Item>& items, const std::function<std::string(const Item&)>& text_of) {
  std::vector<std::string> parts;
  for (const Item& item : items) parts.push_back(text_of(item));
  return fmt::format("{}", fmt::join(parts, ";"));
}

double number(const std::string& text) {
  const Result<double> value = number_from_text(text);
  if (!value) throw InputError(value.error().message);
  return *value;
}

/// Puts the numbers of one cell into a field of each item.
template <class Item>
void spread(const std::string& cell, std::vector<Item>& items, double Item::*field) {
  const std::vector<std::string> parts = split(cell, ';');
  if (parts.size() != items.size()) throw InputError::format("{} numbers expected, not \"{}\"", items.size(), cell);
  for (std::size_t i = 0; i < items.size(); ++i) items[i].*field = number(parts[i]);
}

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

}  // namespace

TrialDiagnosis open_trial(const BlindTrial& trial, const std::string& commit, const std::filesystem::path& folder) {
  const auto diagnosis = nlohmann::json::parse(read_file(folder / "diagnosis.json"));
  const toml::table truth = toml::parse(read_file(folder / "set.truth.toml"));
  TrialDiagnosis result{.commit = commit,
                        .verdict = diagnosis["verdict"],
                        .hidden = {},
                        .named = {},
                        .possible = diagnosis["possible"],
                        .p_misfit = diagnosis["p_misfit"]};
  for (const std::string& name : trial.hidden) {
    result.hidden.push_back(hidden_effect(truth, name));
    if (trial.kind == "fracture") result.hidden.back().snr = seen_signal(diagnosis, name, result.hidden.back().size);
  }
  for (const auto& effect : diagnosis["effects"])
    result.named.push_back({effect["name"], effect["parameter"], effect["interval90"][0], effect["interval90"][1]});
  if (diagnosis["gain"].is_object()) result.gain = diagnosis["gain"]["relative_reduction"];
  return result;
}

std::vector<std::string> diagnosis_columns() {
  return {"trial", "commit", "hidden", "s",      "rho",      "ceiling", "verdict",
          "named", "size",   "low90",  "high90", "possible", "gain",    "p_misfit"};
}

std::vector<std::string> to_cells(const TrialDiagnosis& a) {
  const auto of_hidden = [&](double SealedEffect::*field) {
    return joined<SealedEffect>(a.hidden, [&](const SealedEffect& h) { return short_number(h.*field); });
  };
  const auto of_named = [&](double FoundEffect::*field) {
    return joined<FoundEffect>(a.named, [&](const FoundEffect& n) { return short_number(n.*field); });
  };
  std::vector<std::string> models;
  for (const auto& model : a.possible) models.push_back(fmt::format("{}", fmt::join(model, ";")));
  return {a.commit,
          of_hidden(&SealedEffect::size),
          of_hidden(&SealedEffect::snr),
          of_hidden(&SealedEffect::collinearity),
          of_hidden(&SealedEffect::ceiling),
          a.verdict,
          joined<FoundEffect>(a.named, [](const FoundEffect& n) { return n.effect; }),
          of_named(&FoundEffect::size),
          of_named(&FoundEffect::low90),
          of_named(&FoundEffect::high90),
          fmt::format("{}", fmt::join(models, "/")),
          short_number(a.gain),
          short_number(a.p_misfit)};
}

TrialDiagnosis diagnosis_from_cells(const std::vector<std::string>& cells) {
  TrialDiagnosis diagnosis{.commit = cells[0],
                           .verdict = cells[5],
                           .hidden = std::vector<SealedEffect>(split(cells[1], ';').size()),
                           .named = {},
                           .possible = {},
                           .gain = number(cells[11]),
                           .p_misfit = number(cells[12])};
  double SealedEffect::*const hidden_fields[] = {&SealedEffect::size, &SealedEffect::snr, &SealedEffect::collinearity,
                                                 &SealedEffect::ceiling};
  for (std::size_t i = 0; i < 4; ++i) spread(cells[1 + i], diagnosis.hidden, hidden_fields[i]);
  for (const std::string& name : split(cells[6], ';')) diagnosis.named.push_back({.effect = name});
  double FoundEffect::*const named_fields[] = {&FoundEffect::size, &FoundEffect::low90, &FoundEffect::high90};
  for (std::size_t i = 0; i < 3; ++i) spread(cells[7 + i], diagnosis.named, named_fields[i]);
  for (const std::string& model : split(cells[10], '/')) diagnosis.possible.push_back(split(model, ';'));
  return diagnosis;
}

}  // namespace nacre::blind_trials
