// Part of the command line (command.hpp): nacre inject, measurements from anywhere into a running game.

#include <algorithm>
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
#include "specimen_delivery.hpp"
#include "specimen_doubts.hpp"
#include "specimen_messages.hpp"

namespace nacre::cli {
namespace {

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

/// Who amends and why; nothing without a reason: then nothing is amended.
std::optional<game::Amendment> amendment_of(const InjectOptions& options) {
  if (options.reason.empty()) return std::nullopt;
  return game::Amendment{.by = options.by, .why = options.reason};
}

/// Counts what became of one specimen of the set, and warns.
void count(const SpecimenDelivery& one, const measurement::MeasurementSet& set, std::size_t at,
           const std::string& folder, SetDelivery& delivery) {
  const measurement::SpecimenRecord& specimen = set.specimens[at];
  switch (one.delivery) {
    case dashboard::Delivery::accepted:
      ++(one.is_amendment ? delivery.amended : delivery.accepted);
      break;
    case dashboard::Delivery::repeated:
      ++delivery.repeated;
      break;
    case dashboard::Delivery::conflicting:
      warn(one.reason);
      delivery.conflicting.push_back(specimen.specimen);
      break;
    case dashboard::Delivery::refused:
      delivery.rejected.push_back(refused(specimen, set.lines[at], one.reason));
      warn_about(delivery.rejected.back(), folder);
      break;
    case dashboard::Delivery::unanswered:
      ++delivery.unanswered;
      delivery.unanswered_by.insert(one.missing.begin(), one.missing.end());
  }
}

/// Sends a set and waits for the answers of those that listen.
SetDelivery send(const RunAccess& run, const HeldMeasurements& held, const measurement::MeasurementSet& set,
                 const InjectOptions& options) {
  SetDelivery delivery;
  delivery.rejected = set.rejected;
  Progress progress("inject: specimens", static_cast<std::int64_t>(set.specimens.size()));
  const auto all =
      deliver_specimens(run, held, set.specimens,
                        {.name = "inject",
                         .timeout_s = options.timeout_s,
                         .amend = amendment_of(options),
                         .arrived = [&](std::size_t arrived) { progress.set(static_cast<std::int64_t>(arrived)); }});
  const auto is_refused = [](const SpecimenDelivery& one) { return one.delivery == dashboard::Delivery::refused; };
  for (std::size_t i = 0; i < all.size(); ++i) count(all[i], set, i, options.set, delivery);
  if (std::ranges::all_of(all, is_refused))
    throw InputError::format("{}: none of its {} specimens can be sent", options.set, set.specimens.size());
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
  for (const auto& doubt : doubts_about(run, view, set.specimens)) warn(doubt.text);
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
