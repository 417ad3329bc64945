#include "dashboard/diagnosis_view.hpp"

#include "material/extensions.hpp"
#include "run/misfit.hpp"

namespace nacre::dashboard {

std::string family_of_effect(const std::string& effect) {
  const material::Effect* known = material::find_effect(effect);
  return known == nullptr ? "" : std::string(known->family);
}

std::string explanation_of_effect(const std::string& effect) {
  const material::Effect* known = material::find_effect(effect);
  return known == nullptr ? "" : std::string(known->explanation);
}

std::optional<DiagnosisRow> diagnosis_row(const run::RunRecord& run, int round) {
  const auto found = run.rounds.find(round);
  if (found == run.rounds.end() || !found->second.diagnosis) return std::nullopt;
  DiagnosisRow row{run::misfit_beside_verdict(found->second), &*found->second.diagnosis, {}};
  for (wire::DiagnosedEffect& effect : run::named_effects(*row.diagnosis)) row.effects.push_back({std::move(effect)});
  return row;
}

}  // namespace nacre::dashboard
