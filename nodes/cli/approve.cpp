// nacre approve: a person's yes or no to proposed designs. nacre review: a judgement on a measured specimen.

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "command.hpp"
#include "nacre/approval_t.hpp"
#include "nacre/review_t.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "wire/codec.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {
namespace {

std::string user_name() {
  const char* name = std::getenv("USER");
  return name == nullptr || *name == '\0' ? "unknown" : name;
}

struct ApproveOptions {
  std::vector<std::string> designs;
  std::string run = "logs/latest";
  bool reject = false;
  bool all = false;
  std::string why;
  std::string by = user_name();
  double timeout_s = 60.0;
};

/// The newest proposal that the validation agent has.
std::optional<wire::Proposal> newest_proposal(const RunAccess& run) {
  std::optional<wire::Proposal> newest;
  for (const std::string& payload : received_by_validation_agent(run, "PROPOSAL")) {
    auto proposal = wire::read<wire::Proposal>(payload);
    if (proposal && (!newest || proposal->round >= newest->round)) newest = std::move(*proposal);
  }
  return newest;
}

std::vector<std::string> designs_meant(const ApproveOptions& options, const wire::Proposal& proposal) {
  std::vector<std::string> proposed;
  for (const auto& design : proposal.designs) proposed.push_back(design.design.name());
  if (options.all) return proposed;
  std::vector<std::string> meant;
  for (const std::string& argument : options.designs) {
    const std::string name = pattern::design_from_argument(argument).name();
    if (std::find(proposed.begin(), proposed.end(), name) == proposed.end()) {
      throw InputError::format("{}: not among the designs of proposal {}: expected one of {}", argument, proposal.round,
                               fmt::join(proposed, ", "));
    }
    meant.push_back(name);
  }
  return meant;
}

int approve(const ApproveOptions& options) {
  const RunAccess run = open_run(options.run);
  const auto proposal = newest_proposal(run);
  if (!proposal) {
    remark("there is no proposal yet");
    return 1;
  }
  if (options.designs.empty() && !options.all) {
    fmt::print("proposal {}:\n", proposal->round);
    for (const auto& design : proposal->designs) {
      fmt::print("{}  E {:.4f} GPa  T {:.4f} MPa  {}\n", design.design.name(), 1e-9 * design.modulus_pa,
                 1e-6 * design.toughness_pa, design.reason);
    }
    return 0;
  }
  for (const std::string& design : designs_meant(options, *proposal)) {
    approval_t message{};
    message.round = proposal->round;
    message.design = design;
    message.approved = !options.reject;
    message.by = options.by;
    message.why = options.why;
    if (deliver(run, "approve", {"APPROVAL", wire::encode(message)}, options.timeout_s) != 0) return 1;
    fmt::print("{} {}\n", design, options.reject ? "rejected" : "approved");
  }
  return 0;
}

struct ReviewOptions {
  std::string specimen;
  std::string run = "logs/latest";
  bool valid = false;
  bool invalid = false;
  std::string why;
  std::string by = user_name();
  int revision = 0;
  double timeout_s = 60.0;
};

/// One more than the highest revision so far, so that this judgement wins.
int next_revision(const RunAccess& run, const std::string& specimen) {
  int highest = 0;
  for (const std::string& payload : received_by_validation_agent(run, "REVIEW")) {
    const auto review = wire::decode_safe<review_t>(payload);
    if (review && review->specimen == specimen) highest = std::max<int>(highest, review->revision);
  }
  return highest + 1;
}

bool is_measured(const RunAccess& run, const std::string& specimen) {
  for (const std::string& payload : received_by_validation_agent(run, "MEASUREMENT")) {
    const auto measurement = wire::read<wire::Measurement>(payload);
    if (measurement && measurement->record.specimen == specimen) return true;
  }
  return false;
}

int review(const ReviewOptions& options) {
  if (options.valid == options.invalid) throw InputError("nacre review: expected either --valid or --invalid");
  const RunAccess run = open_run(options.run);
  if (!is_measured(run, options.specimen)) {
    warn(fmt::format("{}: the validation agent has no specimen of this name yet", options.specimen));
  }
  review_t message{};
  message.specimen = options.specimen;
  message.revision = options.revision > 0 ? options.revision : next_revision(run, options.specimen);
  message.valid = options.valid;
  message.by = options.by;
  message.why = options.why;
  const int status = deliver(run, "review", {"REVIEW", wire::encode(message)}, options.timeout_s);
  if (status == 0) {
    fmt::print("{}: {} (revision {})\n", options.specimen, options.valid ? "valid" : "not valid", message.revision);
  }
  return status;
}

}  // namespace

void add_approve(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ApproveOptions>();
  CLI::App& command = add_command(app, action, "approve",
                                  "Say yes or no to proposed designs; without designs: list them", options, approve);
  command.add_option("DESIGN", options->designs, "Pattern file or key of a proposed design");
  add_run_option(command, options->run);
  command.add_flag("--all", options->all, "All designs of the newest proposal");
  command.add_flag("--reject", options->reject, "Say no");
  command.add_option("--why", options->why, "Reason, kept with the run");
  command.add_option("--by", options->by, "Who decides")->capture_default_str();
  command.add_option("--timeout-s", options->timeout_s, "How long to wait for the validation agent")
      ->capture_default_str();
}

void add_review(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ReviewOptions>();
  CLI::App& command = add_command(app, action, "review", "Judge a measured specimen valid or not", options, review);
  command.add_option("SPECIMEN", options->specimen, "Name of the specimen")->required();
  add_run_option(command, options->run);
  command.add_flag("--valid", options->valid, "It counts");
  command.add_flag("--invalid", options->invalid, "It does not count");
  command.add_option("--why", options->why, "Reason, kept with the run")->required();
  command.add_option("--by", options->by, "Who judges")->capture_default_str();
  command.add_option("--revision", options->revision, "Number of the judgement; default: one more than the last")
      ->check(CLI::PositiveNumber);
  command.add_option("--timeout-s", options->timeout_s, "How long to wait for the validation agent")
      ->capture_default_str();
}

}  // namespace nacre::cli
