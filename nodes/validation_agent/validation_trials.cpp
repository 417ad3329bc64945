// Extensions that a diagnosis names: calibrated beside the adopted model, tried on designs that nobody has measured,
// adopted or not.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "game/model.hpp"
#include "material/extensions.hpp"
#include "sysid/objective.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::validation_agent {

using runtime::LogLevel;

std::optional<material::ParameterSet> ValidationCore::extended_by(const diagnosis_t& diagnosis) {
  material::ParameterSet extended = model_;
  for (const effect_t& effect : diagnosis.effects) {
    if (material::find_effect(effect.name) == nullptr) {
      say(LogLevel::warning,
          fmt::format("the diagnosis names {}, which is not in the library of effects", effect.name));
      return std::nullopt;
    }
    extended.extensions[effect.name] = {effect.parameter};
  }
  if (const std::string fault = material::parameter_fault(extended); !fault.empty()) {
    say(LogLevel::warning, "the diagnosed extension cannot be used: " + fault);
    return std::nullopt;
  }
  return extended;
}

void ValidationCore::weigh(const diagnosis_t& diagnosis) {
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
  for (const effect_t& effect : diagnosis.effects) effects.push_back(effect.name);
  std::sort(effects.begin(), effects.end());
  if (!trial_ || trial_->effects != effects)
    trial_ = OnTrial{.effects = std::move(effects), .model = {}, .foretold = {}, .errors = {}};
  extending_ = true;
  begin_calibration(*extended);
}

void ValidationCore::finish_trial(const sysid::Calibrated& result) {
  const std::string name = fmt::format("{}", fmt::join(trial_->effects, " with "));
  const bool adopted_before = std::all_of(trial_->effects.begin(), trial_->effects.end(),
                                          [&](const std::string& each) { return model_.extensions.contains(each); });
  const game::TrialGain gain = game::gain_of(trial_->errors.modulus, game::kLeastModulusError);
  if (adopted_before || game::gain_is_established(trial_->errors, scenario_.rounds)) {
    take_over(result);
    trial_.reset();
    say(LogLevel::info,
        adopted_before
            ? fmt::format("round {}: {} gets the size that the diagnosis now gives it", round_, name)
            : fmt::format("round {}: the model is extended by {}: it foretold E of {} designs with a mean error of "
                          "{:.1f} % against {:.1f} % (chance {:.4f})",
                          round_, name, gain.designs, 100.0 * gain.extended, 100.0 * gain.adopted, gain.p_gain));
  } else {
    trial_->model = result.parameters;
    say(LogLevel::info,
        gain.designs == 0
            ? fmt::format("round {}: {} is on trial: it has to foretell designs better before it is adopted", round_,
                          name)
            : fmt::format("round {}: {} stays on trial: it foretold E of {} designs with a mean error of {:.1f} % "
                          "against {:.1f} % (chance {:.4f})",
                          round_, name, gain.designs, 100.0 * gain.extended, 100.0 * gain.adopted, gain.p_gain));
  }
  publish_model();
}

// What the extension on trial expects of the proposed designs is asked for before any of them is ordered.
void ValidationCore::foretell() {
  std::vector<measurement::Replicates> designs;
  sysid::WantedEvaluation evaluation{
      .id = "0", .parameters = trial_->model, .modulus = true, .toughness = true, .items = {}};
  for (const wire::ProposedDesign& proposed : proposals_.at(round_ - 1).designs) {
    evaluation.items.push_back(designs.size());
    designs.emplace_back().design = proposed.design;
  }
  phase_ = Phase::foretelling;
  ask_farm("f", {evaluation}, designs);
}

void ValidationCore::finish_foretelling() {
  const std::vector<sysid::Prediction>& predictions = questions_.predictions().front();
  const auto& designs = proposals_.at(round_ - 1).designs;
  trial_->foretold.clear();
  for (std::size_t i = 0; i < designs.size(); ++i) {
    sysid::Prediction shown = predictions[i];
    if (game::has_measurement_side(trial_->model)) shown = sysid::observed(shown, trial_->model.extensions);
    say(LogLevel::info, fmt::format("round {}: before it is measured, {} expects E {:.4g} MPa, T {:.4g} MPa of {}",
                                    round_, fmt::join(trial_->effects, " with "), 1e-6 * shown.modulus_pa.value_or(0.0),
                                    1e-6 * shown.toughness_pa.value_or(0.0), designs[i].design.name()));
    trial_->foretold.emplace(designs[i].design.name(), std::move(shown));
  }
  order();
}

}  // namespace nacre::validation_agent
