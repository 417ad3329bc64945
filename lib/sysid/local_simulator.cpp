#include "sysid/local_simulator.hpp"

#include <map>
#include <mutex>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/statistics.hpp"
#include "sysid/prediction_store.hpp"
#include "tester/modulus.hpp"
#include "tester/refinement.hpp"
#include "tester/simulation_key.hpp"
#include "tester/strength_field.hpp"
#include "tester/toughness.hpp"

namespace nacre::sysid {
namespace {

/// One simulation, and the key that its prediction is kept under.
struct Task {
  tester::TestKind kind = tester::TestKind::modulus;
  tester::Simulation simulation;
  int refinement = 1;
  std::string key;
};

Prediction run(const Task& task) {
  Prediction prediction;
  if (task.kind == tester::TestKind::modulus) {
    if (const auto result = tester::test_modulus(task.simulation)) prediction.modulus_pa = result->modulus_pa;
  } else if (auto result = tester::test_toughness(task.simulation, {.refinement = task.refinement})) {
    prediction.toughness_pa = result->toughness_pa;
    prediction.curve = std::move(result->curve);
  }
  return prediction;
}

}  // namespace

struct LocalSimulator::State {
  tester::Fidelity fidelity;
  int threads;
  PredictionStore known;
  int simulations = 0;

  Task task_of(const measurement::Replicates& measured, const material::ParameterSet& parameters, tester::TestKind kind,
               int specimen = 0, int refinement = 1) const {
    Task task{kind,
              {measured.design, tester::refined(parameters, refinement), measured.conditions, fidelity, specimen},
              refinement,
              {}};
    task.key = tester::simulation_key(task.simulation, kind);
    if (refinement > 1) task.key += fmt::format("/h{}", refinement);
    return task;
  }

  /// The simulations of one design in an evaluation: where specimens are alike, one stands for all.
  std::vector<Task> tasks_of(const measurement::Replicates& measured, const WantedEvaluation& evaluation) const {
    std::vector<Task> tasks;
    if (evaluation.modulus) tasks.push_back(task_of(measured, evaluation.parameters, tester::TestKind::modulus));
    if (!evaluation.toughness) return tasks;
    const int count = tester::specimens_differ(evaluation.parameters) ? evaluation.specimens : 1;
    for (int i = 0; i < count; ++i)
      tasks.push_back(task_of(measured, evaluation.parameters, tester::TestKind::toughness,
                              evaluation.first_specimen + i, evaluation.refinement));
    return tasks;
  }

  /// From what is known of its tasks. T is the mean over specimens, the curve that of the first.
  Prediction prediction_of(const std::vector<Task>& tasks) const {
    Prediction prediction;
    std::vector<double> toughness_pa;
    for (const Task& task : tasks) {
      const Prediction& one = *known.find(task.key);
      if (one.modulus_pa) prediction.modulus_pa = one.modulus_pa;
      if (!one.toughness_pa) continue;
      if (toughness_pa.empty()) prediction.curve = one.curve;
      toughness_pa.push_back(*one.toughness_pa);
    }
    if (toughness_pa.empty()) return prediction;
    prediction.toughness_pa = mean(toughness_pa);
    prediction.specimens = toughness_pa.size();
    if (toughness_pa.size() > 1) prediction.toughness_sd_pa = standard_deviation(toughness_pa);
    return prediction;
  }
};

LocalSimulator::LocalSimulator(tester::Fidelity fidelity, int threads, const std::filesystem::path& store)
    : state_(std::make_unique<State>(
          State{fidelity, threads, store.empty() ? PredictionStore() : PredictionStore(store), 0})) {}
LocalSimulator::~LocalSimulator() = default;

int LocalSimulator::simulations() const { return state_->simulations; }

std::vector<std::vector<Prediction>> LocalSimulator::simulate(const std::vector<measurement::Replicates>& measured,
                                                              const std::vector<WantedEvaluation>& evaluations,
                                                              const std::function<void()>& done) {
  std::vector<Task> tasks;
  std::map<std::string, bool> listed;
  for (const WantedEvaluation& evaluation : evaluations) {
    for (const std::size_t item : evaluation.items) {
      for (Task& task : state_->tasks_of(measured[item], evaluation)) {
        if (state_->known.find(task.key) == nullptr && listed.try_emplace(task.key, true).second)
          tasks.push_back(std::move(task));
      }
    }
  }
  std::mutex one_at_a_time;
  parallel_for(
      tasks.size(),
      [&](int index) {
        const std::size_t k = index;
        const Prediction prediction = run(tasks[k]);
        const std::lock_guard lock(one_at_a_time);
        state_->known.put(tasks[k].key, prediction);
        if (done) done();
      },
      state_->threads);
  state_->simulations += tasks.size();
  std::vector<std::vector<Prediction>> predictions;
  for (const WantedEvaluation& evaluation : evaluations) {
    auto& of_items = predictions.emplace_back();
    for (const std::size_t item : evaluation.items)
      of_items.push_back(state_->prediction_of(state_->tasks_of(measured[item], evaluation)));
  }
  return predictions;
}

}  // namespace nacre::sysid
