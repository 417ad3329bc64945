#include "study_laboratory.hpp"

#include <fmt/format.h>

#include <mutex>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "sysid/prediction_store.hpp"

namespace nacre::calibration_study {
namespace {

using tester::TestKind;
using virtual_laboratory::Question;
using virtual_laboratory::Response;

constexpr TestKind kTests[] = {TestKind::modulus, TestKind::toughness};

Question question_of(const virtual_laboratory::Truth& truth, const pattern::Design& design, TestKind test) {
  return {.design = design, .test = test, .conditions = {}, .fidelity = truth.fidelity};
}

/// Scatter and the machine come after the response, so that they are no part of the key. The version keeps laboratories
/// of different releases apart: geometry and loading are shared with the testers.
std::string key_of(const virtual_laboratory::Truth& truth, const Question& question) {
  virtual_laboratory::Truth response_only = truth;
  response_only.replicates = 1;
  response_only.noise = {};
  return fmt::format("v{}/{}/{}/{}", tester::kKernelVersion, virtual_laboratory::to_toml(response_only),
                     question.design.name(), tester::to_string(question.test));
}

sysid::Prediction simulated(const virtual_laboratory::Truth& truth, const Question& question) {
  sysid::Prediction answer;
  const auto response = virtual_laboratory::respond(truth, question);
  if (!response) return answer;
  if (question.test == TestKind::modulus) answer.modulus_pa = response->modulus_pa;
  if (question.test == TestKind::toughness) {
    answer.toughness_pa = tester::area_under(response->curve);
    answer.curve = response->curve;
  }
  return answer;
}

}  // namespace

virtual_laboratory::Truth study_truth(std::uint64_t seed, tester::Fidelity fidelity) {
  virtual_laboratory::Truth truth;
  truth.seed = seed;
  truth.fidelity = fidelity;
  truth.noise = {.modulus = 0.01, .toughness = 0.05, .strain = 0.01};
  truth.modulus = virtual_laboratory::draw_modulus_parameters(seed);
  truth.toughness = virtual_laboratory::draw_toughness_parameters(seed);
  return truth;
}

std::vector<measurement::SpecimenRecord> measure(const virtual_laboratory::Truth& truth,
                                                 const std::vector<pattern::Design>& designs,
                                                 const std::filesystem::path& store_file, const MayGoOn& may_go_on) {
  sysid::PredictionStore store(store_file);
  std::vector<Question> unknown;
  for (const pattern::Design& design : designs) {
    for (const TestKind test : kTests) {
      const Question question = question_of(truth, design, test);
      if (store.find(key_of(truth, question)) == nullptr) unknown.push_back(question);
    }
  }
  std::mutex one_at_a_time;
  parallel_for(static_cast<int>(unknown.size()), [&](int i) {
    may_go_on();
    const Question& question = unknown[static_cast<std::size_t>(i)];
    const sysid::Prediction answer = simulated(truth, question);
    const std::lock_guard lock(one_at_a_time);
    store.put(key_of(truth, question), answer);
  });
  std::vector<measurement::SpecimenRecord> records;
  for (const pattern::Design& design : designs) {
    for (const TestKind test : kTests) {
      const Question question = question_of(truth, design, test);
      const sysid::Prediction& known = *store.find(key_of(truth, question));
      Result<Response> response =
          Response{.modulus_pa = known.modulus_pa.value_or(0.0), .curve = known.curve, .remark = {}};
      if (!known.modulus_pa && !known.toughness_pa) response = fail("the simulation failed");
      for (int k = 1; k <= truth.replicates; ++k) {
        const std::string name = fmt::format("{}-{}-{}", design.name(), tester::to_string(test), k);
        records.push_back(virtual_laboratory::record_specimen(
            truth, question, response, {.specimen = name, .batch = fmt::format("batch-{}", k), .print_order = 0}));
      }
    }
  }
  return records;
}

}  // namespace nacre::calibration_study
