#include "diagnosis/observations.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "diagnosis/history_rows.hpp"
#include "diagnosis/scatter.hpp"
#include "measurement/conditions.hpp"
#include "measurement/observe.hpp"
#include "measurement/pauses.hpp"
#include "measurement/piece.hpp"
#include "measurement/summary.hpp"

namespace nacre::diagnosis {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;

using GroupKey = std::tuple<int, std::string, double, double, double, bool, std::string, std::string>;

bool is_unloaded_coupon(const SpecimenRecord& specimen, const CurveReading& reading) {
  return specimen.test == TestKind::tensile && is_unloaded(specimen.curve, reading);
}

GroupKey key_of(const SpecimenRecord& specimen, const CurveReading& reading) {
  const tester::TestConditions& c = specimen.conditions;
  const tester::Loading pauses = measurement::pauses_of(specimen).value_or(tester::Loading{});
  return {static_cast<int>(specimen.test),
          specimen.design.name(),
          c.orientation_deg,
          c.strain_rate_per_s,
          c.thickness_mm,
          is_unloaded_coupon(specimen, reading),
          measurement::nominal_surroundings(measurement::surroundings_of(specimen)),
          pauses.has_pauses() ? tester::to_string(pauses) : ""};
}

/// The readings at the pauses of each coupon that has some, whose curve then ends at its turn.
std::map<std::string, measurement::PauseReadings> take_pauses(std::vector<SpecimenRecord>& specimens) {
  std::map<std::string, measurement::PauseReadings> readings;
  for (SpecimenRecord& specimen : specimens) {
    const tester::Loading pauses = measurement::pauses_of(specimen).value_or(tester::Loading{});
    if (!pauses.has_pauses()) continue;
    readings[specimen.specimen] = measurement::read_pauses(specimen.curve, pauses);
    specimen.curve = measurement::first_pull(specimen.curve);
  }
  return readings;
}

FeatureValues features_of(const SpecimenRecord& specimen, const CurveReading& reading) {
  FeatureValues values;
  switch (specimen.test) {
    case TestKind::modulus:
      if (const auto modulus = measurement::modulus_of(specimen); modulus && *modulus > 0.0)
        value_of(values, Feature::log_modulus) = std::log(*modulus);
      break;
    case TestKind::toughness:
      values = fracture_features(specimen.curve, reading);
      if (const auto toughness = measurement::toughness_of(specimen); toughness && *toughness > 0.0)
        value_of(values, Feature::log_toughness) = std::log(*toughness);
      break;
    case TestKind::tensile:
      values = tensile_features(specimen.curve, reading);
      break;
  }
  return values;
}

/// Whether specimens of this kind are included.
bool is_included(const SpecimenRecord& specimen) {
  if (!specimen.valid) return false;
  switch (specimen.test) {
    case TestKind::modulus:
    case TestKind::toughness:
      return true;
    case TestKind::tensile:
      return specimen.design.mixture() != nullptr;
  }
  return false;
}

/// Coupons of one group are stopped at different strains: all are read as far as the first that stops. Nothing when one
/// has no curve that can be cut.
std::optional<double> common_strain(const std::vector<Measured>& replicates, const CurveReading& reading) {
  std::optional<double> common;
  for (const Measured& each : replicates) {
    const auto strain = carried_strain(each.specimen->curve, reading);
    if (!strain) return std::nullopt;
    common = std::min(common.value_or(*strain), *strain);
  }
  return common;
}

/// Unloaded coupons turn at different strains: the least of the largest.
double common_turn(const std::vector<Measured>& replicates) {
  double common = std::numeric_limits<double>::infinity();
  for (const Measured& each : replicates)
    common = std::min(common, *std::ranges::max_element(each.specimen->curve.strain));
  return common;
}

/// Tests of one piece under equal conditions tell of one piece: the means of their features.
std::vector<Measured> one_of_each_piece(const std::vector<Measured>& tests) {
  std::vector<Measured> pieces;
  std::vector<int> counts;
  for (const Measured& test : tests) {
    const auto known = std::ranges::find_if(pieces, [&](const Measured& piece) {
      return measurement::piece_of(*piece.specimen) == measurement::piece_of(*test.specimen);
    });
    if (known == pieces.end()) {
      pieces.push_back(test);
      counts.push_back(1);
      continue;
    }
    const int count = ++counts[known - pieces.begin()];
    for (std::size_t f = 0; f < kFeatureCount; ++f) {
      if (!known->features[f] || !test.features[f])
        known->features[f].reset();
      else
        *known->features[f] += (*test.features[f] - *known->features[f]) / count;
    }
  }
  return pieces;
}

Observation mean_of(const std::vector<Measured>& replicates, const CurveReading& reading) {
  Observation group;
  const SpecimenRecord& first = *replicates.front().specimen;
  group.design = first.design;
  group.test = first.test;
  group.conditions = first.conditions;
  group.surroundings = measurement::surroundings_of(first);
  group.unloaded = is_unloaded_coupon(first, reading);
  group.pauses = measurement::pauses_of(first).value_or(tester::Loading{});
  group.replicates = static_cast<int>(replicates.size());
  int with_order = 0;
  for (const Measured& each : replicates) {
    group.pieces.push_back(measurement::piece_of(*each.specimen));
    if (each.specimen->print_order > 0) {
      group.print_order += static_cast<double>(each.specimen->print_order);
      ++with_order;
    }
    group.batch_step += each.batch_step / group.replicates;
    if (!each.specimen->batch.empty()) ++group.batches[each.specimen->batch];
  }
  std::ranges::sort(group.pieces);
  if (with_order > 0) group.print_order /= with_order;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    // A feature that one replicate lacks is left out of the group, so that groups of one kind have the same features.
    double sum = 0.0;
    const bool all =
        std::all_of(replicates.begin(), replicates.end(), [f](const Measured& m) { return m.features[f].has_value(); });
    for (const Measured& each : replicates) sum += each.features[f].value_or(0.0);
    if (all) group.features[f] = sum / group.replicates;
  }
  std::vector<const Measured*> with_curve;
  for (const Measured& each : replicates)
    if (!each.specimen->curve.empty()) with_curve.push_back(&each);
  const auto peak = [](const Measured* m) { return value_of(m->features, Feature::log_peak).value_or(0.0); };
  std::stable_sort(with_curve.begin(), with_curve.end(),
                   [&](const Measured* a, const Measured* b) { return peak(a) < peak(b); });
  if (!with_curve.empty()) group.curve = with_curve[with_curve.size() / 2]->specimen->curve;
  return group;
}

