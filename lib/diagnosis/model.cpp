#include "diagnosis/model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.hpp"
#include "diagnosis/other_materials.hpp"
#include "material/surroundings_laws.hpp"
#include "material/temperature_shift.hpp"
#include "measurement/held_strain.hpp"
#include "tester/coupon_law.hpp"
#include "tester/elastic_key.hpp"
#include "tester/modulus.hpp"
#include "tester/paused_pull.hpp"
#include "tester/relaxation.hpp"
#include "tester/tensile.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

/// Value of a feature that the model does not show: no toe, no set, and the way back as steep as the way up.
double unshown(const FeatureValues& values, Feature feature) {
  return feature == Feature::log_unloading ? value_of(values, Feature::log_tangent_30).value_or(0.0) : 0.0;
}

/// The parameters of homogeneous specimens in the surroundings of a test.
material::ParameterSet in_surroundings(material::ParameterSet set, const Observation& group) {
  if (group.material_number < 0) return set;
  const double factor = material::stiffness_in_surroundings(
      set.extensions, group.material_number, group.surroundings.humidity_pct.value_or(material::kReferenceHumidityPct),
      group.surroundings.age_days.value_or(0.0));
  set.modulus.e_tb_pa *= factor;
  set.modulus.e_vw_pa *= factor;
  set.modulus.e_if_pa *= factor;
  return set;
}

material::Extensions measurement_side(const material::ParameterSet& set) {
  material::Extensions own = set.extensions;
  std::erase_if(own, [](const auto& extension) { return !material::acts_in_measurement(extension.first); });
  return own;
}

/// The conditions that the testers simulate: the rate to which the specimen responds at its temperature.
tester::TestConditions simulated_conditions(const Observation& group, const material::ParameterSet& set) {
  tester::TestConditions conditions = group.conditions;
  conditions.strain_rate_per_s =
      material::equivalent_rate(conditions.strain_rate_per_s, set.extensions,
                                group.surroundings.temperature_c.value_or(material::kReferenceTemperatureC));
  return conditions;
}

/// The programme with pauses as long as the specimen's response takes at the reference temperature.
tester::Loading at_reference(const Observation& group, const material::ParameterSet& set) {
  tester::Loading loading = group.pauses;
  const double shift = simulated_conditions(group, set).strain_rate_per_s / group.conditions.strain_rate_per_s;
  for (double& hold_s : loading.holds_s) hold_s /= shift;
  if (loading.dwell_s) *loading.dwell_s /= shift;
  return loading;
}

}  // namespace

Result<tester::Curve> coupon_through_machine(const tester::Simulation& coupon, const std::vector<double>& shown_strain,
                                             const measurement::PrintContext& context) {
  std::string fault;
  const auto pull = [&](const std::vector<double>& strain) -> tester::Curve {
    auto pulled = tester::test_tensile(coupon, strain);
    if (pulled) return *std::move(pulled);
    fault = pulled.error().message;
    return {strain, std::vector<double>(strain.size(), 0.0)};
  };
  tester::Curve shown = measurement::observe_along(shown_strain, pull, coupon.parameters.extensions, context);
  if (!fault.empty()) return fail("{}", fault);
  return shown;
}

tester::Curve FeatureModel::coupon_curve(const Observation& group, const material::ParameterSet& set) const {
  const auto shown = coupon_through_machine({group.design, set, simulated_conditions(group, set), fidelity_},
                                            group.curve.strain, print_context(group));
  if (!shown) throw std::runtime_error(fmt::format("coupon {}: {}", group.design.name(), shown.error().message));
  const auto end = carried_strain(group.curve, observations_.reading);
  return end ? tester::cut_at(*shown, *end) : *shown;
}

measurement::PauseReadings FeatureModel::pauses_of(const Observation& group, const material::ParameterSet& set) const {
  constexpr int kPasses = 8;
  const tester::Simulation coupon{group.design, simulated_side(set), simulated_conditions(group, set), fidelity_};
  const auto as_recorded = [&](double strain, double stress_pa) {
    return measurement::observe_curve({{strain}, {stress_pa}}, set.extensions, print_context(group)).strain.back();
  };
  // The machine turns at the strain that it records; what pauses show hardly depends on it.
  const double turn = group.pauses.turns.front();
  tester::Loading own = at_reference(group, set);
  tester::PausedPull shown;
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto pulled = tester::pull_with_pauses(coupon, own);
    if (!pulled) throw std::runtime_error(fmt::format("coupon {}: {}", group.design.name(), pulled.error().message));
    shown = *pulled;
    const double off = as_recorded(own.turns.front(), shown.turn_stress_pa) - turn;
    if (std::abs(off) < 1e-6 * turn || own.turns.front() <= off) break;
    own.turns.front() -= off;
  }
  measurement::PauseReadings readings;
  if (shown.held_stress_pa) readings.held_share = *shown.held_stress_pa / shown.turn_stress_pa;
  if (shown.set_strain) readings.set_share = as_recorded(*shown.set_strain, 0.0) / turn;
  if (shown.dwelled_strain) readings.dwelled_share = as_recorded(*shown.dwelled_strain, 0.0) / turn;
  return readings;
}

