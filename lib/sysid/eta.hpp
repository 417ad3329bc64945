#pragma once
// Places of eta's constants in its vector.

#include <array>
#include <cstddef>

namespace nacre::sysid {

/// Moduli, Poisson's ratios and failure energies of soft, rigid and interface, then the damping. Moduli and ratios
/// stand at the same places in theta.
enum EtaIndex { kE0 = 0, kNu0 = 3, kW0 = 6, kGamma = 9, kEtaCount = 10 };

/// What is searched: all but Poisson's ratios, on which T hardly depends; a few tens of evaluations cannot tell them.
inline constexpr std::array<std::size_t, 7> kSearchedEta = {kE0, kE0 + 1, kE0 + 2, kW0, kW0 + 1, kW0 + 2, kGamma};

}  // namespace nacre::sysid
