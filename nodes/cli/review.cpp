// Part of the command line (command.hpp): nacre review, whether replicates agree, and a person's review of a specimen;
// in a run or in a measurement set.

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "command.hpp"
#include "laboratory_view.hpp"
#include "measurement/conditions.hpp"
#include "measurement/consistency.hpp"
#include "measurement/history.hpp"
#include "measurement/set_table.hpp"
#include "output.hpp"
#include "run_access.hpp"
#include "specimen_messages.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {
namespace {

using measurement::ReplicateGroup;
using measurement::SpecimenRecord;

struct ReviewOptions {
  std::string specimen;
  std::string set;
  std::string run = "logs/latest";
  bool valid = false;
  bool invalid = false;
  bool accept = false;
  std::string why;
  std::string by = user_name();
  int revision = 0;
  double timeout_s = 60.0;
  bool json = false;
};

/// A person's review of a specimen.
struct SpecimenReview {
  std::string specimen;
  bool valid = false;
  std::string why;
};

/// A review that holds now; in a set it has no revision.
struct Reviewed {
  SpecimenReview review;
  std::optional<int> revision;
};

/// Of a slip in a specimen's name.
InputError unknown_specimen(const std::string& specimen, const std::string& where, std::size_t specimens) {
  return InputError::format("{}: not in {}: expected the name of one of its {} specimens", specimen, where, specimens);
}

/// A run with its measurements and reviews so far.
struct ReviewedRun {
  RunAccess run;
  game::MeasurementBook book;
  std::map<std::string, int> revisions;  ///< highest of each specimen's reviews
};

ReviewedRun open_reviewed_run(const std::string& folder) {
  ReviewedRun opened{.run = open_run(folder), .book = {}, .revisions = {}};
  opened.book = view_laboratory(opened.run).facts.book;
  opened.revisions = highest_revisions(opened.run);
  return opened;
}

/// Nothing, said on standard error, where another review of the specimen holds.
std::optional<Reviewed> judge_in_run(const ReviewOptions& options, const ReviewedRun& in,
                                     const SpecimenReview& review) {
  const auto& [run, book, revisions] = in;
  const auto specimens = book.specimens();
  const auto specimen = std::find_if(specimens.begin(), specimens.end(),
                                     [&](const auto& each) { return each.specimen == review.specimen; });
  if (specimen == specimens.end()) throw unknown_specimen(review.specimen, options.run, specimens.size());
  if (review.valid) {
    if (const auto reason = book.against_validity(review.specimen)) throw InputError(*reason);
  }
  const auto last = revisions.find(review.specimen);
  const int next = last == revisions.end() ? 1 : last->second + 1;
  const int revision = options.revision > 0 ? options.revision : next;
  if (const auto held = book.review_against(review.specimen, {revision, review.valid, review.why})) {
    remark(fmt::format("{}: revision {} stands: {}valid: {}", review.specimen, held->revision,
                       held->valid ? "" : "not ", held->why));
    return std::nullopt;
  }
  wire::Review message;
  message.specimen = review.specimen;
  message.revision = revision;
  message.valid = review.valid;
  message.by = options.by;
  message.why = review.why;
  const Delivered delivered = deliver(run, "review", {"REVIEW", wire::write(message)}, options.timeout_s);
  if (say_delivered(delivered, options.timeout_s) != 0) return std::nullopt;
  return Reviewed{review, revision};
}

/// Writes the reviews into the table of the set; its curves and everything else stay as they are.
std::vector<Reviewed> judge_in_set(const ReviewOptions& options, const std::vector<SpecimenReview>& reviews) {
  std::vector<Reviewed> reviewed;
  measurement::SetTable table(options.set);
  for (const SpecimenReview& review : reviews) {
    if (!table.holds(review.specimen)) throw unknown_specimen(review.specimen, options.set, table.size());
    table.review(review.specimen, review.valid, fmt::format("{} ({})", review.why, options.by));
    reviewed.push_back({review, std::nullopt});
  }
  table.write(options.set);
  return reviewed;
}

void print_reviewed(const Reviewed& reviewed) {
  fmt::print("{}: {}{}\n", reviewed.review.specimen, reviewed.review.valid ? "valid" : "not valid",
             reviewed.revision ? fmt::format(" (revision {})", *reviewed.revision) : "");
}

void print_reviewed_json(const std::vector<Reviewed>& reviewed) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Reviewed& each : reviewed) {
    nlohmann::ordered_json one{{"specimen", each.review.specimen}, {"valid", each.review.valid}};
    if (each.revision) one["revision"] = *each.revision;
    all.push_back(one);
  }
  print_json({{"reviewed", all}});
}

