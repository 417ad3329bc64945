#pragma once
// What is read of a coupon that was held, unloaded to zero force and left there.

#include <optional>
#include <string_view>

#include "base/result.hpp"
#include "measurement/specimen_record.hpp"
#include "tester/loading.hpp"

namespace nacre::measurement {

/// The column of a set with the programme of a coupon (tester::to_string).
inline constexpr std::string_view kLoadingColumn = "loading";

/// The programme of a coupon if it has pauses, a monotonic one otherwise: its curve tells where it turned. The error: a
/// column that is no programme.
Result<tester::Loading> pauses_of(const SpecimenRecord& specimen);

/// Its curve up to the first turn.
tester::Curve first_pull(const tester::Curve& curve);

/// Readings at the pauses, as far as programme and curve have them.
struct PauseReadings {
  std::optional<double> held_share;     ///< stress at the end of the first hold over the one at its beginning
  std::optional<double> set_share;      ///< strain at zero force over that of the turn
  std::optional<double> dwelled_share;  ///< the same after the dwell
};
/// A hold ends where the strain of the turn is left; zero force lies on the line from a tenth of the largest to 1 %; a
/// dwell ends with the curve.
PauseReadings read_pauses(const tester::Curve& curve, const tester::Loading& loading);

}  // namespace nacre::measurement