/// Of every batch; the rows of history are the last of `row_count`.
std::vector<BatchOffset> batch_offsets(const std::vector<HistoryRow>& history, std::size_t row_count) {
  std::map<std::tuple<tester::TestKind, Feature, std::string>, Eigen::VectorXd> by_batch;
  std::set<std::pair<tester::TestKind, Feature>> with_rest;
  for (std::size_t k = 0; k < history.size(); ++k) {
    const DataRow& row = history[k].row;
    if (row.kind == RowKind::batch_rest) with_rest.emplace(row.test, row.feature);
    for (const auto& [batch, value] : history[k].of_batches) {
      Eigen::VectorXd& rows = by_batch[{row.test, row.feature, batch}];
      if (rows.size() == 0) rows = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(row_count));
      rows[row_count - history.size() + k] = value;
    }
  }
  std::vector<BatchOffset> offsets;
  for (const auto& [key, rows] : by_batch) {
    const auto& [test, feature, batch] = key;
    offsets.push_back({batch, feature, test, rows, with_rest.contains({test, feature})});
  }
  return offsets;
}

/// Where pieces return in other groups, slopes of history weigh what a piece keeps as often as there are pieces, the
/// rest as often as there are tests; so many pieces are behind their scatter. `history`: the last rows.
void put_weights_of_pieces(Observations& observations, const std::vector<HistoryRow>& history) {
  std::map<std::size_t, std::size_t> of_pieces;  // scatter of tests -> that of pieces
  for (std::size_t k = 0; k < history.size(); ++k) {
    DataRow& row = observations.rows[observations.rows.size() - history.size() + k];
    const ReplicateScatter tests = observations.scatter[row.scatter];
    if (tests.piece_dof >= tests.dof) continue;
    row.weight = (1.0 - tests.piece_share) * row.weight + tests.piece_share * history[k].piece_weight;
    const auto [place, is_new] = of_pieces.try_emplace(row.scatter, observations.scatter.size());
    if (is_new) {
      observations.scatter.push_back(tests);
      observations.scatter.back().dof = tests.piece_dof;
    }
    row.scatter = place->second;
  }
}