Basis basis_for(const Observations& observations, const material::ParameterSet& start,
                const material::ParameterRanges& ranges, const ConstantRules& rules) {
  const std::vector<OtherMaterial> others = other_materials(observations, ranges, rules);
  Basis basis{.modulus = false,
              .toughness = false,
              .coupon = false,
              .centre = start,
              .ranges = ranges_over(ranges, others),
              .rules = rules,
              .machines = static_cast<int>(observations.machines.size()),
              .materials = static_cast<int>(observations.materials.size())};
  material::ModulusVector moduli = to_vector(start.modulus);
  for (const OtherMaterial& other : others) moduli[other.material] = other.modulus_pa;
  basis.centre.modulus = material::modulus_from_vector(moduli);
  for (const Observation& group : observations.groups) {
    if (group.test == TestKind::toughness)
      basis.toughness = true;
    else if (group.design.layout())
      basis.modulus = true;
    else
      basis.coupon = true;
  }
  return basis;
}

FeatureModel::FeatureModel(Observations observations, Basis basis, tester::Fidelity fidelity,
                           std::shared_ptr<const FractureSurface> surface)
    : observations_(std::move(observations)),
      basis_(std::move(basis)),
      fidelity_(fidelity),
      surface_(std::move(surface)),
      rows_of_group_(observations_.groups.size()),
      memory_(std::make_shared<Memory>()) {
  memory_->last.resize(observations_.groups.size());
  for (int i = 0; i < observations_.size(); ++i) {
    const int group = observations_.rows[i].group;
    if (group >= 0) rows_of_group_[group].push_back(i);
  }
}

FeatureModel FeatureModel::with_surface(std::shared_ptr<const FractureSurface> surface) const {
  FeatureModel model = *this;
  model.surface_ = std::move(surface);
  return model;
}

FeatureModel FeatureModel::with_basis(Basis basis) const {
  FeatureModel model = *this;
  model.basis_ = std::move(basis);
  return model;
}

measurement::PrintContext FeatureModel::print_context(const Observation& group) const {
  return {.batch_step = group.batch_step, .machine = group.machine};
}

tester::Simulation FeatureModel::simulation_of(const Observation& group, const material::ParameterSet& set) const {
  return {group.design, simulated_side(set), simulated_conditions(group, set), fidelity_};
}

double FeatureModel::modulus(std::size_t group, const material::ParameterSet& set) const {
  const Observation& g = observations_.groups[group];
  const tester::Simulation simulation = simulation_of(g, set);
  if (g.surroundings.held) {
    const auto held =
        tester::relaxation_modulus(simulation, measurement::rate_of_hold(simulation.conditions.strain_rate_per_s));
    if (!held) throw std::runtime_error(held.error().message);
    return *held;
  }
  if (!g.design.layout()) {
    const auto pulled = tester::test_modulus(simulation);
    if (!pulled) throw std::runtime_error(fmt::format("modulus of {}: {}", g.design.name(), pulled.error().message));
    return pulled->modulus_pa;
  }
  const double relaxed_pa =
      remembered(tester::elastic_key(simulation), [&] { return probe(group, set)->relaxed_pa(); });
  return relaxed_pa * tester::rate_factor(simulation);
}

double FeatureModel::refined_modulus(std::size_t group, const material::ParameterSet& set) const {
  constexpr int kRefinement = 2;
  const tester::Simulation simulation = simulation_of(observations_.groups[group], set);
  const double factor = tester::rate_factor(simulation);
  const double relaxed_pa = remembered(tester::elastic_key(simulation, kRefinement), [&] {
    const auto solved = tester::test_modulus(simulation, {.refinement = kRefinement});
    if (!solved)
      throw std::runtime_error(
          fmt::format("modulus of {} at h/2: {}", simulation.design.name(), solved.error().message));
    return solved->modulus_pa / factor;
  });
  return relaxed_pa * factor;
}