/// The reviews that hold now.
std::vector<Reviewed> judge_all(const ReviewOptions& options, const std::vector<SpecimenReview>& reviews) {
  if (reviews.empty()) return {};
  if (!options.set.empty()) return judge_in_set(options, reviews);
  const ReviewedRun run = open_reviewed_run(options.run);
  std::vector<Reviewed> reviewed;
  for (const SpecimenReview& review : reviews) {
    if (const auto one = judge_in_run(options, run, review)) reviewed.push_back(*one);
  }
  return reviewed;
}

/// Status 1 where another review of a specimen holds.
int judge(const ReviewOptions& options, const std::vector<SpecimenReview>& reviews) {
  const std::vector<Reviewed> reviewed = judge_all(options, reviews);
  if (options.json) {
    print_reviewed_json(reviewed);
  } else {
    for (const Reviewed& each : reviewed) print_reviewed(each);
  }
  return reviewed.size() == reviews.size() ? 0 : 1;
}

/// Specimens to compare with each other, and how many of them are enough.
struct ReviewMaterial {
  measurement::MeasurementSet set;
  measurement::ConsistencySettings settings;
};

/// Those of the run, where nothing is rejected and the scenario says how many, or of the set.
ReviewMaterial material_to_review(const ReviewOptions& options) {
  ReviewMaterial material;
  if (options.set.empty()) {
    const game::LaboratoryFacts facts = view_laboratory(open_run(options.run)).facts;
    material.set.specimens = facts.book.specimens();
    material.settings = game::consistency_settings(facts);
  } else {
    material.set = measurement::read_measurement_set(options.set);
    warn_about(material.set, options.set);
  }
  return material;
}

nlohmann::ordered_json or_null(std::optional<double> value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json to_json(const ReplicateGroup& group) {
  nlohmann::ordered_json proposed = nlohmann::ordered_json::array();
  for (const auto& outlier : group.proposed) {
    nlohmann::ordered_json reasons = nlohmann::ordered_json::array();
    for (const auto& reason : outlier.reasons)
      reasons.push_back({{"kind", reason.kind}, {"distance", reason.distance}, {"text", reason.text}});
    proposed.push_back({{"specimen", outlier.specimen}, {"reasons", reasons}});
  }
  return {{"pattern", group.design.name()},
          {"test", std::string(tester::to_string(group.test))},
          {"orientation_deg", group.conditions.orientation_deg},
          {"strain_rate_per_s", group.conditions.strain_rate_per_s},
          {"thickness_mm", group.conditions.thickness_mm},
          {"state", std::string(to_string(group.state))},
          {"tested", group.tested},
          {"valid", group.valid},
          {"proposed_outliers", proposed},
          {"wanted", group.wanted},
          {"mean_pa", or_null(group.mean_pa)},
          {"scatter", or_null(group.scatter)},
          {"mean_without_pa", or_null(group.mean_without_pa)},
          {"scatter_without", or_null(group.scatter_without)},
          {"representative", group.representative}};
}

/// What sets a group apart from the standard test of its design; empty for that one.
std::string unusual_conditions(const tester::TestConditions& conditions) {
  const std::string turned = conditions.orientation_deg == 90.0 ? " turned" : "";
  if (measurement::is_standard(conditions)) return turned;
  return fmt::format("{} at {:.3g} /s, {:.3g} mm thick", turned, conditions.strain_rate_per_s, conditions.thickness_mm);
}

/// `-` where no specimen counts; no scatter of a single one.
std::string mean_and_scatter(std::optional<double> mean_pa, std::optional<double> scatter, bool is_modulus) {
  if (!mean_pa) return "-";
  return fmt::format("{} {}{}", shown(*mean_pa * (is_modulus ? 1e-9 : 1e-6)), is_modulus ? "GPa" : "MPa",
                     scatter ? fmt::format(" +- {:.1f} %", 100.0 * *scatter) : "");
}

std::string_view in_words(measurement::GroupState state) {
  switch (state) {
    case measurement::GroupState::complete:
      return "complete";
    case measurement::GroupState::more_needed:
      return "more specimens needed";
    case measurement::GroupState::inconsistent:
      return "the replicates disagree";
  }
  return "";
}

void print_group(const ReplicateGroup& group) {
  const bool is_modulus = group.test == tester::TestKind::modulus;
  fmt::print("{} {}{}: {} ({} tested, {} valid{})  {} {}{}\n", group.design.name(), tester::to_string(group.test),
             unusual_conditions(group.conditions), in_words(group.state), group.tested.size(), group.valid.size(),
             group.wanted > 0 ? fmt::format(", {} more to be tested", group.wanted) : "", is_modulus ? "E" : "T",
             mean_and_scatter(group.mean_pa, group.scatter, is_modulus),
             group.representative.empty() ? "" : fmt::format("  most typical: {}", group.representative));
  for (const auto& outlier : group.proposed) {
    for (const auto& reason : outlier.reasons)
      fmt::print("    {} looks out of line: {}\n", outlier.specimen, reason.text);
  }
  if (!group.proposed.empty()) {
    fmt::print("    without {}: {}\n", group.proposed.size() == 1 ? "it" : "them",
               mean_and_scatter(group.mean_without_pa, group.scatter_without, is_modulus));
  }
}

nlohmann::ordered_json to_json(const measurement::HistoryEffect& effect) {
  return {{"factor", effect.factor},
          {"level", effect.level},
          {"test", std::string(tester::to_string(effect.test))},
          {"relative", effect.relative},
          {"standard_error", effect.standard_error},
          {"specimens", effect.specimens},
          {"notable", effect.notable()}};
}

void print_review_json(const std::vector<ReplicateGroup>& groups,
                       const std::vector<measurement::HistoryEffect>& history,
                       const std::vector<measurement::RejectedRow>& rejected) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array(), effects = all;
  for (const auto& group : groups) all.push_back(to_json(group));
  for (const auto& effect : history) effects.push_back(to_json(effect));
  print_json({{"groups", all}, {"history", effects}, {"rejected", rejected_json(rejected)}});
}

