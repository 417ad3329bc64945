#include "game/extension_trial.hpp"

#include <cmath>
#include <numbers>

namespace nacre::game {
namespace {

constexpr double kLevel = 0.05;
constexpr int kFewestDesigns = 3;

void add_error(std::vector<ForetoldError>& errors, const std::string& design, double measured,
               const std::optional<double>& adopted, const std::optional<double>& extended) {
  if (!(measured > 0.0) || !adopted || !extended || !(*adopted > 0.0) || !(*extended > 0.0)) return;
  errors.push_back({design, std::abs(std::log(*adopted / measured)), std::abs(std::log(*extended / measured))});
}

}  // namespace

void TrialErrors::add(const std::vector<measurement::Replicates>& measured,
                      const std::map<std::string, sysid::Prediction>& adopted,
                      const std::map<std::string, sysid::Prediction>& extended) {
  for (const measurement::Replicates& each : measured) {
    const std::string name = each.design.name();
    const auto by_adopted = adopted.find(name), by_extended = extended.find(name);
    if (by_adopted == adopted.end() || by_extended == extended.end()) continue;
    add_error(modulus, name, each.modulus_pa, by_adopted->second.modulus_pa, by_extended->second.modulus_pa);
    add_error(toughness, name, each.toughness_pa, by_adopted->second.toughness_pa, by_extended->second.toughness_pa);
  }
}

double student_exceedance(double t, int freedom) {
  const double angle = std::atan(std::abs(t) / std::sqrt(freedom)), sine = std::sin(angle), cosine = std::cos(angle);
  const bool odd = freedom % 2 == 1;
  // Share of the distribution within |t|.
  double term = odd ? cosine : 1.0, sum = freedom == 1 ? 0.0 : term;
  for (int k = odd ? 3 : 2; k < freedom - 1; k += 2) {
    term *= cosine * cosine * (k - 1.0) / k;
    sum += term;
  }
  const double within = odd ? 2.0 / std::numbers::pi * (angle + sine * sum) : sine * sum;
  return t >= 0.0 ? 0.5 * (1.0 - within) : 0.5 * (1.0 + within);
}

TrialGain gain_of(std::span<const ForetoldError> errors, double least) {
  TrialGain gain;
  gain.designs = static_cast<int>(errors.size());
  if (gain.designs < 2) return gain;
  const auto factor = [least](const ForetoldError& each) {
    return std::log((each.adopted + least) / (each.extended + least));
  };
  double mean = 0.0, squares = 0.0;
  for (const ForetoldError& each : errors) {
    gain.adopted += each.adopted / gain.designs;
    gain.extended += each.extended / gain.designs;
    mean += factor(each) / gain.designs;
  }
  for (const ForetoldError& each : errors) squares += std::pow(factor(each) - mean, 2);
  const double standard_error = std::sqrt(squares / (gain.designs - 1) / gain.designs);
  const double t = mean / std::max(standard_error, 1e-12);
  if (mean > 0.0 && gain.extended < gain.adopted) gain.p_gain = student_exceedance(t, gain.designs - 1);
  if (mean < 0.0 && gain.extended > gain.adopted) gain.p_loss = student_exceedance(-t, gain.designs - 1);
  return gain;
}

bool gain_is_established(const TrialErrors& errors, int rounds) {
  const double level = kLevel / std::max(rounds, 1);
  const TrialGain modulus = gain_of(errors.modulus, kLeastModulusError),
                  toughness = gain_of(errors.toughness, kLeastToughnessError);
  return modulus.designs >= kFewestDesigns && modulus.p_gain <= level && toughness.p_loss > level;
}

}  // namespace nacre::game
