// Part of ValidationCore (validation_core.hpp): extensions that a diagnosis names, which are calibrated in addition to
// the adopted model, tried on designs that nobody has measured, and adopted or not.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "base/counted.hpp"
#include "game/model.hpp"
#include "material/extensions.hpp"
#include "measurement/conditions.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::validation_agent {

using runtime::LogLevel;

std::optional<material::ParameterSet> ValidationCore::extended_by(const wire::Diagnosis& diagnosis) {
  material::ParameterSet extended = model_;
  material::Extensions numbers;  // an effect with several parameters stands there as often
  for (const wire::DiagnosedEffect& effect : diagnosis.effects) {
    if (material::find_effect(effect.name) == nullptr) {
      say(LogLevel::warning,
          fmt::format("the diagnosis names {}, which is not in the library of effects", effect.name));
      return std::nullopt;
    }
    numbers[effect.name].push_back(effect.parameter);
  }
  if (numbers.size() == 1 && numbers.contains("batch_drift")) {
    say(LogLevel::info,
        "the print drifts from batch to batch: that predicts nothing about new designs and is not put on trial");
    return std::nullopt;
  }
  for (auto& [name, values] : numbers) extended.extensions[name] = std::move(values);
  if (const std::string fault = material::parameter_fault(extended); !fault.empty()) {
    say(LogLevel::warning, "the diagnosed extension cannot be used: " + fault);
    return std::nullopt;
  }
  return extended;
}

/// Whether all that a diagnosis names is part of the adopted model already.
bool ValidationCore::model_holds(const wire::Diagnosis& diagnosis) const {
  return !diagnosis.effects.empty() &&
         std::all_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                     [&](const wire::DiagnosedEffect& each) { return model_.extensions.contains(each.name); });
}

void ValidationCore::weigh(const wire::Diagnosis& diagnosis) {
  const bool named = diagnosis.verdict == "named" && !diagnosis.effects.empty();
  const auto extended = named ? extended_by(diagnosis) : std::nullopt;
  if (!extended || *extended == model_) {
    if (trial_)
      say(LogLevel::info,
          fmt::format("round {}: {} is no longer named, its trial ends", round_, fmt::join(trial_->effects, " with ")));
    trial_.reset();
    return publish_model();
  }
  std::vector<std::string> effects;
  for (const wire::DiagnosedEffect& effect : diagnosis.effects) effects.push_back(effect.name);
  std::sort(effects.begin(), effects.end());
  effects.erase(std::unique(effects.begin(), effects.end()), effects.end());
  if (!trial_ || trial_->effects != effects)
    trial_ = OnTrial{.effects = std::move(effects), .model = {}, .predicted = {}, .adopted = {}, .errors = {}};
  extending_ = true;
  begin_calibration(*extended);
}

namespace {

std::string in_words(const game::ExtensionTrialErrors& errors) {
  const auto standing = [](const char* what, const std::vector<game::OutOfSampleError>& own, double least) {
    const game::ExtensionTrialStanding s = game::standing_of(own, least);
    return fmt::format("{} of {} with a mean error of {:.1f} % against {:.1f} % (Bayes factor 10^{:.1f})", what,
                       counted(s.designs, "new design"), 100.0 * s.extended, 100.0 * s.adopted, s.for_extended);
  };
  return fmt::format("it predicted {}, {}", standing("E", errors.modulus, game::kLeastModulusError),
                     standing("T", errors.toughness, game::kLeastToughnessError));
}

}  // namespace

void ValidationCore::finish_trial(const sysid::Calibrated& result) {
  const std::string name = fmt::format("{}", fmt::join(trial_->effects, " with "));
  const bool adopted_before = model_holds(*diagnosis_);
  if (adopted_before || game::gain_is_established(trial_->errors)) {
    say(LogLevel::info,
        adopted_before
            ? fmt::format("round {}: {} gets its effect size from the new diagnosis", round_, name)
            : fmt::format("round {}: the model is extended by {}: {}", round_, name, in_words(trial_->errors)));
    take_over(result);
    trial_.reset();
  } else {
    trial_->model = result.parameters;
    const bool is_new = trial_->errors.modulus.empty() && trial_->errors.toughness.empty();
    say(LogLevel::info,
        is_new ? fmt::format("round {}: {} is on trial: it must predict new designs better before it is adopted",
                             round_, name)
               : fmt::format("round {}: {} stays on trial: {}, adopted from 10^1.3 on", round_, name,
                             in_words(trial_->errors)));
  }
  publish_model();
}

