#include "specimen_delivery.hpp"

#include <algorithm>
#include <chrono>
#include <map>

#include "runtime/interrupts.hpp"

namespace nacre::cli {
namespace {

using Clock = std::chrono::steady_clock;
using dashboard::Delivery;

/// Repeats the offered messages until every node that listens has them all. A diagnosis names the specimens that it
/// rests on: an analyser that had not got them would wait for ever.
void wait_for_receivers(runtime::Endpoint& endpoint, const std::map<std::size_t, std::string>& hashes, double timeout_s,
                        const std::function<void(std::size_t)>& arrived) {
  const runtime::Interrupts interrupts;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s));
  while (endpoint.unacknowledged() > 0 && Clock::now() < deadline && !interrupts.any()) {
    endpoint.pump(50);
    if (arrived)
      arrived(static_cast<std::size_t>(
          std::ranges::count_if(hashes, [&](const auto& each) { return endpoint.waiting_for(each.second).empty(); })));
  }
}

}  // namespace

std::vector<SpecimenDelivery> deliver_specimens(const RunAccess& run, const HeldMeasurements& held_before,
                                                std::span<const measurement::SpecimenRecord> specimens,
                                                const DeliverySettings& settings) {
  const auto endpoint = speak(run, settings.name);
  std::vector<SpecimenDelivery> all(specimens.size());
  std::map<std::size_t, std::string> hashes;  // of what is under way, by its place
  std::map<std::size_t, HandIn> under_way;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const Result<HandIn> handed = hand_in(held_before, specimens[i], run.scenario.fidelity, settings.amend);
    if (!handed) {
      all[i] = {Delivery::conflicting, handed.error().message};
    } else if (const auto hash = endpoint->offer(handed->message)) {
      hashes.emplace(i, *hash);
      under_way.emplace(i, *handed);
      all[i].is_amendment = handed->report.amendment.revision > 0;
    } else {
      all[i] = {Delivery::refused, hash.error().message};
    }
  }
  wait_for_receivers(*endpoint, hashes, settings.timeout_s, settings.arrived);
  // Another program may have brought the same names meanwhile: what a node wrote down first stays.
  const HeldMeasurements held = held_measurements(run);
  for (const auto& [i, hash] : hashes) {
    const HandIn& handed = under_way.at(i);
    const auto reason = against_measurement(held, specimens[i].specimen, handed.report);
    const auto refusal = endpoint->refusal_of(hash);
    std::set<std::string> missing = endpoint->waiting_for(hash);
    if (reason || refusal) {
      all[i] = {Delivery::conflicting,
                reason ? *reason : fmt::format("{}. {}", *refusal, advice_on_refused("MEASUREMENT"))};
    } else if (!missing.empty()) {
      all[i] = {Delivery::unanswered, "", std::move(missing)};
    } else if (handed.is_repeated) {
      all[i].delivery = Delivery::repeated;
    }
  }
  return all;
}

}  // namespace nacre::cli
