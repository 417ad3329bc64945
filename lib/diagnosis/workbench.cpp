#include "diagnosis/workbench.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.hpp"
#include "base/result.hpp"
#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/words.hpp"
#include "material/effect_library.hpp"
#include "sysid/eta.hpp"
#include "sysid/objective.hpp"

namespace nacre::diagnosis {
namespace {

void move_eta(material::ToughnessParameters& parameters, double spread, double sign,
              const std::vector<double>& normal) {
  material::ToughnessVector eta = to_vector(parameters);
  for (std::size_t k = 0; k < sysid::kSearchedEta.size(); ++k)
    eta[sysid::kSearchedEta[k]] *= std::exp(sign * spread * normal[k]);
  parameters = material::toughness_from_vector(eta);
}

std::vector<double> normals(RandomStream& random) {
  std::vector<double> values(sysid::kSearchedEta.size());
  for (double& value : values) value = random.normal();
  return values;
}

/// The centre, pairs around it, and every effect of the material on fractures at several sizes.
std::vector<material::ParameterSet> planned_runs(const Basis& basis, const EmulatorRules& rules, std::uint64_t seed) {
  const material::ParameterSet& centre = basis.centre;
  std::vector<material::ParameterSet> sets = {centre};
  RandomStream random(seed, "diagnosis/runs");
  for (int k = 0; k < rules.pairs; ++k) {
    const std::vector<double> normal = normals(random);
    for (const double sign : {1.0, -1.0}) {
      sets.push_back(centre);
      move_eta(sets.back().toughness, rules.spread, sign, normal);
    }
  }
  for (const material::Effect& effect : material::effect_library()) {
    if (!effect.acts_on_toughness || effect.side != material::EffectSide::material) continue;
    const std::vector<std::string> names = {std::string(effect.name)};
    const CoordinateMap map(
        Basis{.modulus = false, .toughness = true, .coupon = false, .centre = centre, .rules = basis.rules}, names);
    const int own = map.base_count();
    for (const double sign : {1.0, -1.0}) {
      if (sign < 0.0 && map.lower(own) >= 0.0) continue;
      for (const double size : rules.effect_sizes) {
        Eigen::VectorXd u = map.coordinates(centre);
        u[own] = std::clamp(sign * size, map.lower(own), map.upper(own));
        for (int i = own + 1; i < map.size(); ++i) u[i] = map.usual(i);
        sets.push_back(map.parameters(u));
        move_eta(sets.back().toughness, rules.jitter, 1.0, normals(random));
      }
    }
  }
  return sets;
}

/// Effects that have a signature in these rows, in the order of material::effect_library().
std::vector<std::string> acting_effects(const FeatureModel& model, const Observations& observations,
                                        const FitRules& rules) {
  const CoordinateMap base = model.base_map();
  const Eigen::VectorXd start = base.coordinates(model.basis().centre), plain = model.predict(base, start);
  std::vector<Eigen::Index> rows(observations.size());
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  const bool moduli_alone = std::ranges::all_of(
      observations.groups, [](const Observation& group) { return group.test == tester::TestKind::modulus; });
  std::vector<std::string> acting;
  for (const material::Effect& effect : material::effect_library()) {
    if (moduli_alone && !is_identified_by_moduli(effect)) continue;
    const std::vector<std::string> names = {std::string(effect.name)};
    const CoordinateMap map = model.map(names);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(map.size());
    u.head(start.size()) = start;
    const int own = map.base_count();
    for (int i = own + 1; i < map.size(); ++i) u[i] = map.usual(i);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(observations.size());
    for (const double size : rules.probes) {
      u[own] = std::clamp(size, map.lower(own), map.upper(own));
      change = change.cwiseMax((model.predict(map, u) - plain).cwiseAbs());
    }
    if (has_signature(effect, change, observations, rows)) acting.push_back(names.front());
  }
  return acting;
}

}  // namespace

Workbench::Workbench(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings)
    : observations_(
          observe(specimens, settings.floor.log_modulus_sd, settings.fracture_discretisation, settings.procedure)),
      fidelity_(settings.fidelity) {
  if (const auto few = too_few(observations_.groups, settings.procedure.noise)) throw TooFewSpecimens(in_words(*few));
  material::ParameterSet centre = settings.start;
  centre.extensions.clear();
  if (observations_.has(tester::TestKind::toughness)) {
    runs_ = std::make_unique<FractureRuns>(observations_, settings.fidelity, settings.store, settings.threads);
    const auto searching = [&](double share, std::string_view) {
      if (settings.progress) settings.progress(0.15 * share, "calibrating the fracture tester");
    };
    if (settings.search_budget > 0)
      centre.toughness =
          runs_->search(settings.start, settings.ranges, settings.search_budget, settings.seed, searching);
    surface_ = std::make_unique<FractureSurface>(observations_, *runs_, centre.toughness, settings.procedure.emulator);
  }
  const Basis basis = basis_for(observations_, centre, settings.ranges, settings.procedure.constants);
  model_ = std::make_unique<FeatureModel>(observations_, basis, settings.fidelity, surface_.get());
  if (runs_) simulate_around(settings);
  effects_ = acting_effects(*model_, observations_, settings.procedure.fit);
}

void Workbench::simulate_around(const DiagnosisSettings& settings) {
  const std::vector<material::ParameterSet> sets =
      planned_runs(model_->basis(), settings.procedure.emulator, settings.seed);
  const double all = static_cast<double>(sets.size() * runs_->groups().size());
  int count = 0;
  runs_->add(sets, [&] {
    ++count;
    if (settings.progress)
      settings.progress(0.15 + 0.4 * std::min(1.0, count / all),
                        fmt::format("fracture tests around the calibration: {} of at most {:.0f}", count, all));
  });
  learn();
}

void Workbench::learn() {
  surface_->learn();
  observations_.emulator_variance = Eigen::VectorXd::Zero(observations_.size());
  for (std::size_t k = 0; k < surface_->rows().size(); ++k)
    observations_.emulator_variance[surface_->rows()[k].row] = surface_->cross_validated_variance()[k];
}

double Workbench::refine(const std::vector<material::ParameterSet>& sets) {
  if (!runs_) return 0.0;
  std::vector<Eigen::VectorXd> expected;
  for (const material::ParameterSet& set : sets) expected.push_back(surface_->predict(simulated_side(set)));
  const std::size_t before = runs_->runs().size();
  runs_->add(sets);
  double largest = 0.0;
  for (std::size_t k = before; k < runs_->runs().size(); ++k) {
    const FractureRun& run = runs_->runs()[k];
    const auto own = std::find_if(sets.begin(), sets.end(), [&](const auto& set) {
      return simulated_side(set).toughness == run.parameters.toughness &&
             simulated_side(set).extensions == run.parameters.extensions;
    });
    double squares = 0.0;
    int count = 0;
    for (std::size_t r = 0; r < surface_->rows().size(); ++r) {
      const SurfaceRow& row = surface_->rows()[r];
      const auto value = value_of(shown_features(run.predictions[row.group], {}, observations_.reading), row.feature);
      const double variance = surface_->cross_validated_variance()[r];
      if (!value || variance <= 0.0) continue;
      squares += std::pow(*value - expected[own - sets.begin()][r], 2) / variance;
      ++count;
    }
    if (count > 0) largest = std::max(largest, std::sqrt(squares / count));
  }
  if (runs_->runs().size() > before) learn();
  return largest;
}

tester::Curve Workbench::curve_at(int group, const FittedModel& fit) const {
  const Observation& g = observations_.groups[group];
  if (g.test == tester::TestKind::tensile)
    return model_->coupon_curve(g, model_->map(fit.effects).coupon_parameters(fit.u));
  if (g.test != tester::TestKind::toughness) return {};
  const material::ParameterSet simulated = simulated_side(fit.parameters);
  const auto eta = to_vector(simulated.toughness);
  const FractureRun* nearest = nullptr;
  double least = 0.0;
  for (const FractureRun& run : runs_->runs()) {
    double distance = 0.0;
    const auto other = to_vector(run.parameters.toughness);
    for (const std::size_t i : sysid::kSearchedEta) distance += std::pow(std::log(eta[i] / other[i]), 2);
    for (const material::Effect& effect : material::effect_library()) {
      const auto strength = [&](const material::ParameterSet& set) {
        return material::strength_of(effect.parameters.front(), material::extension_value(set.extensions, effect.name));
      };
      distance += std::pow((strength(simulated) - strength(run.parameters)) / 0.1, 2);
    }
    if (nearest == nullptr || distance < least) least = distance, nearest = &run;
  }
  const auto place = std::find(runs_->groups().begin(), runs_->groups().end(), group) - runs_->groups().begin();
  const double batch_step = observations_.groups[group].batch_step;
  return sysid::observed(nearest->predictions[place], fit.parameters.extensions, {.batch_step = batch_step}).curve;
}

}  // namespace nacre::diagnosis
