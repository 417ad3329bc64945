#pragma once
// The loading programme of a coupon.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace nacre::tester {

/// Monotonic, or from zero to one nominal strain after another: where the next is smaller, the coupon is unloaded.
struct Loading {
  std::vector<double> turns;           ///< strains; empty: monotonic
  std::vector<double> holds_s = {};    ///< how long the strain of each turn is held; empty: no pause
  std::optional<double> dwell_s = {};  ///< at zero force, to which it is unloaded in the end; nothing: it is not
  bool has_pauses() const { return !holds_s.empty() || dwell_s.has_value(); }
  bool operator==(const Loading&) const = default;
};

/// "monotonic", or "strain 0.02 hold 60 0.005 unload dwell 600": the text of TEST_ORDER, of sets and of the documents.
std::string to_string(const Loading& loading);

/// Reads to_string() back. At most 20 strains from 0 to 2, each other than the one before; pauses up to 1e7 s; an
/// unloading comes last, from a strain above 0.
Result<Loading> loading_from_string(std::string_view text);

/// Nominal strains along the programme, 0 first, about `step` apart and with every turn among them. The programme has
/// turns.
std::vector<double> strain_path(const Loading& loading, double step);

}  // namespace nacre::tester
