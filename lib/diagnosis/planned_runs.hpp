#pragma once
// Which models fracture tests are simulated with, so that an emulator learns them: around a calibration, and with every
// effect of the material.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.hpp"
#include "diagnosis/coordinates.hpp"

namespace nacre::diagnosis {

/// Opposite pairs of base models about the centre.
std::vector<material::ParameterSet> opposite_pairs(const material::ParameterSet& centre, int pairs,
                                                   const EmulatorRules& rules, RandomStream& random);

/// Effects of the material that act on fracture tests, in the order of material::effect_library().
std::vector<const material::Effect*> fracture_effects();

/// The centre with one effect at this share of its range, further parameters at usual values, and eta moved a little.
/// Nothing where the effect has no negative sizes and `size` is one.
std::optional<material::ParameterSet> with_effect(const material::ParameterSet& centre, const material::Effect& effect,
                                                  double size, const ConstantRules& constants,
                                                  const EmulatorRules& rules, RandomStream& random);

/// All that a diagnosis simulates which has no budget: the centre; pairs around it where no search has broken any;
/// every effect at several sizes.
std::vector<material::ParameterSet> planned_runs(const Basis& basis, bool with_pairs, const EmulatorRules& rules,
                                                 std::uint64_t seed);

}  // namespace nacre::diagnosis
