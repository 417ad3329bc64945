#include "study_laboratory.hpp"

#include <fmt/format.h>

#include <mutex>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/laboratory_file.hpp"
#include "material/criterion_strengths.hpp"
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
std::string key_of(const laboratory::Truth& truth, const Experiment& experiment, int number) {
  laboratory::Truth response_only = truth;
  response_only.noise = {};
  return fmt::format("v{}/{}/{}/{}/{}", tester::kKernelVersion, laboratory::to_toml(response_only),
                     experiment.design.name(), tester::to_string(experiment.test), number);
}

/// Specimens of an experiment that differ: each replicate of a fracture test, one modulus for all.
int specimens_of(const laboratory::Truth& truth, const Experiment& experiment) {
  return experiment.test == TestKind::toughness ? truth.replicates : 1;
}

/// What the specimens of an experiment responded, none where the simulation failed.
std::vector<sysid::Prediction> simulated(const laboratory::Truth& truth, const Experiment& experiment) {
  std::vector<sysid::Prediction> specimens(specimens_of(truth, experiment));
  const auto response = laboratory::respond(truth, experiment);
  if (!response) return specimens;
  if (experiment.test == TestKind::modulus) specimens.front().modulus_pa = response->modulus_pa;
  if (experiment.test != TestKind::toughness) return specimens;
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    specimens[k].curve = k == 0 ? response->curve : response->other_curves[k - 1];
    specimens[k].toughness_pa = tester::area_under(specimens[k].curve);
  }
  return specimens;
}

/// The response again, from what was kept of its specimens.
Result<TrueResponse> response_of(const laboratory::Truth& truth, const Experiment& experiment,
                                 const sysid::PredictionStore& store) {
  TrueResponse response;
  for (int number = 1; number <= specimens_of(truth, experiment); ++number) {
    const sysid::Prediction& known = *store.find(key_of(truth, experiment, number));
    if (!known.modulus_pa && !known.toughness_pa) return fail("the simulation failed");
    if (number > 1) {
      response.other_curves.push_back(known.curve);
    } else {
      response.modulus_pa = known.modulus_pa.value_or(0.0);
      response.curve = known.curve;
    }
  }
  return response;
}

}  // namespace

laboratory::Truth study_truth(std::uint64_t seed, tester::Fidelity fidelity, material::CriterionKind criterion) {
  laboratory::Truth truth = laboratory::draw_truth(seed, fidelity);
  truth.effects = {};
  truth.criterion.kind = criterion;
  truth.toughness =
      material::with_strengths(laboratory::draw_toughness_parameters(seed), material::strength_ratio(truth.criterion));
  return truth;
}

material::ParameterSet as_tester_parameters(const laboratory::Truth& truth) {
  material::ParameterSet set = material::default_parameters();
  set.modulus = truth.modulus;
  set.toughness = material::with_strengths(laboratory::draw_toughness_parameters(truth.seed),
                                           material::strength_ratio(set.criterion));
  set.strength_cv = truth.strength_cv;
  return set;
}

std::vector<measurement::SpecimenRecord> measure(const laboratory::Truth& truth,
                                                 const std::vector<pattern::Design>& designs,
                                                 const std::filesystem::path& store_file, const MayGoOn& may_go_on) {
  sysid::PredictionStore store(store_file);
  std::vector<Experiment> missing;
  for (const pattern::Design& design : designs) {
    for (const TestKind test : kTests) {
      const Experiment experiment = experiment_of(truth, design, test);
      if (store.find(key_of(truth, experiment, specimens_of(truth, experiment))) == nullptr)
        missing.push_back(experiment);
    }
  }
  std::mutex one_at_a_time;
  parallel_for(static_cast<int>(missing.size()), [&](int i) {
    may_go_on();
    const Experiment& experiment = missing[i];
    const std::vector<sysid::Prediction> specimens = simulated(truth, experiment);
    const std::lock_guard lock(one_at_a_time);
    int number = 0;
    for (const sysid::Prediction& specimen : specimens) store.put(key_of(truth, experiment, ++number), specimen);
  });
  std::vector<measurement::SpecimenRecord> records;
  for (const pattern::Design& design : designs) {
    for (const TestKind test : kTests) {
      const Experiment experiment = experiment_of(truth, design, test);
      const Result<TrueResponse> response = response_of(truth, experiment, store);
      for (int k = 1; k <= truth.replicates; ++k) {
        const std::string name = fmt::format("{}-{}-{}", design.name(), tester::to_string(test), k);
        records.push_back(laboratory::record_specimen(
            truth, experiment, response,
            {.specimen = name, .batch = fmt::format("batch-{}", k), .print_order = 0, .number = k}));
      }
    }
  }
  return records;
}

}  // namespace nacre::calibration_study