int number_of(const std::string& name, const std::vector<std::string>& names) {
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

/// Homogeneous and without a notch: it has the constants of its material's bulk.
bool is_bulk(const Observation& group) {
  return group.design.mixture() != nullptr && group.test != TestKind::toughness;
}

/// Where the cracks of homogeneous specimens go does not depend on the mesh as that of layouts does, nor on the place
/// between these: what one has in common with another is its own.
double discretisation_covariance(const FractureDiscretisation& error, const DataRow& a, const pattern::Design& of_a,
                                 const DataRow& b, const pattern::Design& of_b) {
  if ((of_a.layout() == nullptr) != (of_b.layout() == nullptr)) return 0.0;
  const auto position = [](const pattern::Design& design) { return design.layout() ? rigid_position(design) : 0.0; };
  return error.covariance(a.feature, b.feature, position(of_a), position(of_b), of_a == of_b);
}

void number_machines_and_materials(Observations& observations) {
  std::set<std::string> machines, materials;
  for (const Observation& group : observations.groups) {
    machines.insert(group.surroundings.machine);
    if (is_bulk(group)) materials.insert(group.material());
  }
  observations.machines.assign(machines.begin(), machines.end());
  observations.materials.assign(materials.begin(), materials.end());
  for (Observation& group : observations.groups) {
    group.machine = number_of(group.surroundings.machine, observations.machines);
    if (is_bulk(group)) group.material_number = number_of(group.material(), observations.materials);
  }
}

/// Whether E of the base materials is told by layouts and by homogeneous specimens.
bool has_constants_of_both(const std::vector<Observation>& groups) {
  const auto any = [&](auto is) { return std::ranges::any_of(groups, is); };
  return any([](const Observation& g) { return g.test == TestKind::modulus && g.design.layout(); }) && any(is_bulk);
}

}  // namespace

Whitener::Whitener(const Eigen::MatrixXd& covariance) : factor_(covariance) {
  if (!covariance.allFinite() || factor_.info() != Eigen::Success)
    throw std::runtime_error(
        "the covariance of the data is not positive definite: no statement about them is possible");
}

Whitener Whitener::independent(const Eigen::VectorXd& standard_deviations) {
  Whitener whitener;
  whitener.scale_ = standard_deviations.cwiseInverse();
  return whitener;
}

double CrackScatter::log_sd(double strength_scatter) const {
  return 0.5 * std::log(of_specimens + of_cracks + growth * strength_scatter * strength_scatter);
}

bool is_notched_bulk(const Observation& group) {
  return group.design.mixture() != nullptr && group.test == TestKind::toughness;
}

std::string Observation::material() const { return design.layout() ? "layout" : design.name(); }

bool Observations::has(TestKind test) const {
  return std::any_of(groups.begin(), groups.end(), [test](const Observation& g) { return g.test == test; });
}

double Observations::replicate_sd(Feature feature, TestKind test) const {
  const Eigen::MatrixXd& c = scatter[static_cast<std::size_t>(test)].covariance;
  const auto f = static_cast<Eigen::Index>(feature);
  return c.size() ? std::sqrt(c(f, f)) : 0.0;
}

double Observations::piece_covariance(int i, int j) const {
  const ReplicateScatter& own = scatter[rows[i].scatter];
  if (own.piece_share <= 0.0) return 0.0;
  const Observation &one = group_of(i), &other = group_of(j);
  std::vector<std::string> both;
  std::ranges::set_intersection(one.pieces, other.pieces, std::back_inserter(both));
  return own.piece_share *
         own.covariance(static_cast<Eigen::Index>(rows[i].feature), static_cast<Eigen::Index>(rows[j].feature)) *
         static_cast<double>(both.size()) / (one.replicates * other.replicates);
}

