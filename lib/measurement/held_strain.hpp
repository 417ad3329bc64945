#pragma once
// Stress relaxation: where a record holds its strain, and what is read of its modulus at which times.

#include <optional>
#include <string_view>
#include <vector>

#include "material/rate_laws.hpp"

namespace nacre::measurement {

/// The column of a set that says for how long strain was held when the modulus was read, s.
inline constexpr std::string_view kHoldColumn = "hold_s";

/// The rate of a pull that is as stiff as a strain held for `time_s`, where a material relaxes slowly; also its own
/// inverse.
inline double rate_of_hold(double time_s) { return material::kRelaxationStrain / time_s; }

/// The stretch of a record in which strain stands, after a step or ramp.
struct HeldStretch {
  std::size_t first = 0, end = 0;  ///< rows; `end` is behind the last
  double strain = 0.0;             ///< which is held
  double begin_s = 0.0;            ///< middle of the ramp, from which a relaxing material counts (Zapas and Phillips,
                                   ///< J. Res. NBS 75A, 1971)
  double ramp_s = 0.0;
  bool is_whole() const { return first == 0; }  ///< the record has no ramp
};

/// The longest stretch within 2 % of one strain; `begin_s` is 0 where the record begins with it. Nothing where that
/// strain is not above 0, or fewer than five rows are held.
std::optional<HeldStretch> held_stretch(const std::vector<double>& time_s, const std::vector<double>& strain);

/// Whether a record is one of stress relaxation: strain is held to its end, five times as long as the ramp takes.
bool is_relaxation(const HeldStretch& held, const std::vector<double>& time_s);

/// The modulus at one time.
struct RelaxationReading {
  int line = 0;             ///< of the file
  double time_s = 0.0;      ///< after the middle of the ramp
  double modulus_pa = 0.0;  ///< stress over strain
};

/// The readings of a table of up to ten; of a denser curve geometric means within 12 % of 1, 3.16, 10, ... s, or of
/// three times where it holds fewer than two of them. `readings` by increasing time.
std::vector<RelaxationReading> thinned(const std::vector<RelaxationReading>& readings);

}  // namespace nacre::measurement
