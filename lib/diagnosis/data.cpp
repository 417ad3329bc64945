#include "diagnosis/data.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/result.hpp"
#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/crack_scatter.hpp"
#include "diagnosis/planned_runs.hpp"
#include "material/effect_library.hpp"
#include "sysid/eta.hpp"
#include "sysid/objective.hpp"

namespace nacre::diagnosis {
namespace {

/// The most probable eta where it is searched for, with what was simulated on the way; the given one otherwise.
FractureSearch search_of(const FractureTests* fractures, const DiagnosisSettings& settings) {
  if (fractures == nullptr || settings.search_budget <= 0) return {settings.start.toughness, {}};
  const auto searching = [&](double share, std::string_view) {
    if (settings.progress) settings.progress(0.2 * share, "calibrating the fracture tester");
  };
  return fractures->search(settings.start, settings.ranges, settings.search_budget, settings.seed, searching);
}

/// Runs of the search, and around what it found.
std::vector<FractureRun> runs_around(const FractureTests& fractures, std::vector<FractureRun> runs, const Basis& basis,
                                     const DiagnosisSettings& settings) {
  const std::vector<material::ParameterSet> sets =
      planned_runs(basis, runs.empty(), settings.procedure.emulator, settings.seed);
  const double all = static_cast<double>(sets.size() * fractures.groups().size());
  int count = 0;
  auto further = fractures.runs_at(sets, runs, [&] {
    ++count;
    if (settings.progress)
      settings.progress(0.3 + 0.25 * std::min(1.0, count / all),
                        fmt::format("fracture tests around the calibration: {} of at most {:.0f}", count, all));
  });
  std::ranges::move(further, std::back_inserter(runs));
  return runs;
}

/// What finer elements change at the calibration.
std::vector<RefinedLayout> refined_around(const FractureTests& fractures, const material::ParameterSet& centre,
                                          const DiagnosisSettings& settings) {
  int count = 0;
  return fractures.refined_layouts(centre, settings.procedure.curves, settings.procedure.emulator, [&] {
    ++count;
    if (settings.progress)
      settings.progress(0.2, fmt::format("fracture tests on finer elements at the calibration: {} done", count));
  });
}

/// The same in the rows of these layouts, whatever their conditions.
Eigen::VectorXd fracture_change(const Observations& observations, const std::vector<RefinedLayout>& layouts) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(observations.size());
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.kind != RowKind::mean || row.test != tester::TestKind::toughness) continue;
    const auto layout = std::ranges::find(layouts, observations.group_of(i).design, &RefinedLayout::design);
    if (layout != layouts.end()) change[i] = layout->change(row.feature).value_or(0.0);
  }
  return change;
}

/// Observations that know what these layouts show of the discretisation error, and how much cracks scatter.
void take_refined(Observations& observations, const std::vector<RefinedLayout>& layouts, const FractureSurface& surface,
                  const DiagnosisSettings& settings) {
  if (layouts.empty()) return;
  const Procedure& procedure = settings.procedure;
  observations.fracture_discretisation =
      at_own_constants(settings.fracture_discretisation, layouts, procedure.emulator);
  if (const auto scatter = crack_scatter(observations, layouts, surface, procedure.noise))
    put_crack_scatter(observations, *scatter);
  observations.fracture_change = fracture_change(observations, layouts);
}

/// What the runs teach.
std::shared_ptr<const FractureSurface> learnt_surface(const Observations& observations, const std::vector<int>& groups,
                                                      const std::vector<FractureRun>& runs, const Basis& basis,
                                                      const EmulatorRules& rules) {
  return std::make_shared<const FractureSurface>(observations, groups, runs, basis.centre.toughness, rules);
}

/// What notched homogeneous specimens show if one of their constants differs from that of layouts as is usual: columns
/// by constant. Without layouts theirs are the constants that are sought.
Eigen::MatrixXd bulk_constants(const Observations& observations, const FractureSurface& surface,
                               const material::ParameterSet& at) {
  const std::vector<SurfaceRow>& rows = surface.rows();
  if (std::ranges::all_of(rows, &SurfaceRow::is_bulk) || std::ranges::none_of(rows, &SurfaceRow::is_bulk)) return {};
  const auto count = static_cast<Eigen::Index>(sysid::kSearchedEta.size());
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(observations.size(), count);
  const Eigen::VectorXd plain = surface.predict(at);
  for (Eigen::Index c = 0; c < count; ++c) {
    material::ToughnessVector eta = to_vector(at.toughness);
    eta[sysid::kSearchedEta[c]] *= std::exp(observations.constant_sd);
    material::ParameterSet moved = at;
    moved.toughness = material::toughness_from_vector(eta);
    const Eigen::VectorXd change = surface.predict(moved) - plain;
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k].is_bulk) directions(rows[k].row, c) = change[static_cast<Eigen::Index>(k)];
  }
  return directions;
}

/// Observations that know the error of the surface at these parameters.
void take_emulator_error(Observations& observations, const FractureSurface& surface, const material::ParameterSet& at) {
  observations.bulk_constants = bulk_constants(observations, surface, at);
  const ErrorOfMean error = surface.error_of_mean(at);
  observations.emulator_variance = Eigen::VectorXd::Zero(observations.size());
  observations.emulator_shared = Eigen::MatrixXd::Zero(observations.size(), error.shared.cols());
  for (std::size_t k = 0; k < surface.rows().size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    observations.emulator_variance[surface.rows()[k].row] = error.own[row];
    observations.emulator_shared.row(surface.rows()[k].row) = error.shared.row(row);
  }
}

