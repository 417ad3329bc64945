#pragma once
// What the lines above a sweep's table tell of it: the frequency of a test at one alone, its amplitude, and the
// sample's length.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace nacre::measurement {

/// A number of the header.
struct HeaderNumber {
  double value = 0.0;
  int line = 0;      ///< of the file, from 1
  std::string text;  ///< as written, `1.0 Hz`
};

/// Each above 0, where one line tells it, or several the same.
struct SweepHeader {
  std::optional<HeaderNumber> angular_frequency_per_s;
  std::optional<HeaderNumber> amplitude;     ///< of the strain
  std::optional<HeaderNumber> amplitude_mm;  ///< of the displacement
  std::optional<HeaderNumber> length_mm;     ///< of the sample between the clamps
};

/// Reads `Frequency,1.0,Hz`, `Frequency (Hz): 1.0`, `Prüffrequenz  1 Hz`, `Amplitude: 20 µm`, `Sample length 17.5 mm`
/// of these lines, the first of which has the number `first_line`. Ranges and limits of a frequency are none.
SweepHeader sweep_header_of(std::span<const std::string_view> lines, int first_line, char delimiter);

/// What is missing is the other's.
SweepHeader with_missing_of(SweepHeader header, const SweepHeader& other);

}  // namespace nacre::measurement