namespace {

std::vector<std::size_t> numbers(std::size_t first, std::size_t end) {
  std::vector<std::size_t> all(end - first);
  std::iota(all.begin(), all.end(), first);
  return all;
}

}  // namespace

/// Designs that the diagnosis wants measured since the named model and the base differ on their moduli, printed
/// upright and new to both.
std::vector<pattern::Design> ValidationCore::separating_designs() const {
  std::vector<pattern::Design> designs;
  for (const game::DiscriminationTest& each : experiments()) {
    const bool is_plain = each.test == tester::TestKind::modulus && each.design.layout() != nullptr &&
                          measurement::same_conditions(each.conditions, {});
    const std::string name = each.design.name();
    const auto& proposed = proposals_.at(round_ - 1).designs;
    const bool is_proposed =
        std::any_of(proposed.begin(), proposed.end(), [&](const auto& one) { return one.design.name() == name; });
    if (is_plain && !is_proposed && !calibrated_designs_.contains(name)) designs.push_back(each.design);
  }
  return designs;
}

/// The proposed designs, and behind them those that separate.
std::vector<measurement::Replicates> ValidationCore::predicted_designs() const {
  std::vector<measurement::Replicates> designs;
  for (const wire::ProposedDesign& each : proposals_.at(round_ - 1).designs)
    designs.emplace_back().design = each.design;
  for (const pattern::Design& each : separating_designs()) designs.emplace_back().design = each;
  return designs;
}

// The extension on trial predicts the designs of the round before any of them is ordered. The adopted model's
// predictions stand in PROPOSAL; for designs that only separate the two they are requested, too.
void ValidationCore::predict_for_trial() {
  const std::vector<measurement::Replicates> designs = predicted_designs();
  const std::size_t proposed = proposals_.at(round_ - 1).designs.size();
  std::vector<sysid::WantedEvaluation> wanted = {
      {.id = "0", .parameters = trial_->model, .modulus = true, .toughness = true, .items = numbers(0, proposed)}};
  for (const auto& [id, parameters] : {std::pair{"1", &trial_->model}, std::pair{"2", &model_}}) {
    if (designs.size() == proposed) break;
    wanted.push_back({.id = id,
                      .parameters = *parameters,
                      .modulus = true,
                      .toughness = false,
                      .items = numbers(proposed, designs.size())});
  }
  for (sysid::WantedEvaluation& each : wanted) each = sysid::as_prediction(std::move(each));
  phase_ = Phase::predicting_trial;
  ask_farm("f", wanted, designs);
}

void ValidationCore::finish_trial_predictions() {
  const std::vector<measurement::Replicates> designs = predicted_designs();
  const auto& predictions = farm_.predictions();
  const std::size_t proposed = predictions.front().size();
  trial_->predicted.clear();
  trial_->adopted.clear();
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const std::string name = designs[i].design.name();
    const sysid::Prediction observed =
        game::through_machine(i < proposed ? predictions[0][i] : predictions[1][i - proposed], trial_->model);
    say(LogLevel::info,
        fmt::format("round {}: prediction with {}: {} has E {:.4g} MPa{}", round_, fmt::join(trial_->effects, " with "),
                    name, 1e-6 * observed.modulus_pa.value_or(0.0),
                    observed.toughness_pa ? fmt::format(", T {:.4g} MPa", 1e-6 * *observed.toughness_pa) : ""));
    trial_->predicted.emplace(name, observed);
    if (i >= proposed) trial_->adopted.emplace(name, game::through_machine(predictions[2][i - proposed], model_));
  }
  order();
}

}  // namespace nacre::validation_agent
