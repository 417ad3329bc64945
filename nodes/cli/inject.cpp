// Part of the command line (command.hpp): nacre inject, measurements from anywhere into a running game.

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "command.hpp"
#include "measurement/specimen_checks.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "run_access.hpp"
#include "runtime/interrupts.hpp"
#include "specimen_doubts.hpp"
#include "specimen_messages.hpp"

namespace nacre::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct InjectOptions {
  std::string set;
  std::string run = "logs/latest";
  std::string reason;
  std::string by = user_name();
  double timeout_s = 60.0;
  bool json = false;
};

/// How many specimens of a set arrived.
struct SetDelivery {
  int accepted = 0;    ///< new to the validation agent
  int amended = 0;     ///< it had other values of them
  int repeated = 0;    ///< it had them already
  int unanswered = 0;  ///< a node has not got them
  std::set<std::string> unanswered_by;
  std::vector<std::string> conflicting;  ///< a node has other specimens of these names, which stay
  std::vector<measurement::RejectedRow> rejected;
};

/// Repeats the offered messages until every node that listens has them all. A diagnosis names the specimens that it
/// rests on: an analyser that had not got them would wait for ever.
void wait_for_receivers(runtime::Endpoint& endpoint, const std::vector<std::string>& hashes, double timeout_s) {
  const runtime::Interrupts interrupts;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s));
  Progress progress("inject: specimens", static_cast<std::int64_t>(hashes.size()));
  while (endpoint.unacknowledged() > 0 && Clock::now() < deadline && !interrupts.any()) {
    endpoint.pump(50);
    progress.set(std::count_if(hashes.begin(), hashes.end(),
                               [&](const std::string& hash) { return endpoint.waiting_for(hash).empty(); }));
  }
}

void print_delivery(const SetDelivery& delivery, bool json) {
  if (!json) {
    fmt::print("{} accepted, {}{} repeated, {} conflicting, {} unanswered, {} rejected\n", delivery.accepted,
               delivery.amended > 0 ? fmt::format("{} amended, ", delivery.amended) : "", delivery.repeated,
               delivery.conflicting.size(), delivery.unanswered, delivery.rejected.size());
    return;
  }
  print_json({{"accepted", delivery.accepted},
              {"amended", delivery.amended},
              {"repeated", delivery.repeated},
              {"conflicting", delivery.conflicting},
              {"unanswered", delivery.unanswered},
              {"unanswered_by", delivery.unanswered_by},
              {"rejected", rejected_json(delivery.rejected)}});
}

/// The row of a specimen that no node would take.
measurement::RejectedRow refused(const measurement::SpecimenRecord& specimen, int line, const std::string& reason) {
  if (auto implausible = measurement::implausible_value(specimen)) {
    implausible->line = line;
    return *implausible;
  }
  return {line, "", reason};
}

/// Content hashes of the messages that are under way.
struct Offered {
  std::vector<std::string> hashes;
  struct Specimen {
    std::string name;
    HeldReport report;
    bool is_repeated = false;
  };
  std::map<std::string, Specimen> specimens;  ///< by hash
};

/// Who amends and why; nothing without a reason: then nothing is amended.
std::optional<game::Amendment> amendment_of(const InjectOptions& options) {
  if (options.reason.empty()) return std::nullopt;
  return game::Amendment{.by = options.by, .why = options.reason};
}

/// Offers what no node contradicts and every node would take; the rest goes into `delivery`.
Offered offer_specimens(const RunAccess& run, const HeldMeasurements& held, const measurement::MeasurementSet& set,
                        const InjectOptions& options, runtime::Endpoint& endpoint, SetDelivery& delivery) {
  Offered offered;
  for (std::size_t i = 0; i < set.specimens.size(); ++i) {
    const measurement::SpecimenRecord& specimen = set.specimens[i];
    const Result<HandIn> handed = hand_in(held, specimen, run.scenario.fidelity, amendment_of(options));
    if (!handed) {
      warn(handed.error().message);
      delivery.conflicting.push_back(specimen.specimen);
      continue;
    }
    const auto hash = endpoint.offer(handed->message);
    if (!hash) {
      delivery.rejected.push_back(refused(specimen, set.lines[i], hash.error().message));
      warn_about(delivery.rejected.back(), options.set);
      continue;
    }
    offered.hashes.push_back(*hash);
    offered.specimens.emplace(*hash, Offered::Specimen{specimen.specimen, handed->report, handed->is_repeated});
  }
  return offered;
}

