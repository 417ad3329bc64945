#include "diagnosis/fracture_plan.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>

#include "base/random.hpp"
#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/data.hpp"
#include "diagnosis/fracture_tests.hpp"
#include "diagnosis/global_fit.hpp"
#include "diagnosis/planned_runs.hpp"
#include "material/effect_library.hpp"

namespace nacre::diagnosis {
namespace {

constexpr std::size_t kStages = 3;

/// By their signal over noise at typical size on sixteen layouts with four replicates (docs/studies/blind-trials).
constexpr std::array<std::string_view, 6> kShownBest = {"rigid_yield",          "progressive_damage",
                                                        "interface_anisotropy", "residual_strain",
                                                        "blunt_notch",          "tension_only_failure"};

std::size_t rank_of(const material::Effect& effect) {
  const bool first = is_identified_by_moduli(effect);
  const auto place = std::ranges::find(kShownBest, effect.name) - kShownBest.begin();
  return (first ? 0 : kShownBest.size() + 1) + static_cast<std::size_t>(place);
}

std::vector<const material::Effect*> in_turn() {
  std::vector<const material::Effect*> effects = fracture_effects();
  std::ranges::stable_sort(effects, {}, [](const material::Effect* effect) { return rank_of(*effect); });
  return effects;
}

std::vector<std::size_t> all_items(const FracturePlan& plan) {
  std::vector<std::size_t> items(plan.measured.size());
  std::iota(items.begin(), items.end(), std::size_t{0});
  return items;
}

/// One group of each design: turned twins and other rates are the same specimens to a base model.
std::vector<std::size_t> one_of_each_design(const FracturePlan& plan) {
  std::vector<std::size_t> items;
  for (std::size_t i = 0; i < plan.measured.size(); ++i)
    if (std::ranges::none_of(items,
                             [&](std::size_t other) { return plan.measured[other].design == plan.measured[i].design; }))
      items.push_back(i);
  return items;
}

/// To a simulation, which knows nothing of the testing machine.
bool is_base(const material::ParameterSet& parameters) { return simulated_side(parameters).extensions.empty(); }

std::vector<std::size_t> items_of(const FracturePlan& plan, const material::ParameterSet& parameters) {
  return is_base(parameters) ? one_of_each_design(plan) : all_items(plan);
}

/// A plan that grows while its budget lasts.
class Purse {
 public:
  Purse(FracturePlan& plan, int simulations, int first_specimen)
      : plan_(plan), left_(simulations), specimen_(first_specimen) {}
  void add_evaluated(const sysid::EvaluatedModel& model) {
    add(model.parameters, items_of(plan_, model.parameters), model.specimen);
  }
  /// Whether it could be paid.
  bool buy(const material::ParameterSet& parameters) {
    std::vector<std::size_t> items = items_of(plan_, parameters);
    if (std::cmp_less(left_, items.size())) return false;
    left_ -= static_cast<int>(items.size());
    add(parameters, std::move(items), specimen_++);
    return true;
  }

 private:
  void add(const material::ParameterSet& parameters, std::vector<std::size_t> items, int specimen) {
    plan_.wanted.push_back({.id = std::to_string(plan_.wanted.size()),
                            .parameters = parameters,
                            .toughness = true,
                            .items = std::move(items),
                            .first_specimen = specimen});
  }

