#include "run/run_record.hpp"

#include <algorithm>

namespace nacre::run {
namespace {

const Gamut& known(const std::shared_ptr<const Gamut>& gamut) {
  static const Gamut kNone;
  return gamut ? *gamut : kNone;
}

}  // namespace

const Gamut& gamut_of(const RoundRecord& round) { return known(round.gamut); }
const Gamut& gamut_of(const FamilyRecord& family) { return known(family.gamut); }

std::vector<wire::DiagnosedEffect> named_effects(const wire::Diagnosis& diagnosis) {
  std::vector<wire::DiagnosedEffect> named;
  for (const wire::DiagnosedEffect& effect : diagnosis.effects) {
    const bool is_further =
        std::ranges::any_of(named, [&](const wire::DiagnosedEffect& known) { return known.name == effect.name; });
    if (!is_further) named.push_back(effect);
  }
  return named;
}

}  // namespace nacre::run
