#include "diagnosis/fracture_plan.hpp"

#include <algorithm>
#include <array>

#include "base/random.hpp"
#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/fracture_tests.hpp"
#include "diagnosis/planned_runs.hpp"
#include "material/effect_library.hpp"

namespace nacre::diagnosis {
namespace {

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
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = i;
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

/// A plan that grows while its budget lasts.
class Purse {
 public:
  Purse(FracturePlan& plan, int simulations, int first_specimen)
      : plan_(plan), left_(simulations), specimen_(first_specimen) {}
  void add_evaluated(const sysid::EvaluatedModel& model) {
    add(model.parameters, is_base(model.parameters) ? one_of_each_design(plan_) : all_items(plan_), model.specimen);
  }
  /// Whether it could be paid.
  bool buy(const material::ParameterSet& parameters) {
    std::vector<std::size_t> items = is_base(parameters) ? one_of_each_design(plan_) : all_items(plan_);
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

/// Pairs of base models about the centre, so many in all with those that are known. Whether all were paid.
bool buy_base_models(Purse& purse, int& known, int wanted, const material::ParameterSet& centre,
                     const EmulatorRules& rules, RandomStream& random) {
  const int pairs = std::max(0, (wanted - known + 1) / 2);
  known += 2 * pairs;
  return std::ranges::all_of(opposite_pairs(centre, pairs, rules, random),
                             [&](const material::ParameterSet& set) { return purse.buy(set); });
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

}  // namespace

FracturePlan plan_fractures(const std::vector<measurement::SpecimenRecord>& specimens,
                            const std::vector<sysid::EvaluatedModel>& evaluated, int simulations,
                            const DiagnosisSettings& settings) {
  const Procedure& procedure = settings.procedure;
  FracturePlan plan;
  plan.measured =
      fracture_groups(observe(specimens, settings.floor.log_modulus_sd, settings.fracture_discretisation, procedure))
          .measured;
  if (plan.measured.empty()) return plan;
  int base_models = 0, first_free = tester::kFirstCalibrationSpecimen;
  for (const sysid::EvaluatedModel& model : evaluated) {
    base_models += is_base(model.parameters) ? 1 : 0;
    first_free = std::max(first_free, model.specimen + 1);
  }
  Purse purse(plan, simulations, first_free);
  material::ParameterSet centre = settings.start;
  centre.extensions.clear();
  RandomStream random(settings.seed, "diagnosis/runs");
  for (const sysid::EvaluatedModel& model : evaluated) purse.add_evaluated(model);
  bool base_is_known = purse.buy(centre);
  ++base_models;
  const EmulatorRules& rules = procedure.emulator;
  for (std::size_t turn = 0; turn < rules.sizes_in_turn.size(); ++turn) {
    const bool paid = buy_base_models(purse, base_models, rules.models_in_turn[turn], centre, rules, random);
    const auto unpaid = buy_effects(purse, rules.sizes_in_turn[turn], centre, procedure, random);
    if (turn > 0) continue;
    base_is_known = base_is_known && paid;
    plan.unaffordable = unpaid;
  }
  const bool lacks_known = std::ranges::any_of(
      plan.unaffordable, [](const std::string& name) { return is_identified_by_moduli(*material::find_effect(name)); });
  if (!base_is_known || lacks_known) plan.wanted.clear();
  return plan;
}

SimulatedFractures simulated_fractures(const FracturePlan& plan,
                                       const std::vector<std::vector<sysid::Prediction>>& predictions) {
  SimulatedFractures simulated{.runs = {}, .unaffordable = plan.unaffordable};
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