  FracturePlan& plan_;
  int left_;
  int specimen_;
};

/// What is known before a stage, and what may still be spent.
struct Account {
  int base_models = 0;
  int first_free = tester::kFirstCalibrationSpecimen;  ///< number of a specimen that no model broke
  int simulations = 0;
};

Account account_of(const std::vector<sysid::EvaluatedModel>& evaluated, int simulations,
                   const std::vector<SimulatedPlan>& done) {
  Account account{.simulations = simulations};
  const auto count = [&](const material::ParameterSet& parameters, int specimen) {
    account.base_models += is_base(parameters) ? 1 : 0;
    account.first_free = std::max(account.first_free, specimen + 1);
  };
  if (done.empty())
    for (const sysid::EvaluatedModel& model : evaluated) count(model.parameters, model.specimen);
  for (std::size_t stage = 0; stage < done.size(); ++stage)
    for (std::size_t k = 0; k < done[stage].plan.wanted.size(); ++k) {
      const sysid::WantedEvaluation& wanted = done[stage].plan.wanted[k];
      count(wanted.parameters, wanted.first_specimen);
      if (stage > 0 || k >= evaluated.size()) account.simulations -= static_cast<int>(wanted.items.size());
    }
  return account;
}

/// Base models about the centre, so many in all with those that are known.
void buy_base_models(Purse& purse, int& known, int wanted, const material::ParameterSet& centre,
                     const EmulatorRules& rules, RandomStream& random) {
  for (const material::ParameterSet& set : opposite_pairs(centre, std::max(0, (wanted - known + 1) / 2), rules, random))
    known += purse.buy(set) ? 1 : 0;
}

/// Effects one after the other at this size. Those that were not paid for.
std::vector<std::string> buy_effects(Purse& purse, double size, const material::ParameterSet& centre,
                                     const Procedure& procedure, RandomStream& random) {
  std::vector<std::string> unpaid;
  for (const material::Effect* effect : in_turn()) {
    const auto set = with_effect(centre, *effect, size, procedure.constants, procedure.emulator, random);
    if (!set || !purse.buy(*set)) unpaid.emplace_back(effect->name);
  }
  return unpaid;
}

/// Simulations of the first two stages, and of the effects that moduli identify: without these the fracture tests would
/// stand in the way of what is known.
int least_cost(const FracturePlan& plan, const Account& account, const EmulatorRules& rules) {
  const int missing = std::max(0, rules.models_in_turn.front() - account.base_models - 1);
  const int base_models = 1 + 2 * ((missing + 1) / 2) + 1 + 2 * rules.near_pairs;
  const auto identified =
      std::ranges::count_if(fracture_effects(), [](const auto* effect) { return is_identified_by_moduli(*effect); });
  return base_models * static_cast<int>(one_of_each_design(plan).size()) +
         static_cast<int>(identified) * static_cast<int>(plan.measured.size());
}

/// The base model that fits the fracture tests best, by what was simulated so far.
material::ParameterSet fitted_base(std::vector<measurement::SpecimenRecord> specimens,
                                   const std::vector<SimulatedPlan>& done, DiagnosisSettings settings) {
  std::erase_if(specimens, [](const auto& specimen) { return specimen.test != tester::TestKind::toughness; });
  settings.fractures = simulated_fractures(done);
  for (const material::Effect* effect : fracture_effects())
    settings.fractures->unaffordable.emplace_back(effect->name);  // none is in question yet
  const Data data = data_of(specimens, settings);
  const FitRules& rules = settings.procedure.fit;
  material::ParameterSet fitted = done.back().plan.centre;
  fitted.toughness =
      global_fit(data.model, data.observations, rules, {}, {at_centre(data.model, data.observations, rules, {})})
          .parameters.toughness;
  return fitted;
}

}  // namespace

std::optional<FracturePlan> next_fractures(const std::vector<measurement::SpecimenRecord>& specimens,
                                           const std::vector<sysid::EvaluatedModel>& evaluated, int simulations,
                                           const DiagnosisSettings& settings, const std::vector<SimulatedPlan>& done) {
  if (done.size() == kStages) return std::nullopt;
  const EmulatorRules& rules = settings.procedure.emulator;
  FracturePlan plan{.measured = fracture_groups(observe(specimens, settings.floor.log_modulus_sd,
                                                        settings.fracture_discretisation, settings.procedure))
                                    .measured,
                    .wanted = {},
                    .centre = settings.start,
                    .unaffordable = {}};
  Account account = account_of(evaluated, simulations, done);
  if (plan.measured.empty()) return std::nullopt;
  if (done.empty() && least_cost(plan, account, rules) > simulations) return std::nullopt;
  RandomStream random(settings.seed, fmt::format("diagnosis/fractures {}", done.size()));
  Purse purse(plan, account.simulations, account.first_free);
  plan.centre.extensions.clear();
  if (!done.empty()) plan.centre = fitted_base(specimens, done, settings);
  switch (done.size()) {
    case 0:
      for (const sysid::EvaluatedModel& model : evaluated) purse.add_evaluated(model);
      account.base_models += purse.buy(plan.centre) ? 1 : 0;
      buy_base_models(purse, account.base_models, rules.models_in_turn.front(), plan.centre, rules, random);
      break;
    case 1:
      purse.buy(plan.centre);
      for (const material::ParameterSet& set : opposite_pairs(plan.centre, rules.near_pairs, rules, random))
        purse.buy(set);
      break;
    default:
      for (std::size_t turn = 0; turn < rules.sizes_in_turn.size(); ++turn) {
        if (turn > 0)
          buy_base_models(purse, account.base_models, rules.models_in_turn[turn], plan.centre, rules, random);
        const auto unpaid = buy_effects(purse, rules.sizes_in_turn[turn], plan.centre, settings.procedure, random);
        if (turn == 0) plan.unaffordable = unpaid;
      }
  }
  return plan;
}

SimulatedFractures simulated_fractures(const std::vector<SimulatedPlan>& done) {
  SimulatedFractures simulated{.runs = {}, .unaffordable = done.back().plan.unaffordable};
  simulated.centre = done.back().plan.centre.toughness;
  for (const auto& [plan, predictions] : done)
    for (std::size_t k = 0; k < plan.wanted.size(); ++k) {
      const std::vector<std::size_t>& items = plan.wanted[k].items;
      FractureRun run{simulated_side(plan.wanted[k].parameters), {}};
      for (const measurement::Replicates& group : plan.measured) {
        const auto own = [&](std::size_t item) { return plan.measured[item].design == group.design; };
        const auto same = [&](std::size_t item) { return &plan.measured[item] == &group; };
        auto found = std::ranges::find_if(items, same);
        if (found == items.end()) found = std::ranges::find_if(items, own);
        run.predictions.push_back(predictions[k][found - items.begin()]);
      }
      simulated.runs.push_back(std::move(run));
    }
  return simulated;
}

}  // namespace nacre::diagnosis