void print_review(const std::vector<ReplicateGroup>& groups, const std::vector<measurement::HistoryEffect>& history) {
  for (const auto& group : groups) print_group(group);
  for (const auto& effect : history) {
    if (!effect.notable()) continue;
    fmt::print("{} {} ({} test, {} specimens): {:+.1f} +- {:.1f} % from the mean of the same designs\n", effect.factor,
               effect.level, tester::to_string(effect.test), effect.specimens, 100.0 * effect.relative,
               100.0 * effect.standard_error);
  }
}

int review(const ReviewOptions& options) {
  if (!options.set.empty() && options.revision > 0)
    throw InputError("nacre review: expected --revision in a run only: the reviews of a set are not numbered");
  if (!options.specimen.empty()) {
    if (options.valid == options.invalid) throw InputError("nacre review: expected either --valid or --invalid");
    if (options.accept) throw InputError("nacre review: expected either a specimen or --accept");
    if (options.why.empty()) throw InputError("nacre review: expected --why with a reason");
    return judge(options, {{options.specimen, options.valid, options.why}});
  }
  if (options.valid || options.invalid)
    throw InputError("nacre review: expected the name of a specimen with --valid or --invalid");
  const auto [set, settings] = material_to_review(options);
  const std::vector<ReplicateGroup> groups = measurement::review_replicates(set.specimens, settings);
  if (!options.accept) {
    const std::vector<measurement::HistoryEffect> history = measurement::history_effects(set.specimens);
    options.json ? print_review_json(groups, history, set.rejected) : print_review(groups, history);
    return 0;
  }
  std::vector<SpecimenReview> reviews;
  for (const ReplicateGroup& group : groups) {
    for (const auto& outlier : group.proposed) {
      const std::string& reason = outlier.reasons.front().text;
      reviews.push_back(
          {outlier.specimen, false, options.why.empty() ? reason : fmt::format("{}: {}", options.why, reason)});
    }
  }
  if (reviews.empty()) remark("no specimen looks out of line");
  return judge(options, reviews);
}

}  // namespace

void add_review(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ReviewOptions>();
  CLI::App& command =
      add_command(app, action, "review", "Show which replicates agree, or declare a measured specimen valid or not",
                  options, review);
  command.add_option("SPECIMEN", options->specimen,
                     "Specimen to declare valid or not; without: show all groups of replicates");
  add_run_option(command, options->run);
  command.add_option("--set", options->set, "Measurement set to review instead of a run");
  command.add_flag("--valid", options->valid, "The specimen counts");
  command.add_flag("--invalid", options->invalid, "The specimen does not count");
  command.add_flag("--accept", options->accept, "Declare all specimens that look out of line not valid");
  command.add_option("--why", options->why, "Reason; it is kept with the run or the set");
  command.add_option("--by", options->by, "Who says so")->default_str("your account");
  command.add_option("--revision", options->revision, "Number of the review; default: one more than the last")
      ->check(CLI::Range(1, 1'000'000'000));
  command.add_option("--timeout-s", options->timeout_s, "How many seconds to wait for the validation agent")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
