#include "sealing.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "laboratory/effect_kinds.hpp"
#include "material/extensions.hpp"

namespace nacre::blind_trials {
namespace {

namespace lab = laboratory;
using Specimens = std::vector<measurement::SpecimenRecord>;

/// Those that are not broken: fractures would have to be simulated for every effect.
Specimens without_fractures(Specimens specimens) {
  std::erase_if(specimens, [](const auto& specimen) { return specimen.test == tester::TestKind::toughness; });
  return specimens;
}

/// The specimens with the values of another truth, without scatter.
Specimens shown_by(lab::Truth truth, const Printed& printed) {
  truth.noise = {.modulus = 0.0, .toughness = 0.0, .strain = 0.0};
  const auto responses = lab::responses_to(truth, printed.experiments);
  Specimens records;
  for (std::size_t i = 0; i < printed.specimens.size(); ++i) {
    const std::size_t q = i / static_cast<std::size_t>(truth.replicates);
    records.push_back(lab::record_specimen(truth, printed.experiments[q], responses[q], printed.replicates[i]));
  }
  return without_fractures(std::move(records));
}

/// Settings for the signals of a trial.
struct Sealing {
  diagnosis::DiagnosisSettings settings;
  diagnosis::AssumedScatter scatter;
};

Sealing sealing_of(const TrialOptions& options, const lab::Truth& truth) {
  Sealing sealing;
  diagnosis::DiagnosisSettings& settings = sealing.settings;
  settings.start = material::default_parameters();
  settings.start.modulus = truth.modulus;
  settings.start.toughness = truth.toughness;
  settings.fidelity = options.fidelity;
  settings.floor = diagnosis::read_modulus_floor(NACRE_SOURCE_DIR "/data/discretisation_floor.toml", options.fidelity);
  sealing.scatter = {.modulus = truth.noise.modulus, .stress = truth.noise.modulus, .strain = truth.noise.strain};
  return sealing;
}

std::string signal_in_toml(std::string_view name, double snr, double collinearity, std::string_view rival,
                           double ceiling) {
  return fmt::format("\n[[signal]]\nname = \"{}\"\ns = {:.4f}\nrho = {:.4f}\nrival = \"{}\"\nceiling = {:.4f}\n", name,
                     snr, collinearity, rival, ceiling);
}

/// The same truth with nothing hidden but the effects of these names.
lab::Truth hiding_only(lab::Truth truth, std::span<const std::string> names) {
  const lab::HiddenEffects hidden = std::exchange(truth.effects, {});
  for (const lab::EffectKind& kind : lab::effect_kinds()) {
    if (std::ranges::find(names, kind.name) == names.end()) continue;
    truth.effects.*kind.value = hidden.*kind.value;
    if (kind.second.value) truth.effects.*kind.second.value = hidden.*kind.second.value;
  }
  return truth;
}

/// A point of a search for a magnitude, both in logarithms.
struct SizedSignal {
  double magnitude = 0.0, signal = 0.0;
};

/// Where the signal may be `wanted`: by the line through the bracket where that lies well inside of it, else its
/// middle; outward by a factor of two where one side is missing. The signal grows with `direction` times the magnitude.
double next_magnitude(const std::vector<SizedSignal>& known, double wanted, double direction) {
  const SizedSignal *weaker = nullptr, *stronger = nullptr;
  for (const SizedSignal& each : known) {
    if (each.signal < wanted && (weaker == nullptr || each.signal > weaker->signal)) weaker = &each;
    if (each.signal >= wanted && (stronger == nullptr || each.signal < stronger->signal)) stronger = &each;
  }
  if (weaker == nullptr) return stronger->magnitude - direction * std::max(std::log(2.0), stronger->signal - wanted);
  if (stronger == nullptr) return weaker->magnitude + direction * std::log(2.0);
  constexpr double kMargin = 0.1;  // of the bracket
  const double share = (wanted - weaker->signal) / (stronger->signal - weaker->signal);
  return std::lerp(weaker->magnitude, stronger->magnitude, share > kMargin && share < 1.0 - kMargin ? share : 0.5);
}

}  // namespace

std::string signals_of(const BlindTrial& trial, const TrialOptions& options, const lab::Truth& truth,
                       const Printed& printed) {
  if (trial.hidden.empty()) return {};
  const Sealing sealing = sealing_of(options, truth);
  std::vector<diagnosis::PlannedEffect> rivals;  // computed only where there are any
  if (std::ranges::any_of(trial.hidden, material::find_effect))
    rivals = diagnosis::plan_diagnosis(without_fractures(printed.specimens), sealing.settings, sealing.scatter, false)
                 .effects;
  const Specimens plain = shown_by(hiding_only(truth, {}), printed);
  std::string text;
  for (const std::string& effect : trial.hidden) {
    const double snr = diagnosis::signal_of_change(plain, shown_by(hiding_only(truth, {&effect, 1}), printed),
                                                   sealing.settings, sealing.scatter);
    const auto known = std::ranges::find(rivals, effect, &diagnosis::PlannedEffect::name);
    if (known == rivals.end()) {
      text += signal_in_toml(effect, snr, 0.0, "", 0.0);
      continue;
    }
    const double distance = snr * std::sqrt((1.0 - known->rival_cosine) / 2.0);
    text += signal_in_toml(effect, snr, known->rival_cosine, known->nearest_rival,
                           0.5 * std::erfc(-distance / std::sqrt(2.0)));
  }
  return text;
}

lab::Truth sized_to(double snr, const BlindTrial& trial, const TrialOptions& options, lab::Truth truth,
                    const Printed& printed) {
  constexpr int kMostSizes = 12;
  constexpr double kNear = 0.05, kNothing = 1e-3;
  const Sealing sealing = sealing_of(options, truth);
  const Specimens plain = shown_by(hiding_only(truth, {}), printed);
  const lab::EffectKind& kind = *std::ranges::find(lab::effect_kinds(), trial.hidden.front(), &lab::EffectKind::name);
  const material::EffectParameter& parameter = material::find_effect(kind.name)->parameters.front();
  double& size = truth.effects.*kind.value;
  const double sign = size < 0.0 ? -1.0 : 1.0;
  const double direction =
      material::strength_of(parameter, 1.1 * size) * sign > material::strength_of(parameter, size) * sign ? 1.0 : -1.0;
  const double most = std::log(std::max(std::abs(kind.minimum), std::abs(kind.maximum)));
  std::vector<SizedSignal> known;
  for (int i = 0; i < kMostSizes; ++i) {
    if (i > 0) {
      const double magnitude = std::min(next_magnitude(known, std::log(snr), direction), most);
      if (magnitude == known.back().magnitude) break;
      size = sign * std::exp(magnitude);
    }
    const double signal =
        diagnosis::signal_of_change(plain, shown_by(truth, printed), sealing.settings, sealing.scatter);
    if (std::abs(signal / snr - 1.0) < kNear) break;
    known.push_back({std::log(std::abs(size)), std::log(std::max(signal, kNothing))});
  }
  return truth;
}

}  // namespace nacre::blind_trials
