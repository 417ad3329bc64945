#include "case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "designs.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "study_laboratory.hpp"

namespace nacre::calibration_study {
namespace {

void add_effect(laboratory::Truth& truth, const std::string& effect) {
  const std::size_t equals = effect.find('=');
  for (const laboratory::EffectKind& kind : laboratory::effect_kinds()) {
    if (kind.name != effect.substr(0, equals)) continue;
    truth.effects.*kind.value = equals == std::string::npos ? laboratory::draw_effect_value(truth.seed, kind)
                                                            : std::stod(effect.substr(equals + 1));
    if (kind.second.value != nullptr)
      truth.effects.*kind.second.value = laboratory::draw_second_value(truth.seed, kind);
    return;
  }
  throw InputError::format("--effect {}: expected NAME or NAME=VALUE with a name that the laboratory knows", effect);
}

}  // namespace

std::function<void()> deadline(double minutes) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(60.0 * minutes);
  return [end] {
    if (std::chrono::steady_clock::now() > end) throw TimeIsUp();
  };
}

StudyCase measured_case(std::uint64_t seed, const Options& options, const std::function<void()>& may_go_on) {
  const auto fidelity = tester::fidelity_from_string(options.fidelity);
  if (!fidelity) throw InputError(fidelity.error().message);
  const auto criterion = material::criterion_from_string(options.criterion);
  if (!criterion) throw InputError(criterion.error().message);
  StudyCase result{study_truth(seed, *fidelity, *criterion), {}, {}};
  for (const std::string& effect : options.effects) add_effect(result.truth, effect);
  const StudyDesigns designs = draw_designs(seed, options.fitted, options.predicted);
  const std::string store = fmt::format("{}/laboratory-{}.bin", options.work, options.fidelity);
  result.fitted = measurement::summarise(measure(result.truth, designs.fitted, store, may_go_on));
  result.held_out = measurement::summarise(measure(result.truth, designs.held_out, store, may_go_on));
  return result;
}

sysid::LocalSimulator kept_simulator(const Options& options, const std::string& fidelity) {
  const auto named = tester::fidelity_from_string(fidelity);
  if (!named) throw InputError(named.error().message);
  return {*named, 0, fmt::format("{}/simulations-{}.bin", options.work, fidelity)};
}

}  // namespace nacre::calibration_study
