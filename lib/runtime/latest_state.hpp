#pragma once
// The messages that a viewer needs who comes late: where a game stands.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace nacre::runtime {

/// Keeps of what passes on the bus the latest RUN, PARAMETERS, PROPOSAL, DIAGNOSIS, ROUND, REVEAL and STATUS of each
/// node, the whole newest gamut, the families, and the orders of the round that is played. Measurements are no state:
/// who needs all of them reads the whole log.
class LatestState {
 public:
  /// A message as it was on the bus; what does not decode is none.
  void take(const std::string& channel, const std::string& bytes);

  struct Kept {
    std::string channel, bytes;
    int round = 0;
    std::int64_t order = 0;  ///< of its arrival
  };
  /// In the order of their arrival.
  std::vector<Kept> messages() const;

 private:
  void forget(const std::string& channel, int before_round);

  std::map<std::pair<std::string, std::string>, Kept> kept_;  ///< by channel, and what there is one message of
  std::int64_t taken_ = 0;
};

}  // namespace nacre::runtime