double FeatureModel::remembered(const std::string& key, const std::function<double()>& compute) const {
  {
    const std::lock_guard lock(memory_->mutex);
    if (const auto found = memory_->known.find(key); found != memory_->known.end()) return found->second;
  }
  const double value = compute();
  const std::lock_guard lock(memory_->mutex);
  return memory_->known.emplace(key, value).first->second;
}

std::shared_ptr<const tester::ModulusProbe> FeatureModel::probe(std::size_t group,
                                                                const material::ParameterSet& set) const {
  const tester::Simulation simulation = simulation_of(observations_.groups[group], set);
  std::string key = tester::elastic_key(simulation);
  std::shared_ptr<const tester::ModulusProbe> known;
  {
    const std::lock_guard lock(memory_->mutex);
    if (const auto same = std::ranges::find(memory_->last, key, &LastProbe::key); same != memory_->last.end())
      known = same->probe;
  }
  if (!known) {
    auto solved = tester::ModulusProbe::at(simulation);
    if (!solved)
      throw std::runtime_error(fmt::format("modulus of {}: {}", simulation.design.name(), solved.error().message));
    known = std::make_shared<const tester::ModulusProbe>(*std::move(solved));
  } else {
    known = std::make_shared<const tester::ModulusProbe>(known->of(simulation));
  }
  const std::lock_guard lock(memory_->mutex);
  memory_->last[group] = {std::move(key), known};
  return known;
}

void FeatureModel::put_modulus(std::size_t group, double modulus_pa, const material::ParameterSet& set,
                               Eigen::Ref<Eigen::VectorXd> rows) const {
  const double shown =
      std::log(measurement::observe_modulus(modulus_pa, set.extensions, print_context(observations_.groups[group])));
  for (const int row : rows_of_group_[group]) rows[row] = shown;
}

void FeatureModel::put_group(std::size_t group, const material::ParameterSet& set,
                             Eigen::Ref<Eigen::VectorXd> rows) const {
  const Observation& g = observations_.groups[group];
  if (g.test == TestKind::modulus) return put_modulus(group, modulus(group, set), set, rows);
  FeatureValues values = tensile_features(coupon_curve(g, set), observations_.reading, g.read_up_to);
  if (!value_of(values, Feature::log_peak)) {  // more slack than it was pulled: no information on stresses
    material::ParameterSet without = set;
    without.extensions.erase("toe_slack");
    values = tensile_features(coupon_curve(g, without), observations_.reading, g.read_up_to);
  }
  if (g.pauses.has_pauses()) put_pauses(values, pauses_of(g, set));
  for (const int row : rows_of_group_[group]) {
    const auto& value = value_of(values, observations_.rows[row].feature);
    rows[row] = value.value_or(unshown(values, observations_.rows[row].feature));
  }
}

/// Change of a feature by the machine from one batch to the next, and how much replicates scatter; no effect depends on
/// single batches or on the order inside a batch.
void FeatureModel::put_history(const material::ParameterSet& set, Eigen::Ref<Eigen::VectorXd> rows) const {
  for (int i = 0; i < observations_.size(); ++i) {
    const DataRow& row = observations_.rows[i];
    if (row.kind == RowKind::mean || row.kind == RowKind::constant) continue;
    rows[i] = 0.0;
    if (row.kind == RowKind::scatter)
      rows[i] = observations_.crack_scatter->log_sd(material::extension_value(set.extensions, kStrengthScatter));
    if (row.kind != RowKind::batch || set.extensions.empty()) continue;
    if (row.test == TestKind::toughness && surface_ != nullptr)
      rows[i] = value_of(surface_->batch_step(set), row.feature).value_or(0.0);
    if (row.test == TestKind::toughness) continue;
    // One stiffness in the middle of those that are printed serves for all: the machine's own spring makes the slope
    // depend on it a little.
    constexpr double kTypicalPa = 5e8;
    rows[i] = std::log(measurement::observe_modulus(kTypicalPa, set.extensions, {.batch_step = 1.0}) /
                       measurement::observe_modulus(kTypicalPa, set.extensions));
  }
}

void FeatureModel::put_constants(const material::ModulusParameters& of_layouts,
                                 const material::ModulusParameters& of_coupons,
                                 Eigen::Ref<Eigen::VectorXd> rows) const {
  const material::ModulusVector layouts = to_vector(of_layouts), coupons = to_vector(of_coupons);
  for (int i = 0; i < observations_.size(); ++i) {
    const DataRow& row = observations_.rows[i];
    if (row.kind == RowKind::constant) rows[i] = std::log(layouts[row.material] / coupons[row.material]);
  }
}