RowCovariance Observations::row_covariance(int i, int j) const {
  const DataRow &a = rows[i], &b = rows[j];
  RowCovariance covariance;
  if (a.kind == RowKind::mean && b.kind == RowKind::mean && a.group != b.group && a.scatter == b.scatter)
    covariance.scatter = piece_covariance(i, j);
  if (a.kind == RowKind::constant && i == j) covariance.fixed = constant_sd * constant_sd;
  if (a.kind == RowKind::scatter && i == j) covariance.fixed = crack_scatter->error_variance;
  const auto stands_alone = [](RowKind kind) { return kind == RowKind::constant || kind == RowKind::scatter; };
  if (stands_alone(a.kind) || stands_alone(b.kind)) return covariance;
  if (a.test != b.test || a.kind != b.kind) return covariance;
  // Rows of history rest on as many specimens as show the feature: on those of the rarer one where both are shown.
  if (a.group == b.group && a.batch == b.batch)
    covariance.scatter =
        std::min(a.weight, b.weight) *
        scatter[a.scatter].covariance(static_cast<Eigen::Index>(a.feature), static_cast<Eigen::Index>(b.feature));
  if (a.kind != RowKind::mean) return covariance;
  const pattern::Design &of_a = group_of(i).design, &of_b = group_of(j).design;
  if (a.test == TestKind::modulus && of_a.layout() && of_a == of_b)
    covariance.fixed = discretisation_sd * discretisation_sd;
  if (a.test == TestKind::toughness)
    covariance.fixed = discretisation_covariance(fracture_discretisation, a, of_a, b, of_b);
  return covariance;
}

CovarianceParts Observations::covariance_parts() const {
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(size(), size());
  CovarianceParts parts{none, none};
  for (int i = 0; i < size(); ++i) {
    for (int j = 0; j <= i; ++j) {
      const RowCovariance both = row_covariance(i, j);
      parts.fixed(i, j) = parts.fixed(j, i) = both.fixed;
      parts.scatter(i, j) = parts.scatter(j, i) = both.scatter;
    }
  }
  const Eigen::MatrixXd shared = shared_directions();
  parts.fixed += shared * shared.transpose();
  if (emulator_variance.size() == size()) parts.fixed += emulator_covariance();
  return parts;
}

Eigen::MatrixXd Observations::emulator_covariance() const {
  Eigen::MatrixXd covariance = emulator_variance.asDiagonal();
  for (int i = 0; i < size(); ++i) {
    for (int j = 0; j < i; ++j) {
      const DataRow &a = rows[i], &b = rows[j];
      if (a.kind != RowKind::mean || b.kind != RowKind::mean || a.group != b.group) continue;
      const Eigen::MatrixXd& cracks = scatter[a.scatter].covariance;
      const auto f = static_cast<Eigen::Index>(a.feature), g = static_cast<Eigen::Index>(b.feature);
      covariance(i, j) = covariance(j, i) = cracks(f, g) / std::sqrt(cracks(f, f) * cracks(g, g)) *
                                            std::sqrt(emulator_variance[i] * emulator_variance[j]);
    }
  }
  return covariance;
}

Eigen::VectorXd Observations::own_variances() const {
  return covariance().diagonal() - shared_directions().rowwise().squaredNorm();
}

Eigen::MatrixXd Observations::shared_directions() const {
  Eigen::MatrixXd directions(size(), 0);
  for (const Eigen::MatrixXd* own :
       {&fracture_change, &emulator_shared, &bulk_constants, &discretisation_shared, &levels}) {
    if (own->rows() != size()) continue;
    directions.conservativeResize(Eigen::NoChange, directions.cols() + own->cols());
    directions.rightCols(own->cols()) = *own;
  }
  return directions;
}

Eigen::VectorXd Observations::expected_shared(const Eigen::VectorXd& residuals_at_rows,
                                              const std::vector<Eigen::Index>& at) const {
  const Eigen::MatrixXd shared = shared_directions();
  if (shared.cols() == 0) return Eigen::VectorXd::Zero(size());
  const Eigen::MatrixXd all = covariance();
  const Eigen::VectorXd weights = all(at, at).llt().solve(residuals_at_rows);
  return shared * (shared(at, Eigen::all).transpose() * weights);
}

