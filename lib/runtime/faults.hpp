#pragma once
// Seeded faults: what a bad network does, on the receiving side, reproducibly and on machines without packet filters;
// and a clock that somebody sets.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "base/result.hpp"

namespace nacre::runtime {

struct FaultSettings {
  std::uint64_t seed = 1;
  double drop = 0.0;  ///< share of datagrams, 0..1
  double duplicate = 0.0;
  double reorder = 0.0;
  double corrupt = 0.0;
  double clock_s = 0.0;  ///< the clock jumps by up to so many seconds, forward or back
  bool any() const { return drop > 0 || duplicate > 0 || reorder > 0 || corrupt > 0; }
};

/// Reads "seed=7,drop=0.2,duplicate=0.05,reorder=0.05,corrupt=0.01,clock=3600". Throws InputError naming the key.
FaultSettings parse_faults(std::string_view text);

/// The settings in NACRE_FAULTS; none when it is not set.
FaultSettings faults_from_environment();

/// A clock that is set now and then: by how much this process' clock is off.
class ClockFault {
 public:
  explicit ClockFault(const FaultSettings& settings);
  /// The offset some time after the process began: another one every two seconds. 0 without fault.
  std::int64_t offset_us(std::int64_t steady_us) const;

 private:
  FaultSettings settings_;
  std::int64_t start_us_;
};

/// A datagram on its way.
struct Datagram {
  std::string channel;
  std::string bytes;
};

/// Decides what becomes of each datagram.
class FaultInjector {
 public:
  FaultInjector(const FaultSettings& settings, std::string_view node);
  /// What arrives instead of `datagram`: nothing, it, it twice, it damaged, an older one after it.
  std::vector<Datagram> pass(Datagram datagram);
  /// A datagram held back for reordering, when nothing else came to overtake it.
  std::optional<Datagram> release();

 private:
  FaultSettings settings_;
  RandomStream random_;
  std::optional<Datagram> held_;
};

}  // namespace nacre::runtime
