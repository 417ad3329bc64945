#include "diagnosis/carried_part.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace nacre::diagnosis {
namespace {

RowClass class_of(const DataRow& row) { return {row.test, row.feature}; }

/// The squares of a change over the rows of a class, in their own noise.
struct ClassSignal {
  RowClass rows;
  double squares = 0.0;
  int count = 0;  ///< rows
};

std::vector<ClassSignal> signals_by_class(const Observations& observations, const Eigen::VectorXd& change) {
  const Eigen::VectorXd variances = observations.own_variances();
  std::vector<ClassSignal> signals;
  for (int i = 0; i < observations.size(); ++i) {
    const RowClass own = class_of(observations.rows[i]);
    auto known = std::ranges::find(signals, own, &ClassSignal::rows);
    if (known == signals.end()) known = signals.insert(known, {own});
    ++known->count;
    known->squares += std::pow(change[i], 2) / variances[i];
  }
  return signals;
}

/// The effect of the measuring side that lowers chi squared most, of those that do beyond chance.
std::optional<std::size_t> noticed_measuring_effect(const Evidence& evidence) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < evidence.singles.size(); ++k) {
    const bool noticed = evidence.p_family_wise[k] <= evidence.settings.procedure.levels.name;
    if (!noticed || !material::acts_in_measurement(evidence.effects[k])) continue;
    if (!best || evidence.singles[k].chi2 < evidence.singles[*best].chi2) best = k;
  }
  return best;
}

/// Observations of some rows, before anything was fitted. Fracture groups stay together, as the runs that predict them
/// do.
Observations observations_of(const Observations& all, const std::vector<Eigen::Index>& rows) {
  std::vector<bool> kept(all.groups.size(), false);
  bool breaks = false;
  for (const Eigen::Index row : rows) {
    if (all.rows[row].group >= 0) kept[all.rows[row].group] = true;
    breaks = breaks || all.rows[row].test == tester::TestKind::toughness;
  }
  Observations part = all;
  part.groups.clear(), part.rows.clear(), part.batch_offsets.clear();
  std::vector<int> place(all.groups.size(), -1);
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    if (!kept[g] && !(breaks && all.groups[g].test == tester::TestKind::toughness)) continue;
    place[g] = static_cast<int>(part.groups.size());
    part.groups.push_back(all.groups[g]);
  }
  for (const Eigen::Index row : rows) {
    part.rows.push_back(all.rows[row]);
    if (part.rows.back().group >= 0) part.rows.back().group = place[part.rows.back().group];
  }
  for (const BatchOffset& offset : all.batch_offsets) {
    BatchOffset own = offset;
    own.rows = offset.rows(rows);
    if (!own.rows.isZero()) part.batch_offsets.push_back(std::move(own));
  }
  part.values = all.values(rows);
  part.crack_scatter = all.crack_scatter;
  part.discretisation_shared.resize(0, 0);
  if (all.fracture_change.size() > 0) part.fracture_change = all.fracture_change(rows, Eigen::all);
  part.levels.resize(0, 0);
  if (all.bulk_constants.size() > 0) part.bulk_constants = all.bulk_constants(rows, Eigen::all);
  if (all.emulator_variance.size() > 0) part.emulator_variance = all.emulator_variance(rows);
  if (all.emulator_shared.size() > 0) part.emulator_shared = all.emulator_shared(rows, Eigen::all);
  return part;
}

Data data_of_rows(const Evidence& evidence, const std::vector<Eigen::Index>& rows) {
  const Data& all = evidence;
  Observations part = observations_of(all.observations, rows);
  part.discretisation_sd = evidence.settings.floor.log_modulus_sd;
  const Basis basis =
      basis_for(part, all.model.basis().centre, evidence.settings.ranges, evidence.settings.procedure.constants);
  FeatureModel model(part, basis, evidence.settings.fidelity);
  if (part.has(tester::TestKind::toughness))
    model = model.with_surface(std::make_shared<const FractureSurface>(
        part, fracture_groups(part).groups, all.runs, basis.centre.toughness, evidence.settings.procedure.emulator));
  std::vector<std::string> effects = acting_effects(model, part, evidence.settings);
  return {std::move(part), nullptr, {}, all.runs, std::move(model), std::move(effects)};
}

CarriedPart part_of(const Evidence& evidence, const std::string& effect, std::vector<RowClass> classes) {
  std::vector<Eigen::Index> rows;
  for (int i = 0; i < evidence.observations.size(); ++i)
    if (std::ranges::find(classes, class_of(evidence.observations.rows[i])) != classes.end()) rows.push_back(i);
  return {effect, std::move(classes), data_of_rows(evidence, rows)};
}

}  // namespace

std::vector<CarriedPart> carried_parts(const Evidence& evidence) {
  const std::optional<std::size_t> effect = noticed_measuring_effect(evidence);
  if (!effect) return {};
  const Observations& observations = evidence.observations;
  const Procedure& procedure = evidence.settings.procedure;
  const Eigen::VectorXd change = usual_change(evidence.base.signatures[*effect], procedure.fit.typical,
                                              evidence.base.fit, Whitener(observations.covariance()));
  std::vector<ClassSignal> signals = signals_by_class(observations, change);
  std::ranges::stable_sort(signals, std::greater<>(), &ClassSignal::squares);
  std::vector<RowClass> carriers;
  for (const ClassSignal& each : signals)
    if (each.squares >= procedure.names.carried * procedure.names.carried * signals.front().squares)
      carriers.push_back(each.rows);
  std::vector<CarriedPart> parts;
  if (carriers.size() < signals.size()) parts.push_back(part_of(evidence, evidence.effects[*effect], carriers));
  if (carriers.size() > 1)
    for (const RowClass& each : carriers) parts.push_back(part_of(evidence, evidence.effects[*effect], {each}));
  return parts;
}

WorstElsewhere worst_elsewhere(const Observations& observations, const CarriedPart& part, const FittedModel& fit) {
  const Eigen::VectorXd residuals = observations.values - fit.predicted;
  WorstElsewhere worst;
  for (const ClassSignal& each : signals_by_class(observations, residuals)) {
    if (std::ranges::find(part.classes, each.rows) != part.classes.end()) continue;
    const double deviations = std::sqrt(each.squares / each.count);
    if (deviations > worst.deviations) worst = {each.rows, deviations};
  }
  return worst;
}

}  // namespace nacre::diagnosis