Observations observe(const std::vector<SpecimenRecord>& specimens, double modulus_discretisation_sd,
                     const FractureDiscretisation& fracture, const Procedure& procedure) {
  const CurveReading& reading = procedure.curves;
  // Replicates in the order of their names: the same bits whatever the order of arrival.
  std::vector<SpecimenRecord> nominal = measurement::at_nominal_conditions(specimens);
  const std::map<std::string, measurement::PauseReadings> pauses = take_pauses(nominal);
  const std::vector<measurement::PrintContext> contexts = measurement::print_contexts(nominal);
  std::map<GroupKey, std::map<std::string, Measured>> by_group;
  double last_batch_step = 0.0;
  for (const SpecimenRecord& specimen : nominal) {
    if (!is_included(specimen)) continue;
    const FeatureValues features = features_of(specimen, reading);
    if (std::none_of(features.begin(), features.end(), [](const auto& f) { return f.has_value(); })) continue;
    const double step = contexts[&specimen - nominal.data()].batch_step;
    by_group[key_of(specimen, reading)].emplace(specimen.specimen, Measured{&specimen, features, step});
    last_batch_step = std::max(last_batch_step, step);
  }
  Observations observations;
  observations.reading = reading;
  observations.constant_sd = procedure.noise.constant_sd;
  observations.last_batch_step = last_batch_step;
  observations.discretisation_sd = modulus_discretisation_sd;
  observations.fracture_discretisation = fracture;
  std::vector<std::vector<Measured>> groups;
  for (auto& [key, named] : by_group) {
    groups.emplace_back();
    for (auto& [name, measured] : named) {
      groups.back().push_back(measured);
    }
    const bool coupons = groups.back().front().specimen->test == TestKind::tensile;
    const auto common = coupons ? common_strain(groups.back(), reading) : std::nullopt;
    if (common)
      for (Measured& each : groups.back())
        each.features = tensile_features(tester::cut_at(each.specimen->curve, *common), reading);
    std::optional<double> turn;
    if (coupons && is_unloaded_coupon(*groups.back().front().specimen, reading)) {
      turn = common_turn(groups.back());
      for (Measured& each : groups.back()) each.features = tensile_features(each.specimen->curve, reading, turn);
    }
    for (Measured& each : groups.back())
      if (const auto own = pauses.find(each.specimen->specimen); own != pauses.end())
        put_pauses(each.features, own->second);
    groups.back() = one_of_each_piece(groups.back());
    observations.groups.push_back(mean_of(groups.back(), reading));
    observations.groups.back().read_up_to = turn;
    if (common) observations.groups.back().curve = tester::cut_at(observations.groups.back().curve, *common);
  }
  number_machines_and_materials(observations);
  observations.disconnected_batches = disconnected_batches(groups);
  std::vector<double> values;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Observation& group = observations.groups[g];
    for (std::size_t f = 0; f < kFeatureCount; ++f) {
      if (!group.features[f]) continue;
      observations.rows.push_back(
          {static_cast<int>(g), static_cast<Feature>(f), RowKind::mean, group.test, 1.0 / group.replicates});
      values.push_back(*group.features[f]);
    }
  }
  if (has_constants_of_both(observations.groups)) {
    for (int material = 0; material < static_cast<int>(kConstantMaterials.size()); ++material) {
      observations.rows.push_back({.feature = Feature::log_modulus,
                                   .kind = RowKind::constant,
                                   .test = TestKind::modulus,
                                   .material = material});
      values.push_back(0.0);
    }
  }
  const std::vector<HistoryRow> history = history_rows(groups, procedure.noise.fewest_for_history);
  for (const HistoryRow& each : history) {
    observations.rows.push_back(each.row);
    values.push_back(each.value);
  }
  observations.batch_offsets = batch_offsets(history, observations.rows.size());
  put_scatter(observations, groups, procedure.noise);
  put_weights_of_pieces(observations, history);
  observations.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return observations;
}

tester::TestConditions usual_conditions(const Observations& observations, TestKind test) {
  std::map<std::pair<double, double>, int> counts;
  for (const Observation& g : observations.groups)
    if (g.test == test && g.conditions.orientation_deg == 0.0)
      ++counts[{g.conditions.strain_rate_per_s, g.conditions.thickness_mm}];
  const auto most = std::ranges::max_element(counts, {}, [](const auto& each) { return each.second; });
  if (most == counts.end()) return {};
  return {.orientation_deg = 0.0, .strain_rate_per_s = most->first.first, .thickness_mm = most->first.second};
}

}  // namespace nacre::diagnosis