bool FeatureModel::shows_the_same(const Observation& group, const material::ParameterSet& a,
                                  const material::ParameterSet& b) const {
  if (measurement_side(a) != measurement_side(b)) return false;
  const tester::TestConditions first = simulated_conditions(group, a), second = simulated_conditions(group, b);
  if (first.strain_rate_per_s != second.strain_rate_per_s) return false;
  const auto before = tester::coupon_law({group.design, a, first, fidelity_}),
             after = tester::coupon_law({group.design, b, second, fidelity_});
  return before && after && *before == *after;
}

void FeatureModel::predict_others(const CoordinateMap& map, std::span<const Eigen::VectorXd> u,
                                  Eigen::Ref<Eigen::MatrixXd> y, const KnownRows* near) const {
  const int groups = static_cast<int>(observations_.groups.size()), points = static_cast<int>(u.size());
  parallel_for(groups * points, [&](int job) {
    const auto point = static_cast<std::size_t>(job / groups), group = static_cast<std::size_t>(job % groups);
    const Observation& g = observations_.groups[group];
    if (g.test == TestKind::toughness || g.design.layout()) return;
    const material::ParameterSet set = in_surroundings(map.coupon_parameters(u[point]), g);
    auto rows = y.col(static_cast<Eigen::Index>(point));
    if (near != nullptr && g.test == TestKind::tensile &&
        shows_the_same(g, set, in_surroundings(map.coupon_parameters(near->u), g)))
      rows(rows_of_group_[group]) = near->rows(rows_of_group_[group]);
    else
      put_group(group, set, rows);
  });
  parallel_for(points, [&](int p) {
    const material::ParameterSet set = map.parameters(u[p]);
    put_history(set, y.col(p));
    put_constants(set.modulus, map.coupon_parameters(u[p]).modulus, y.col(p));
    if (surface_ == nullptr || !basis_.toughness) return;
    const Eigen::VectorXd values = surface_->predict(set);
    for (std::size_t k = 0; k < surface_->rows().size(); ++k) y(surface_->rows()[k].row, p) = values[k];
  });
}

Eigen::MatrixXd FeatureModel::predict(const CoordinateMap& map, std::span<const Eigen::VectorXd> u) const {
  const int groups = static_cast<int>(observations_.groups.size()), points = static_cast<int>(u.size());
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(observations_.size(), points);
  parallel_for(groups * points, [&](int job) {
    const auto point = static_cast<std::size_t>(job / groups), group = static_cast<std::size_t>(job % groups);
    const Observation& g = observations_.groups[group];
    if (g.test == TestKind::modulus && g.design.layout())
      put_group(group, map.parameters(u[point]), y.col(static_cast<Eigen::Index>(point)));
  });
  predict_others(map, u, y);
  return y;
}

Eigen::MatrixXd FeatureModel::slopes(const CoordinateMap& map, const Eigen::VectorXd& u,
                                     const Eigen::VectorXd& predicted, double step) const {
  std::vector<Eigen::VectorXd> points;
  Eigen::VectorXd steps(map.size());
  for (int i = 0; i < map.size(); ++i) {
    steps[i] = u[i] + step <= map.upper(i) ? step : -step;
    points.push_back(u);
    points.back()[i] += steps[i];
  }
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(observations_.size(), map.size());
  const KnownRows known{u, predicted};
  predict_others(map, points, y, &known);
  const material::ParameterSet own = map.parameters(u);
  parallel_for(static_cast<int>(observations_.groups.size()), [&](int i) {
    const auto group = static_cast<std::size_t>(i);
    const Observation& g = observations_.groups[group];
    if (g.test != TestKind::modulus || !g.design.layout()) return;
    const auto solved = probe(group, own);
    for (int k = 0; k < map.size(); ++k) {
      const material::ParameterSet set = map.parameters(points[k]);
      put_modulus(group, solved->nearby(simulated_side(set)), set, y.col(k));
    }
  });
  return (y.colwise() - predicted) * steps.cwiseInverse().asDiagonal();
}

Eigen::VectorXd FeatureModel::mesh_change(const CoordinateMap& map, const Eigen::VectorXd& u) const {
  const material::ParameterSet set = map.parameters(u);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(observations_.size());
  parallel_for(static_cast<int>(observations_.groups.size()), [&](int i) {
    const auto group = static_cast<std::size_t>(i);
    if (observations_.groups[group].test != TestKind::modulus || !observations_.groups[group].design.layout()) return;
    const double finer = std::log(measurement::observe_modulus(refined_modulus(group, set), set.extensions)),
                 own = std::log(measurement::observe_modulus(modulus(group, set), set.extensions));
    for (const int row : rows_of_group_[group]) change[row] = finer - own;
  });
  return change;
}

}  // namespace nacre::diagnosis