/// Sends a set and waits for the answers of those that listen.
SetDelivery send(const RunAccess& run, const HeldMeasurements& held_before, const measurement::MeasurementSet& set,
                 const InjectOptions& options) {
  const auto endpoint = speak(run, "inject");
  SetDelivery delivery;
  delivery.rejected = set.rejected;
  const auto [hashes, specimens] = offer_specimens(run, held_before, set, options, *endpoint, delivery);
  if (hashes.empty() && delivery.conflicting.empty())
    throw InputError::format("{}: none of its {} specimens can be sent", options.set, set.specimens.size());
  wait_for_receivers(*endpoint, hashes, options.timeout_s);
  // Another program may have brought the same names meanwhile: what a node wrote down first stays.
  const HeldMeasurements held = held_measurements(run);
  for (const std::string& hash : hashes) {
    const auto& [name, report, is_repeated] = specimens.at(hash);
    const auto reason = against_measurement(held, name, report), refusal = endpoint->refusal_of(hash);
    if (reason || refusal) {
      warn(reason ? *reason : fmt::format("{}. {}", *refusal, advice_on_refused("MEASUREMENT")));
      delivery.conflicting.push_back(name);
      continue;
    }
    std::set<std::string> missing = endpoint->waiting_for(hash);
    const bool amends = report.amendment.revision > 0;
    ++(!missing.empty() ? delivery.unanswered
       : is_repeated    ? delivery.repeated
       : amends         ? delivery.amended
                        : delivery.accepted);
    delivery.unanswered_by.merge(missing);
  }
  std::ranges::stable_sort(delivery.rejected, {}, &measurement::RejectedRow::line);
  return delivery;
}

/// An amendment puts no review aside: a specimen that was not valid needs another one.
void say_still_invalid(const measurement::MeasurementSet& set, const game::MeasurementBook& book) {
  for (const measurement::SpecimenRecord& specimen : set.specimens) {
    const game::Review* review = book.review_of(specimen.specimen);
    if (review == nullptr || review->valid || !specimen.valid) continue;
    remark(fmt::format("{} stays not valid ({}: {}): nacre review {} --valid --why REASON lets it count",
                       specimen.specimen, review->by, review->why, specimen.specimen));
  }
}

int inject(const InjectOptions& options) {
  const RunAccess run = open_run(options.run);
  const measurement::MeasurementSet set = measurement::read_measurement_set(options.set);
  warn_about(set, options.set);
  HeldMeasurements held{.validation_agent = {}, .analyser = held_by_analyser(run)};
  const LaboratoryView view = view_laboratory(
      run, [&](const std::string& payload) { enter(held.validation_agent, payload, run.scenario.fidelity); });
  for (const std::string& doubt : doubts_about(run, view, set.specimens)) warn(doubt);
  const SetDelivery delivery = send(run, held, set, options);
  print_delivery(delivery, options.json);
  if (delivery.amended > 0) say_still_invalid(set, view.facts.book);
  if (delivery.unanswered > 0) say_unanswered(delivery.unanswered_by, options.timeout_s);
  return delivery.unanswered > 0 || !delivery.conflicting.empty() ? 1 : 0;
}

}  // namespace

void add_inject(CLI::App& app, Action& action) {
  const auto options = std::make_shared<InjectOptions>();
  CLI::App& command = add_command(app, action, "inject", "Hand measurements to a running game", options, inject);
  command.add_option("SET", options->set, "Measurement set: a folder with measurements.csv")->required();
  add_run_option(command, options->run);
  command.add_option("--reason", options->reason,
                     "Why specimens that the run has with other values are amended; without, they are refused");
  command.add_option("--by", options->by, "Who amends")->default_str("your account");
  command
      .add_option("--timeout-s", options->timeout_s, "How many seconds to wait for the nodes that take measurements")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
