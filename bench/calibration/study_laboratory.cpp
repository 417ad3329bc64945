#include "study_laboratory.hpp"

#include <fmt/format.h>

#include <mutex>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/laboratory_file.hpp"
#include "sysid/prediction_store.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::calibration_study {
namespace {

using laboratory::Experiment;
using laboratory::TrueResponse;
using tester::TestKind;

constexpr TestKind kTests[] = {TestKind::modulus, TestKind::toughness};

Experiment experiment_of(const laboratory::Truth& truth, const pattern::Design& design, TestKind test) {
  return {.design = design, .test = test, .conditions = {}, .fidelity = truth.fidelity};
}

/// Without scatter and machine, which act on the response. With the kernel's version, since geometry and loading are
/// shared with the testers.
std::string key_of(const laboratory::Truth& truth, const Experiment& experiment) {
  laboratory::Truth response_only = truth;
  response_only.replicates = 1;
  response_only.noise = {};
  return fmt::format("v{}/{}/{}/{}", tester::kKernelVersion, laboratory::to_toml(response_only),
                     experiment.design.name(), tester::to_string(experiment.test));
}

sysid::Prediction simulated(const laboratory::Truth& truth, const Experiment& experiment) {
  sysid::Prediction prediction;
  const auto response = laboratory::respond(truth, experiment);
  if (!response) return prediction;
  if (experiment.test == TestKind::modulus) prediction.modulus_pa = response->modulus_pa;
  if (experiment.test == TestKind::toughness) {
    prediction.toughness_pa = tester::area_under(response->curve);
    prediction.curve = response->curve;
  }
  return prediction;
}

}  // namespace

laboratory::Truth study_truth(std::uint64_t seed, tester::Fidelity fidelity) {
  laboratory::Truth truth;
  truth.seed = seed;
  truth.fidelity = fidelity;
  truth.noise = {.modulus = 0.01, .toughness = 0.05, .strain = 0.01};
  truth.modulus = laboratory::draw_modulus_parameters(seed);
  truth.toughness = laboratory::draw_toughness_parameters(seed);
  return truth;
}

std::vector<measurement::SpecimenRecord> measure(const laboratory::Truth& truth,
                                                 const std::vector<pattern::Design>& designs,
                                                 const std::filesystem::path& store_file, const MayGoOn& may_go_on) {
  sysid::PredictionStore store(store_file);
  std::vector<Experiment> missing;
  for (const pattern::Design& design : designs) {
    for (const TestKind test : kTests) {
      const Experiment experiment = experiment_of(truth, design, test);
      if (store.find(key_of(truth, experiment)) == nullptr) missing.push_back(experiment);
    }
  }
  std::mutex one_at_a_time;
  parallel_for(static_cast<int>(missing.size()), [&](int i) {
    may_go_on();
    const Experiment& experiment = missing[i];
    const sysid::Prediction prediction = simulated(truth, experiment);
    const std::lock_guard lock(one_at_a_time);
    store.put(key_of(truth, experiment), prediction);
  });
  std::vector<measurement::SpecimenRecord> records;
  for (const pattern::Design& design : designs) {
    for (const TestKind test : kTests) {
      const Experiment experiment = experiment_of(truth, design, test);
      const sysid::Prediction& known = *store.find(key_of(truth, experiment));
      Result<TrueResponse> response =
          TrueResponse{.modulus_pa = known.modulus_pa.value_or(0.0), .curve = known.curve, .remark = {}};
      if (!known.modulus_pa && !known.toughness_pa) response = fail("the simulation failed");
      for (int k = 1; k <= truth.replicates; ++k) {
        const std::string name = fmt::format("{}-{}-{}", design.name(), tester::to_string(test), k);
        records.push_back(laboratory::record_specimen(
            truth, experiment, response, {.specimen = name, .batch = fmt::format("batch-{}", k), .print_order = 0}));
      }
    }
  }
  return records;
}

}  // namespace nacre::calibration_study
