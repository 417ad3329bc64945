#include "floor_rows.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/random.hpp"
#include "base/result.hpp"
#include "explore/gamut_csv.hpp"
#include "material/criterion_strengths.hpp"
#include "material/ranges.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"
#include "tester/modulus.hpp"
#include "tester/refinement.hpp"

namespace nacre::discretisation_floor {
namespace {

/// The first `count` patterns of a gamut by rank, within a rank in order of evaluation.
std::vector<pattern::Pattern> best_of_gamut(int count, const std::string& file) {
  const std::vector<explore::Evaluated> gamut = explore::read_gamut_csv(file);
  if (static_cast<int>(gamut.size()) < count)
    throw InputError::format("{}: expected at least {} patterns, it has {}", file, count, gamut.size());
  std::vector<optimize::Performance> performances;
  for (const explore::Evaluated& each : gamut) performances.push_back(each.performance);
  const std::vector<int> ranks = optimize::non_dominated_ranks(performances);
  std::vector<std::size_t> order(gamut.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return ranks[i]; });
  std::vector<pattern::Pattern> best;
  for (int i = 0; i < count; ++i) best.push_back(gamut[order[i]].pattern);
  return best;
}

double drawn(const material::ParameterRange& range, RandomStream& random) {
  return material::from_unit(range, random.uniform(0.25, 0.75));
}

}  // namespace

void add_options(CLI::App& app, FloorOptions& options) {
  app.add_option("--layouts", options.layouts, "Half random (50-85 % rigid), half the best of the gamut")
      ->check(CLI::Range(12, 1000));
  app.add_option("--sets", options.sets, "Parameter sets, the defaults first")->check(CLI::Range(1, 100));
  app.add_option("--gamut", options.gamut, "gamut.csv of nacre explore")->check(CLI::ExistingFile);
  app.add_option("--specimens", options.specimens, "Numbers 0 to n - 1 of every design, the same on both meshes")
      ->check(CLI::Range(1, 1000));
  study::add_fidelity_option(app, options.fidelity);
  study::add_table_options(app, options.table, "layouts and parameter sets");
}

FloorPlan plan_of(const FloorOptions& options) {
  return {.fidelity = *tester::fidelity_from_string(options.fidelity),
          .seed = options.table.seed,
          .layouts = floor_layouts(options.layouts, options.gamut, options.table.seed),
          .sets = floor_parameter_sets(options.sets, options.table.seed),
          .specimens = options.specimens};
}

std::vector<pattern::Pattern> floor_layouts(int count, const std::string& gamut_file, std::uint64_t seed) {
  RandomStream random(seed, "numerics floor");
  const std::vector<pattern::Pattern> stratified = pattern::stratified_patterns(count / 2, random);
  const std::vector<pattern::Pattern> best = best_of_gamut(count - count / 2, gamut_file);
  std::vector<pattern::Pattern> layouts;
  for (std::size_t i = 0; i < best.size(); ++i) {  // in turn, so that a study cut short has both kinds
    layouts.push_back(best[i]);
    if (i < stratified.size()) layouts.push_back(stratified[i]);
  }
  return layouts;
}

std::vector<material::ParameterSet> floor_parameter_sets(int count, std::uint64_t seed) {
  RandomStream random(seed, "numerics floor/parameters");
  std::vector<material::ParameterSet> sets = {material::default_parameters()};
  while (static_cast<int>(sets.size()) < count) {
    material::ModulusVector theta{};
    material::ToughnessVector eta{};
    const auto theta_ranges = material::default_ranges().modulus(material::FitTarget::microstructures);
    const auto eta_ranges = material::default_ranges().toughness(material::FitTarget::microstructures);
    for (std::size_t i = 0; i < theta.size(); ++i) theta[i] = drawn(theta_ranges[i], random);
    for (std::size_t i = 0; i < eta.size(); ++i) eta[i] = drawn(eta_ranges[i], random);
    material::ParameterSet set = material::default_parameters();
    set.modulus = material::modulus_from_vector(theta);
    set.toughness = material::toughness_from_vector(eta);
    sets.push_back(set);
  }
  return sets;
}

double modulus_pa(const FloorPlan& plan, const pattern::Pattern& layout, const material::ModulusParameters& theta,
                  int refinement) {
  tester::Simulation simulation{layout, material::default_parameters(), {}, plan.fidelity};
  simulation.parameters.modulus = theta;
  const Result<tester::ModulusResult> result = tester::test_modulus(simulation, {.refinement = refinement});
  if (!result) throw InputError::format("{}: {}", layout.key(), result.error().message);
  return result->modulus_pa;
}

std::string toughness_key(const FloorPlan& plan, std::size_t layout, std::size_t set, int refinement, int specimen) {
  const material::ParameterSet& parameters = plan.sets[set];
  const material::FailureCriterion& criterion = parameters.criterion;
  std::string failure(material::to_string(criterion.kind));
  if (criterion.kind == material::CriterionKind::neighbourhood) failure += fmt::format(" {}", criterion.radius_m);
  if (criterion.kind == material::CriterionKind::crack_band) failure += fmt::format(" {}", criterion.softening);
  for (const auto& [name, values] : parameters.extensions) failure += fmt::format(" {} {}", name, values.front());
  return fmt::format("{} {} {} {} {} {} cv {} specimen {}", tester::to_string(plan.fidelity), plan.seed,
                     plan.layouts[layout].key(), set, refinement, failure, parameters.strength_cv, specimen);
}

FloorPlan with_criterion(FloorPlan plan, const material::FailureCriterion& criterion, double strength_cv) {
  for (material::ParameterSet& set : plan.sets) {
    set.toughness = material::with_strengths(
        set.toughness, material::strength_ratio(criterion) / material::strength_ratio(set.criterion));
    set.criterion = criterion;
    set.strength_cv = strength_cv;
  }
  return plan;
}

study::Wanted wanted_fracture_test(const FloorPlan& plan, std::size_t layout, std::size_t set, int refinement,
                                   int specimen) {
  const std::string key = toughness_key(plan, layout, set, refinement, specimen);
  const tester::Simulation simulation{
      plan.layouts[layout], tester::refined(plan.sets[set], refinement), {}, plan.fidelity, specimen};
  return {key, [=]() -> std::vector<double> {
            const auto result = tester::test_toughness(simulation, {.refinement = refinement});
            if (result) return {result->toughness_pa, result->peak_stress_pa, result->failure_strain};
            fmt::print(stderr, "{}: {}\n", key, result.error().message);
            return {0.0, 0.0, 0.0};
          }};
}

std::vector<study::Wanted> wanted_fracture_tests(const FloorPlan& plan) {
  std::vector<study::Wanted> wanted;
  for (int specimen = 0; specimen < plan.specimens; ++specimen)
    for (std::size_t pass = 0; pass < static_cast<std::size_t>(plan.sets_per_layout); ++pass)
      for (std::size_t i = 0; i < plan.layouts.size(); ++i)
        for (const int refinement : {1, 2})
          wanted.push_back(wanted_fracture_test(plan, i, (i + pass) % plan.sets.size(), refinement, specimen));
  return wanted;
}

}  // namespace nacre::discretisation_floor
