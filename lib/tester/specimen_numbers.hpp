#pragma once
// Which specimens of a design are broken for what. None serves two purposes: what is predicted of a chosen design comes
// from specimens that did not choose it, and a calibration's emulator averages cracks, since every evaluation breaks
// specimens of its own.

namespace nacre::tester {

inline constexpr int kSearchSpecimen = 0;               ///< one a sample
inline constexpr int kFirstSelectionSpecimen = 1;       ///< of a candidate's T: at most 100
inline constexpr int kFirstPredictionSpecimen = 200;    ///< of a design's predicted T ...
inline constexpr int kPredictionSpecimens = 8;          ///< ... so many, unless asked otherwise
inline constexpr int kFirstScatterSpecimen = 900;       ///< of a design's scatter: at most 100
inline constexpr int kFirstCalibrationSpecimen = 1000;  ///< one an evaluation

}  // namespace nacre::tester
