#pragma once
// Specimens into a running game, many at a time.

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "dashboard/desk.hpp"
#include "game/measurement_book.hpp"
#include "run_access.hpp"
#include "specimen_messages.hpp"

namespace nacre::cli {

struct SpecimenDelivery {
  dashboard::Delivery delivery = dashboard::Delivery::accepted;
  std::string reason = {};             ///< of one that is conflicting or refused, as a sentence
  std::set<std::string> missing = {};  ///< nodes that have not got one that is unanswered
  bool is_amendment = false;           ///< of a specimen that the run has with other values
};

struct DeliverySettings {
  std::string name;  ///< of the sender
  double timeout_s = 30.0;
  std::optional<game::Amendment> amend = {};           ///< by whom and why values that the run has are amended
  std::function<void(std::size_t)> arrived = nullptr;  ///< is told how many have come so far
};

/// Offers what no node contradicts and every node would take, and waits until every node that listens has it all, for
/// the time given or until Ctrl-C. `held`: what the nodes have. Throws InputError where there is no bus.
std::vector<SpecimenDelivery> deliver_specimens(const RunAccess& run, const HeldMeasurements& held,
                                                std::span<const measurement::SpecimenRecord> specimens,
                                                const DeliverySettings& settings);

}  // namespace nacre::cli