/// Error of a surface at a run that it has not learnt from, in its own standard deviations.
double error_at(const FractureRun& run, const FractureSurface& surface, const CurveReading& reading) {
  const Eigen::VectorXd expected = surface.predict(run.parameters);
  double squares = 0.0;
  int count = 0;
  for (std::size_t r = 0; r < surface.rows().size(); ++r) {
    const SurfaceRow& row = surface.rows()[r];
    const auto value = value_of(shown_features(run.predictions[row.group], {}, reading), row.feature);
    const double variance = surface.run_variance()[r];
    if (!value || variance <= 0.0) continue;
    squares += std::pow(*value - expected[r], 2) / variance;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace

std::vector<std::string> acting_effects(const FeatureModel& model, const Observations& observations,
                                        const DiagnosisSettings& settings) {
  const FitRules& rules = settings.procedure.fit;
  const bool lacks_simulations = settings.fractures && observations.has(tester::TestKind::toughness);
  const CoordinateMap base = model.base_map();
  const Eigen::VectorXd start = base.coordinates(model.basis().centre), plain = model.predict(base, start);
  std::vector<Eigen::Index> rows(observations.size());
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  const bool only_layouts_tell = only_moduli_of_layouts_tell(observations);
  std::vector<std::string> acting;
  for (const material::Effect& effect : material::effect_library()) {
    if (only_layouts_tell && !is_identified_by_moduli(effect)) continue;
    if (is_other_constants(effect, observations)) continue;
    if (lacks_simulations && std::ranges::count(settings.fractures->unaffordable, effect.name) > 0) continue;
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

Data data_of(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings) {
  const Procedure& procedure = settings.procedure;
  Observations observations =
      observe(specimens, settings.floor.log_modulus_sd, settings.fracture_discretisation, procedure);
  if (observations.rows.empty())
    throw NothingMeasured("no valid specimen has a modulus, a toughness or a curve that a diagnosis reads");
  const bool has_fractures = observations.has(tester::TestKind::toughness);
  std::shared_ptr<const FractureTests> fractures;
  if (has_fractures && !settings.fractures)
    fractures =
        std::make_shared<const FractureTests>(observations, settings.fidelity, settings.store, settings.threads);
  FractureSearch search = search_of(fractures.get(), settings);
  material::ParameterSet centre = settings.start;
  centre.extensions.clear();
  centre.toughness = search.best;
  if (has_fractures && settings.fractures) centre.toughness = settings.fractures->centre.value_or(centre.toughness);
  const Basis basis = basis_for(observations, centre, settings.ranges, procedure.constants);
  const std::vector<int> groups = fracture_groups(observations).groups;
  std::vector<FractureRun> runs;
  std::shared_ptr<const FractureSurface> surface;
  if (has_fractures) {
    const std::vector<RefinedLayout> refined =
        fractures ? refined_around(*fractures, centre, settings) : settings.fractures->refined;
    runs = fractures ? runs_around(*fractures, std::move(search.runs), basis, settings) : settings.fractures->runs;
    surface = learnt_surface(observations, groups, runs, basis, procedure.emulator);
    take_refined(observations, refined, *surface, settings);
    take_emulator_error(observations, *surface, basis.centre);
  }
  Data data{observations,
            fractures,
            groups,
            std::move(runs),
            FeatureModel(observations, basis, settings.fidelity, surface),
            {}};
  data.effects = acting_effects(data.model, data.observations, settings);
  return data;
}

LearntData learnt_at(const Data& data, const std::vector<material::ParameterSet>& sets, const EmulatorRules& rules) {
  LearntData learnt{data, 0.0};
  if (data.fracture_groups.empty()) return learnt;
  const FractureSurface& before = *data.model.surface();
  std::vector<FractureRun> runs;
  if (data.fractures) runs = data.fractures->runs_at(sets, data.runs);
  for (FractureRun& run : runs) {
    learnt.largest_error = std::max(learnt.largest_error, error_at(run, before, data.observations.reading));
    learnt.data.runs.push_back(std::move(run));
  }
  if (learnt.data.runs.size() > data.runs.size())
    learnt.data.model = data.model.with_surface(
        learnt_surface(learnt.data.observations, data.fracture_groups, learnt.data.runs, data.model.basis(), rules));
  take_emulator_error(learnt.data.observations, *learnt.data.model.surface(), sets.front());
  return learnt;
}

tester::Curve curve_at(const Data& data, int group, const FittedModel& fit) {
  const Observation& g = data.observations.groups[group];
  if (g.test == tester::TestKind::tensile)
    return data.model.coupon_curve(g, data.model.map(fit.effects).coupon_parameters(fit.u));
  if (g.test != tester::TestKind::toughness) return {};
  const material::ParameterSet simulated = simulated_side(fit.parameters);
  const auto eta = to_vector(simulated.toughness);
  const auto distance_to = [&](const FractureRun& run) {
    double distance = 0.0;
    const auto other = to_vector(run.parameters.toughness);
    for (const std::size_t i : sysid::kSearchedEta) distance += std::pow(std::log(eta[i] / other[i]), 2);
    for (const material::Effect& effect : material::effect_library()) {
      const auto strength = [&](const material::ParameterSet& set) {
        return material::strength_of(effect.parameters.front(), material::extension_value(set.extensions, effect.name));
      };
      distance += std::pow((strength(simulated) - strength(run.parameters)) / 0.1, 2);
    }
    return distance;
  };
  const FractureRun& nearest = *std::ranges::min_element(data.runs, {}, distance_to);
  const auto place = std::ranges::find(data.fracture_groups, group) - data.fracture_groups.begin();
  return sysid::observed(nearest.predictions[place], fit.parameters.extensions, {.batch_step = g.batch_step}).curve;
}

}  // namespace nacre::diagnosis
