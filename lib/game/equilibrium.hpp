#pragma once
// When the game is over (thesis 2.3: "the game terminates when an equilibrium is reached").

#include <span>
#include <string>

namespace nacre::game {

/// The figures of one round that the criterion reads, hypervolumes and gap in GPa MPa.
struct RoundFigures {
  int round = 0;
  double measured_hypervolume = 0.0;
  double hypervolume_error = 0.0;  ///< bootstrap standard error of the measured hypervolume over replicates
  double signed_gap = 0.0;         ///< hv(gamut) - hv(measured)
};

/// The result of the criterion and the figure that decided it, in words.
struct EquilibriumCheck {
  bool equilibrium = false;
  std::string decided_by;
};

/// Equilibrium: in two consecutive rounds (a) the measured hypervolume grew by less than its standard error, or not at
/// all, and (b) the signed gap lies within twice that error or changed by less than 10 %. `history` holds one entry per
/// round, ascending, the newest last; a round counts only when its predecessor had measurements, so the earliest end is
/// round 3.
EquilibriumCheck judge_equilibrium(std::span<const RoundFigures> history);

}  // namespace nacre::game
