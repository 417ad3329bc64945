#include "sysid/local_simulator.hpp"

#include <map>
#include <mutex>

#include "base/parallel.hpp"
#include "sysid/prediction_store.hpp"
#include "tester/modulus.hpp"
#include "tester/simulation_key.hpp"
#include "tester/toughness.hpp"

namespace nacre::sysid {
namespace {

/// One simulation, and the key that its prediction is kept under.
struct Task {
  tester::TestKind kind = tester::TestKind::modulus;
  tester::Simulation simulation;
  std::string key;
};

Prediction run(const Task& task) {
  Prediction prediction;
  if (task.kind == tester::TestKind::modulus) {
    if (const auto result = tester::test_modulus(task.simulation)) prediction.modulus_pa = result->modulus_pa;
  } else if (auto result = tester::test_toughness(task.simulation)) {
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

  Task task_of(const measurement::Replicates& measured, const material::ParameterSet& parameters,
               tester::TestKind kind) const {
    Task task{kind, {measured.design, parameters, measured.conditions, fidelity}, {}};
    task.key = tester::simulation_key(task.simulation, kind);
    return task;
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
  const auto for_each_test = [&](const WantedEvaluation& evaluation, std::size_t item, auto&& body) {
    for (const tester::TestKind kind : {tester::TestKind::modulus, tester::TestKind::toughness}) {
      const bool wanted = kind == tester::TestKind::modulus ? evaluation.modulus : evaluation.toughness;
      if (wanted) body(state_->task_of(measured[item], evaluation.parameters, kind));
    }
  };
  std::map<std::string, bool> listed;
  for (const WantedEvaluation& evaluation : evaluations) {
    for (const std::size_t item : evaluation.items) {
      for_each_test(evaluation, item, [&](Task task) {
        if (state_->known.find(task.key) == nullptr && listed.try_emplace(task.key, true).second)
          tasks.push_back(std::move(task));
      });
    }
  }
  std::mutex one_at_a_time;
  parallel_for(
      static_cast<int>(tasks.size()),
      [&](int index) {
        const std::size_t k = static_cast<std::size_t>(index);
        const Prediction prediction = run(tasks[k]);
        const std::lock_guard lock(one_at_a_time);
        state_->known.put(tasks[k].key, prediction);
        if (done) done();
      },
      state_->threads);
  state_->simulations += static_cast<int>(tasks.size());
  std::vector<std::vector<Prediction>> predictions;
  for (const WantedEvaluation& evaluation : evaluations) {
    auto& of_items = predictions.emplace_back();
    for (const std::size_t item : evaluation.items) {
      Prediction& prediction = of_items.emplace_back();
      for_each_test(evaluation, item, [&](const Task& task) {
        const Prediction& known = *state_->known.find(task.key);
        if (known.modulus_pa) prediction.modulus_pa = known.modulus_pa;
        if (!known.toughness_pa) return;
        prediction.toughness_pa = known.toughness_pa;
        prediction.curve = known.curve;
      });
    }
  }
  return predictions;
}

}  // namespace nacre::sysid
