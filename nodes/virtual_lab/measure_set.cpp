// The laboratory as a batch tool.

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "virtual_lab/laboratory.hpp"

namespace nacre::virtual_laboratory {
namespace {

using measurement::SpecimenRecord;

/// What is to be measured: every design once per test, in the order given.
std::vector<Question> questions_of(const Truth& truth, const std::vector<pattern::Design>& designs,
                                   const std::vector<tester::TestKind>& tests) {
  std::vector<Question> questions;
  for (const pattern::Design& design : designs) {
    for (const tester::TestKind test : tests) {
      const Question question{.design = design, .test = test, .conditions = {}, .fidelity = truth.fidelity};
      if (std::ranges::find(questions, question) == questions.end()) questions.push_back(question);
    }
  }
  return questions;
}

/// Numbers the specimens of each batch 1, 2, ... in an order drawn from the seed.
void shuffle_print_order(std::vector<SpecimenRecord>& records, std::uint64_t seed) {
  std::map<std::string, std::vector<std::pair<std::uint64_t, SpecimenRecord*>>> batches;
  for (SpecimenRecord& record : records) {
    RandomStream stream(seed, fmt::format("print/{}/{}", record.batch, record.specimen));
    batches[record.batch].emplace_back(stream.bits(), &record);
  }
  for (auto& [batch, specimens] : batches) {
    std::ranges::sort(specimens, {}, &std::pair<std::uint64_t, SpecimenRecord*>::first);
    int position = 0;
    for (auto& [draw, record] : specimens) record->print_order = ++position;
  }
}

/// Beside the set's folder, not in it.
std::filesystem::path truth_file(std::filesystem::path folder) {
  if (folder.filename().empty()) folder = folder.parent_path();  // SET/
  return folder.concat(".truth.toml");
}

}  // namespace

std::vector<SpecimenRecord> measure(const Truth& truth, const std::vector<pattern::Design>& designs,
                                    const std::vector<tester::TestKind>& tests) {
  const std::vector<Question> questions = questions_of(truth, designs, tests);
  std::vector<std::optional<Result<Response>>> responses(questions.size());
  parallel_for(static_cast<int>(questions.size()), [&](int i) {
    const auto q = static_cast<std::size_t>(i);
    responses[q] = respond(truth, questions[q]);
  });
  std::vector<SpecimenRecord> records;
  for (std::size_t q = 0; q < questions.size(); ++q) {
    for (int k = 1; k <= truth.replicates; ++k) {
      const std::string name =
          fmt::format("{}-{}-{}", questions[q].design.name(), tester::to_string(questions[q].test), k);
      records.push_back(record_specimen(truth, questions[q], *responses[q],
                                        {.specimen = name, .batch = fmt::format("batch-{}", k), .print_order = 0}));
    }
  }
  shuffle_print_order(records, truth.seed);
  return records;
}

std::vector<SpecimenRecord> measure_set(const std::filesystem::path& laboratory_file,
                                        const std::filesystem::path& folder,
                                        const std::vector<pattern::Design>& designs,
                                        const std::vector<tester::TestKind>& tests) {
  const Truth truth = read_laboratory(laboratory_file);
  std::vector<SpecimenRecord> records = measure(truth, designs, tests);
  measurement::write_measurement_set(folder, records);
  write_sealed(truth_file(folder), truth);
  return records;
}

}  // namespace nacre::virtual_laboratory
