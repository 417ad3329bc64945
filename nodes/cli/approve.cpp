// Part of the command line (command.hpp): nacre approve, a person's yes or no to proposed designs, and designs of their
// own.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "command.hpp"
#include "design_words.hpp"
#include "laboratory_view.hpp"
#include "output.hpp"
#include "run/journal_messages.hpp"
#include "run_access.hpp"
#include "shortlist.hpp"
#include "wire/convert.hpp"
#include "withdraw.hpp"

namespace nacre::cli {
namespace {

struct ApproveOptions {
  std::vector<std::string> designs;
  std::string run = "logs/latest";
  bool reject = false;
  bool all = false;
  bool add = false;
  bool withdraw = false;
  bool undo = false;
  std::string shortlist;
  std::string why;
  std::string by = user_name();
  double timeout_s = 60.0;
};

/// The designs of the family stage, once it has chosen them; decided on under the round that they are ordered in.
std::optional<wire::Proposal> variants_to_approve(const RunAccess& run) {
  std::map<int, wire::CalibratedFamily> families;
  for (const std::string& payload : run::sent_by(run.folder, "validation_agent", "FAMILY"))
    if (auto family = wire::read<wire::CalibratedFamily>(payload)) families[family->number] = std::move(*family);
  if (families.empty() || static_cast<int>(families.size()) < families.begin()->second.count) return std::nullopt;
  wire::Proposal proposal;
  for (const auto& [number, family] : families) {
    proposal.round = family.round;
    for (const game::FamilyDesign& design : family.designs) {
      if (design.is_seed) continue;
      proposal.designs.push_back({.design = design.pattern,
                                  .modulus_pa = design.family_model.modulus_pa.value_or(0.0),
                                  .toughness_pa = design.family_model.toughness_pa.value_or(0.0),
                                  .bin = -1,
                                  .reason = "variant of " + family.name});
    }
  }
  return proposal;
}

/// The designs that the validation agent wants approved or rejected now.
std::optional<wire::Proposal> open_proposal(const RunAccess& run, const LaboratoryView& laboratory) {
  const std::optional<wire::Proposal> variants = variants_to_approve(run);
  return variants ? variants : laboratory.open_proposal;
}

std::vector<pattern::Design> designs_meant(const ApproveOptions& options, const wire::Proposal& proposal) {
  std::vector<pattern::Design> proposed;
  for (const auto& design : proposal.designs) proposed.push_back(design.design);
  if (options.all) return proposed;
  std::vector<pattern::Design> meant;
  for (const std::string& argument : options.designs) {
    const pattern::Design design = pattern::design_from_argument(argument);
    if (std::find(proposed.begin(), proposed.end(), design) == proposed.end()) {
      std::vector<std::string> names;
      for (const pattern::Design& each : proposed) names.push_back(each.name());
      throw InputError::format("{}: not among the designs proposed in round {}: expected one of {}", argument,
                               proposal.round, fmt::join(names, ", "));
    }
    meant.push_back(design);
  }
  return meant;
}

std::string_view word(bool approved) { return approved ? "approved" : "rejected"; }

/// What became of it; also said on standard error where it does not count.
Delivered send(const ApproveOptions& options, const RunAccess& run, const game::StatedApproval& decision) {
  wire::Approval message;
  message.round = decision.proposal_round;
  message.design = decision.design;
  message.approved = decision.approved;
  message.by = decision.by;
  message.why = decision.why;
  const Delivered delivered = deliver(run, "approve", {"APPROVAL", wire::write(message)}, options.timeout_s);
  say_delivered(delivered, options.timeout_s);
  return delivered;
}

/// How far each design of the run has come, by name.
std::map<std::string, game::DesignStage> stages_in(const game::LaboratoryFacts& facts) {
  std::map<std::string, game::DesignStage> stages;
  for (const game::DesignState& state : game::design_states(facts)) stages.emplace(state.design.name(), state.stage);
  return stages;
}

/// The round that is played; nothing when the game is over.
std::optional<int> round_played(const RunAccess& run) {
  int played = 0;
  for (const std::string& payload : run::sent_by(run.folder, "validation_agent", "ROUND")) {
    const auto round = wire::read<wire::RoundSummary>(payload);
    if (!round) continue;
    if (round->last) return std::nullopt;
    played = round->round + 1;
  }
  return played;
}

/// What becomes of a design of a person's own that the validation agent has. Status 1 when it is not measured.
int say_when_measured(const RunAccess& run, const pattern::Design& design) {
  const auto played = round_played(run);
  if (game::are_both_ordered(view_laboratory(run).facts.orders, design)) {
    fmt::print("{} added: ordered now\n", design.name());
  } else if (played && (*played < run.scenario.rounds || run.scenario.families.enabled)) {
    fmt::print("{} added: to be ordered in the next round\n", design.name());
  } else {
    remark(fmt::format("{} will not be measured: the last round is measured already, and none follows", design.name()));
    return 1;
  }
  return 0;
}

/// One decision. Status 1 when it changes nothing; nothing where a node did not confirm it. `say_taken` says what comes
/// of one that counts, and returns its status.
std::optional<int> enter(const ApproveOptions& options, const RunAccess& run, const game::LaboratoryFacts& facts,
                         const game::StatedApproval& decision, const std::function<int()>& say_taken) {
  if (const auto reason = game::why_void(facts, decision, run.scenario.validation.approval)) {
    remark(*reason);
    return 1;
  }
  const Delivered delivered = send(options, run, decision);
  if (!delivered.missing.empty()) return std::nullopt;
  return delivered.refusal ? 1 : say_taken();
}

/// A design that nobody proposed, to be measured with the rest. Status 1 when it is ordered already, or no round is
/// left to measure it in.
std::optional<int> add_own(const ApproveOptions& options, const RunAccess& run, const game::LaboratoryFacts& facts,
                           const pattern::Design& design) {
  return enter(options, run, facts, {-1, design, true, options.by, options.why},
               [&] { return say_when_measured(run, design); });
}

/// Yes or no to a design of a proposal. Status 1 when it was decided on before, the other way.
std::optional<int> decide(const ApproveOptions& options, const RunAccess& run, const game::LaboratoryFacts& facts,
                          int round, const pattern::Design& design) {
  return enter(options, run, facts, {round, design, !options.reject, options.by, options.why}, [&] {
    fmt::print("{} {}\n", design.name(), word(!options.reject));
    return 0;
  });
}

/// The worst status of all; the first one that no node confirms ends it.
int each_of(const std::vector<pattern::Design>& designs,
            const std::function<std::optional<int>(const pattern::Design&)>& enter) {
  int status = 0;
  for (const pattern::Design& design : designs) {
    const std::optional<int> one = enter(design);
    if (!one) return 1;
    status = std::max(status, *one);
  }
  return status;
}

bool is_over(const RunAccess& run) {
  const bool over = !round_played(run);
  if (over) remark("the game is over: nothing more will be measured");
  return over;
}

/// Designs of a person's own.
int add_own(const ApproveOptions& options, const RunAccess& run) {
  if (options.designs.empty()) throw InputError("nacre approve --add: expected designs to add");
  if (options.all) throw InputError("nacre approve: expected --add alone, without --all");
  std::vector<pattern::Design> designs;
  for (const std::string& argument : options.designs) designs.push_back(pattern::design_from_argument(argument));
  if (is_over(run)) return 1;
  const game::LaboratoryFacts facts = view_laboratory(run).facts;
  return each_of(designs, [&](const pattern::Design& design) { return add_own(options, run, facts, design); });
}

/// A shortlist: designs that wait in the proposal are approved there, others added.
int approve_listed(const ApproveOptions& options, const RunAccess& run) {
  const std::vector<pattern::Design> designs = read_shortlist(options.shortlist);
  if (is_over(run)) return 1;
  const LaboratoryView laboratory = view_laboratory(run);
  const auto proposal = open_proposal(run, laboratory);
  const std::map<std::string, game::DesignStage> stages = stages_in(laboratory.facts);
  const auto waits = [&](const pattern::Design& design) {
    if (!proposal || !run.scenario.validation.approval) return false;
    const auto known = stages.find(design.name());
    if (known != stages.end() && known->second != game::DesignStage::pending) return false;
    return std::ranges::any_of(proposal->designs, [&](const auto& each) { return each.design == design; });
  };
  return each_of(designs, [&](const pattern::Design& design) {
    return waits(design) ? decide(options, run, laboratory.facts, proposal->round, design)
                         : add_own(options, run, laboratory.facts, design);
  });
}

/// "0.431 +- 0.012 MPa (8 specimens, scatter 8 %)": with its standard error, where T is the mean of several.
std::string toughness_in_words(const wire::ProposedDesign& design) {
  const std::string mean = shown(1e-6 * design.toughness_pa);
  if (design.specimens < 2) return mean + " MPa";
  return fmt::format("{} +- {} MPa ({} specimens, scatter {:.0f} %)", mean,
                     shown(1e-6 * design.toughness_sd_pa / std::sqrt(design.specimens)), design.specimens,
                     100.0 * design.toughness_sd_pa / design.toughness_pa);
}

/// The designs, each with its state, and how many wait for a person.
void list_designs(const LaboratoryView& laboratory, const wire::Proposal& proposal, bool waits_for_approval) {
  const std::map<std::string, game::DesignStage> stages = stages_in(laboratory.facts);
  fmt::print("proposed in round {}, with predicted E and T:\n", proposal.round);
  int waiting = 0;
  for (const auto& design : proposal.designs) {
    const auto known = stages.find(design.design.name());
    const auto stage = known == stages.end() ? game::DesignStage::pending : known->second;
    if (stage == game::DesignStage::pending) ++waiting;
    fmt::print("{}  {:18}  E {} GPa  T {}  {}\n", design.design.name(), stage_in_words(stage, waits_for_approval),
               shown(1e-9 * design.modulus_pa), toughness_in_words(design), design.reason);
  }
  if (waits_for_approval && waiting > 0) fmt::print("{}\n", waiting_in_words(waiting));
}

/// Throws InputError where it is not clear which designs are meant.
void check_designs_meant(const ApproveOptions& options) {
  const int ways = options.add + options.reject + options.withdraw + options.undo;
  if (ways > 1) throw InputError("nacre approve: expected one of --add, --reject, --withdraw and --undo");
  if (!options.shortlist.empty() && (ways > 0 || options.all || !options.designs.empty()))
    throw InputError("nacre approve: expected --shortlist alone, without designs, --add, --all or --reject");
  if (options.add) return;
  if (options.withdraw || options.undo) {
    if (options.designs.empty() || options.all)
      throw InputError::format("nacre approve --{}: expected designs or orders by name",
                               options.undo ? "undo" : "withdraw");
    if (options.withdraw && options.why.empty())
      throw InputError("nacre approve --withdraw: expected --reason with why it cannot be made");
    return;
  }
  if (options.all && !options.designs.empty())
    throw InputError("nacre approve: expected either designs or --all, not both");
  if (options.reject && !options.all && options.designs.empty())
    throw InputError("nacre approve --reject: expected designs to reject, or --all");
}

int approve(const ApproveOptions& options) {
  check_designs_meant(options);
  const RunAccess run = open_run(options.run);
  if (options.add) return add_own(options, run);
  if (options.withdraw || options.undo)
    return change_orders(run, options.designs, {.withdrawn = options.withdraw, .by = options.by, .why = options.why},
                         options.timeout_s);
  if (!options.shortlist.empty()) return approve_listed(options, run);
  const LaboratoryView laboratory = view_laboratory(run);
  const auto proposal = open_proposal(run, laboratory);
  if (!proposal) {
    remark("nothing is proposed yet");
    return 1;
  }
  if (options.designs.empty() && !options.all) {
    list_designs(laboratory, *proposal, waits_for_approval(run, laboratory));
    fmt::print("{}", price_line(run, laboratory));
    return 0;
  }
  return each_of(designs_meant(options, *proposal), [&](const pattern::Design& design) {
    return decide(options, run, laboratory.facts, proposal->round, design);
  });
}

}  // namespace

void add_approve(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ApproveOptions>();
  CLI::App& command = add_command(app, action, "approve",
                                  "Approve or reject proposed designs; without designs: list them", options, approve);
  command.add_option(
      "DESIGN", options->designs,
      std::string("Proposed design; with --add any design; with --withdraw and --undo also an order. ") + kDesignWords);
  add_run_option(command, options->run);
  command.add_flag("--all", options->all, "All designs that were proposed last");
  command.add_flag("--add", options->add, "Add designs of your own, to be measured with the others");
  command.add_option(
      "--shortlist", options->shortlist,
      "CSV of the dashboard's shortlist (column design): approve what waits in the proposal, add the rest");
  command.add_flag("--reject", options->reject, "Reject them");
  command.add_flag("--withdraw", options->withdraw,
                   "Withdraw what is open of their orders, which cannot be made: the round closes without");
  command.add_flag("--undo", options->undo, "Give withdrawn orders again, while their round is measured");
  command.add_option("--why", options->why, "Reason; it is kept with the run");
  command.add_option("--reason", options->why, "The same as --why");
  command.add_option("--by", options->by, "Who decides")->default_str("your account");
  command.add_option("--timeout-s", options->timeout_s, "How many seconds to wait for the validation agent")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
}

}  // namespace nacre::cli
