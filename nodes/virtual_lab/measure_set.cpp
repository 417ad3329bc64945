// The laboratory as a batch tool.

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/set_table.hpp"
#include "virtual_lab/laboratory.hpp"

namespace nacre::virtual_laboratory {
namespace {

using measurement::SpecimenRecord;

constexpr double kTurnedDeg = 90.0;

/// What is to be measured: every design once per test and orientation, in the order given.
std::vector<Question> questions_of(const Truth& truth, const Campaign& campaign) {
  std::vector<Question> questions;
  for (const pattern::Design& design : campaign.designs) {
    for (const tester::TestKind test : campaign.tests) {
      for (const double orientation_deg : campaign.orientations_deg) {
        Question question{.design = design, .test = test, .conditions = {}, .fidelity = truth.fidelity};
        if (design.layout() != nullptr) question.conditions.orientation_deg = orientation_deg;
        if (std::ranges::find(questions, question) == questions.end()) questions.push_back(question);
      }
    }
  }
  return questions;
}

/// Simulated time of a question, in arbitrary units: a fracture takes thousands of times longer than a modulus.
double effort_of(const Question& question) { return question.test == tester::TestKind::modulus ? 1.0 : 1000.0; }

/// Asks all of them, reporting as they come in.
std::vector<Result<Response>> responses_to(const Truth& truth, const std::vector<Question>& questions,
                                           const CampaignProgress& progress) {
  std::vector<std::optional<Result<Response>>> responses(questions.size());
  double whole = 0.0, spent = 0.0;
  for (const Question& question : questions) whole += effort_of(question);
  int done = 0;
  std::mutex mutex;
  parallel_for(static_cast<int>(questions.size()), [&](int i) {
    const auto q = static_cast<std::size_t>(i);
    responses[q] = respond(truth, questions[q]);
    const std::lock_guard lock(mutex);
    spent += effort_of(questions[q]);
    if (progress) progress(spent / whole, ++done, static_cast<int>(questions.size()));
  });
  std::vector<Result<Response>> all;
  for (auto& response : responses) all.push_back(*std::move(response));
  return all;
}

/// A specimen to be recorded: which question it answers, and which replicate it is.
struct Planned {
  std::size_t question = 0;
  Replicate replicate;
};

/// Numbers the specimens of each batch 1, 2, ... in an order drawn from the seed.
void shuffle_print_order(std::vector<Planned>& plan, std::uint64_t seed) {
  std::map<std::string, std::vector<std::pair<std::uint64_t, Replicate*>>> batches;
  for (Planned& planned : plan) {
    const Replicate& replicate = planned.replicate;
    RandomStream stream(seed, fmt::format("print/{}/{}", replicate.batch, replicate.specimen));
    batches[replicate.batch].emplace_back(stream.bits(), &planned.replicate);
  }
  for (auto& [batch, specimens] : batches) {
    std::ranges::sort(specimens, {}, &std::pair<std::uint64_t, Replicate*>::first);
    int position = 0;
    for (auto& [draw, replicate] : specimens) replicate->print_order = ++position;
  }
}

/// Beside the set's folder, not in it.
std::filesystem::path truth_file(const std::filesystem::path& folder) {
  // Not `.` or `SET/..`, which have no name.
  return without_last_slash(std::filesystem::weakly_canonical(folder)).concat(".truth.toml");
}

/// A set is not measured over: judgements, and the truth beside it, belong to the specimens that it holds.
void require_new(const std::filesystem::path& folder) {
  std::error_code unreadable;
  if (std::filesystem::exists(folder / measurement::kTableName, unreadable)) {
    throw InputError::format("{}: holds {} specimens; expected a new folder", folder.string(),
                             measurement::SetTable(folder).size());
  }
  const std::filesystem::path truth = truth_file(folder);
  if (!std::filesystem::exists(truth, unreadable)) return;
  throw InputError::format("{}: is the truth of a set that was measured before; expected a new folder", truth.string());
}

}  // namespace

std::vector<SpecimenRecord> measure(const Truth& truth, const Campaign& campaign, const CampaignProgress& progress) {
  const std::vector<Question> questions = questions_of(truth, campaign);
  const std::vector<Result<Response>> responses = responses_to(truth, questions, progress);
  std::vector<Planned> plan;
  for (std::size_t q = 0; q < questions.size(); ++q) {
    const Question& question = questions[q];
    const char* turned = question.conditions.orientation_deg == kTurnedDeg ? "turned-" : "";
    for (int k = 1; k <= truth.replicates; ++k) {
      const std::string name =
          fmt::format("{}-{}-{}{}", question.design.name(), tester::to_string(question.test), turned, k);
      plan.push_back({q, {.specimen = name, .batch = fmt::format("batch-{}", k), .print_order = 0, .number = k}});
    }
  }
  shuffle_print_order(plan, truth.seed);
  std::vector<SpecimenRecord> records;
  for (const Planned& each : plan)
    records.push_back(record_specimen(truth, questions[each.question], responses[each.question], each.replicate));
  return records;
}

std::vector<SpecimenRecord> measure_set(const std::filesystem::path& laboratory_file,
                                        const std::filesystem::path& folder, const Campaign& campaign,
                                        const CampaignProgress& progress) {
  const Truth truth = read_laboratory(laboratory_file);
  require_new(folder);
  std::vector<SpecimenRecord> records = measure(truth, campaign, progress);
  measurement::write_measurement_set(folder, records);
  write_sealed(truth_file(folder), truth);
  return records;
}

}  // namespace nacre::virtual_laboratory
