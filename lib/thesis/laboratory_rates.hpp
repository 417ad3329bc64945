#pragma once
// How fast the thesis' laboratory may have worked, on which it is silent: defaults for what a print job costs, to be
// replaced by a laboratory's own figures (scenario table [laboratory]).

#include "thesis/constants.hpp"

namespace nacre::thesis {

inline constexpr Real kLayersPerMinute{
    1.5, "1/min", "a full tray in five passes of 8 s: heads 50 mm wide (Objet500 Connex3 guide)", Provenance::chosen};
inline constexpr Real kMinutesPerTest{
    10.0, "min", "3 min from 0 to 10 % strain at 2 mm/min (2.2.2), 7 to measure, notch and clamp", Provenance::chosen};
inline constexpr Real kTrayX{255.0, "mm", "build area of the printer of 2.2.1 (Objet260 Connex)", Provenance::inferred};
inline constexpr Real kTrayY{252.0, "mm", "build area of the printer of 2.2.1 (Objet260 Connex)", Provenance::inferred};

}  // namespace nacre::thesis
