#include "diagnosis/factors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "base/statistics.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/scatter.hpp"

namespace nacre::diagnosis {
namespace {

constexpr std::string_view kMaterial = "material";
/// Every specimen has a place of its own in it: a trend, and no level each.
constexpr std::string_view kPrintOrder = "print order";
/// Replicates of one group may be of several: each has a level, and a group that of its pieces in the mean.
constexpr std::string_view kBatch = "batch";

/// The value of a factor as a name. Surroundings are equal within what no laboratory holds.
std::string value_of(const Observation& group, std::string_view factor) {
  if (factor == kMaterial) return group.material();
  measurement::Surroundings only;
  if (factor == "temperature") only.temperature_c = group.surroundings.temperature_c;
  if (factor == "humidity") only.humidity_pct = group.surroundings.humidity_pct;
  if (factor == "age") only.age_days = group.surroundings.age_days;
  if (only != measurement::Surroundings{}) return measurement::nominal_surroundings(only);
  static const std::vector<Descriptor> all = descriptors();
  return fmt::format("{:.9g}", std::ranges::find(all, factor, &Descriptor::name)->of(group));
}

/// Values of several factors as one name.
std::string values_of(const Observation& group, const std::vector<std::string>& factors) {
  std::string values;
  for (const std::string& factor : factors) values += value_of(group, factor) + '\n';
  return values;
}

/// Rows of means by test, feature, material (all where "material" is a factor) and the values of the factors.
using Cells = std::map<std::string, std::vector<Eigen::Index>>;
std::map<std::string, Cells> cells_of(const Observations& observations, const std::vector<std::string>& factors) {
  const bool over_materials = std::ranges::find(factors, kMaterial) != factors.end();
  std::map<std::string, Cells> cells;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.kind != RowKind::mean) continue;
    const Observation& group = observations.group_of(i);
    const std::string whole = fmt::format("{} {} {} {}", static_cast<int>(row.test), to_string(row.feature),
                                          group.unloaded, over_materials ? "" : group.material());
    cells[whole][values_of(group, factors)].push_back(i);
  }
  return cells;
}

/// All sets of so many of these factors, in their order.
std::vector<std::vector<std::string>> sets_of(const std::vector<std::string>& factors, std::size_t size) {
  std::vector<bool> chosen(factors.size(), false);
  std::fill_n(chosen.begin(), size, true);
  std::vector<std::vector<std::string>> sets;
  do {
    sets.emplace_back();
    for (std::size_t i = 0; i < factors.size(); ++i)
      if (chosen[i]) sets.back().push_back(factors[i]);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return sets;
}

/// One more column: these rows of the values, less their mean over those of them that are measured, the first ones.
void append_centred(Eigen::MatrixXd& columns, const Eigen::VectorXd& values, const std::vector<Eigen::Index>& rows,
                    Eigen::Index measured) {
  std::vector<Eigen::Index> own = rows;
  std::erase_if(own, [measured](Eigen::Index row) { return row >= measured; });
  Eigen::VectorXd column = Eigen::VectorXd::Zero(columns.rows());
  column(rows) = values(rows).array() - (own.empty() ? 0.0 : values(own).mean());
  columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
  columns.rightCols(1) = column;
}

/// Logarithms of the rate of stiffness and stresses, centred within each material under equal values of the factors
/// other than the rate: a column for each of these.
Eigen::MatrixXd log_rates_within_others(const Observations& observations, std::vector<std::string> factors) {
  std::erase(factors, kStrainRate);
  if (std::ranges::find(factors, kMaterial) == factors.end()) factors.emplace_back(kMaterial);
  Eigen::VectorXd log_rate = Eigen::VectorXd::Zero(observations.size());
  for (int i = 0; i < observations.size(); ++i)
    if (observations.rows[i].kind == RowKind::mean)
      log_rate[i] = std::log(observations.group_of(i).conditions.strain_rate_per_s);
  Eigen::MatrixXd columns(observations.size(), 0);
  for (const auto& [whole, cells] : cells_of(observations, factors)) {
    for (const auto& [values, rows] : cells) {
      const Feature feature = observations.rows[rows.front()].feature;
      if (feature == Feature::log_modulus || is_curve_stress(feature))
        append_centred(columns, log_rate, rows, observations.values.size());
    }
  }
  return columns;
}

/// How exponents differ between conditions of one material: standard deviation of the slopes along these columns,
/// pooled over materials; nothing where no material has two.
std::optional<double> exponent_scatter(const Observations& observations, const Eigen::MatrixXd& log_rates) {
  std::map<std::string, std::vector<double>> slopes;
  for (Eigen::Index k = 0; k < log_rates.cols(); ++k) {
    const auto own = log_rates.col(k).head(observations.values.size());
    const double length = own.squaredNorm();
    Eigen::Index row = 0;
    if (length == 0.0) continue;
    own.cwiseAbs().maxCoeff(&row);
    slopes[observations.group_of(static_cast<int>(row)).material()].push_back(own.dot(observations.values) / length);
  }
  double squares = 0.0, freedom = 0.0;
  for (const auto& [material, own] : slopes) {
    squares += std::pow(standard_deviation(own), 2) * (static_cast<double>(own.size()) - 1.0);
    freedom += static_cast<double>(own.size()) - 1.0;
  }
  if (freedom == 0.0) return std::nullopt;
  return std::sqrt(squares / freedom);
}

/// Of rows where the print order tells one: a trend over it, one long from first to last.
Eigen::VectorXd trend_over_order(const Observations& observations) {
  Eigen::VectorXd order = Eigen::VectorXd::Zero(observations.size());
  double last = 1.0;
  for (int i = 0; i < observations.size(); ++i) {
    if (observations.rows[i].kind == RowKind::print_order) order[i] = 1.0;
    if (observations.rows[i].kind != RowKind::mean) continue;
    order[i] = observations.group_of(i).print_order;
    last = std::max(last, order[i]);
  }
  return order / last;
}

/// What the level of one batch adds to every row: of means the share of their pieces, of history what it is off by.
Eigen::VectorXd share_of_batch(const Observations& observations, const std::string& batch) {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(observations.size());
  for (int i = 0; i < observations.size(); ++i) {
    if (observations.rows[i].kind != RowKind::mean) continue;
    const std::map<std::string, int>& batches = observations.group_of(i).batches;
    int noted = 0;
    for (const auto& [name, pieces] : batches) noted += pieces;
    if (const auto own = batches.find(batch); own != batches.end()) share[i] = static_cast<double>(own->second) / noted;
  }
  for (const BatchOffset& offset : observations.batch_offsets)
    if (offset.batch == batch) share.head(offset.rows.size()) += offset.rows;
  return share;
}

/// The directions of both: each tells between groups, and between replicates of one group.
std::vector<Eigen::VectorXd> history_directions(const Observations& observations, bool over_order, bool over_batches) {
  std::vector<Eigen::VectorXd> directions;
  if (over_order) directions.push_back(trend_over_order(observations));
  if (!over_batches) return directions;
  std::set<std::string> names;
  for (const Observation& group : observations.groups)
    for (const auto& [batch, pieces] : group.batches) names.insert(batch);
  for (const std::string& name : names) directions.push_back(share_of_batch(observations, name));
  return directions;
}

/// Rows of history of the same test and feature, which all materials share.
std::vector<Eigen::Index> history_of(const Observations& observations, const DataRow& row) {
  std::vector<Eigen::Index> rows;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& other = observations.rows[i];
    const bool is_history = other.kind != RowKind::mean && other.kind != RowKind::constant;
    if (is_history && other.test == row.test && other.feature == row.feature) rows.push_back(i);
  }
  return rows;
}

}  // namespace

std::size_t most_values(const Observations& observations, const std::string& factor) {
  std::map<std::string, std::set<std::string>> values;
  for (const Observation& group : observations.groups)
    values[factor == kMaterial ? "" : group.material()].insert(value_of(group, factor));
  std::size_t most = 0;
  for (const auto& [material, own] : values) most = std::max(most, own.size());
  return most;
}

bool has_layouts(const Observations& observations) {
  return std::ranges::any_of(observations.groups, [](const Observation& group) { return group.design.layout(); });
}

namespace {

/// Layouts have no levels of orientation, thickness or rate: effects of the library tell these. Where they were tested
/// under conditions that no effect knows, or on several machines, they have.
bool may_have_levels(const Observations& observations) {
  if (observations.groups.empty() || observations.has(tester::TestKind::toughness)) return false;
  return !has_layouts(observations) || std::ranges::any_of(descriptors(), [&](const Descriptor& descriptor) {
    return is_without_law(descriptor.name) && most_values(observations, descriptor.name) > 1;
  });
}

}  // namespace

std::vector<std::string> varying_factors(const Observations& observations) {
  if (!may_have_levels(observations)) return {};
  std::vector<std::string> factors;
  for (const Descriptor& descriptor : descriptors())
    if (is_condition(descriptor.name) && most_values(observations, descriptor.name) > 1)
      factors.push_back(descriptor.name);
  // What was chosen comes before what happened.
  std::ranges::stable_partition(factors,
                                [](const std::string& factor) { return factor != kPrintOrder && factor != "batch"; });
  if (has_layouts(observations)) return factors;
  constexpr std::size_t kConstants = 2;  // E of rigid and soft: the base fits any two materials
  const std::string material(kMaterial);
  if (most_values(observations, material) > kConstants) factors.push_back(material);
  return factors;
}

Eigen::MatrixXd level_directions(const Observations& observations, const std::vector<std::string>& factors, double sd) {
  Eigen::MatrixXd directions(observations.size(), 0);
  std::vector<std::string> levelled = factors;
  const bool over_order = std::erase(levelled, kPrintOrder) > 0, over_batches = std::erase(levelled, kBatch) > 0;
  const std::vector<Eigen::VectorXd> of_history = history_directions(observations, over_order, over_batches);
  const std::map<std::string, Cells> wholes = cells_of(observations, levelled);
  for (const auto& [whole, cells] : wholes) {
    std::vector<Eigen::Index> all;
    for (const auto& [values, rows] : cells) all.insert(all.end(), rows.begin(), rows.end());
    const std::vector<Eigen::Index> history = history_of(observations, observations.rows[all.front()]);
    for (const Eigen::VectorXd& direction : of_history) {
      append_centred(directions, sd * direction, all, observations.values.size());
      directions.rightCols(1)(history, 0) = sd / static_cast<double>(wholes.size()) * direction(history);
    }
    const bool is_measured = all.front() < observations.values.size();
    if (cells.size() < 2 && (is_measured || levelled.empty())) continue;
    for (const auto& [values, rows] : cells) {
      Eigen::VectorXd level = Eigen::VectorXd::Zero(observations.size());
      level(rows).setConstant(sd);
      append_centred(directions, level, all, observations.values.size());
    }
  }
  return directions;
}

std::vector<std::vector<std::string>> factors_at_work(const Observations& observations, const FittedModel& base,
                                                      const DiagnosisSettings& settings) {
  const std::vector<std::string> varying = varying_factors(observations);
  const Procedure& rules = settings.procedure;
  for (std::size_t size = 0; size <= varying.size(); ++size) {
    std::vector<std::vector<std::string>> least;
    for (const std::vector<std::string>& factors : sets_of(varying, size)) {
      Observations with_levels = observations;
      with_levels.levels = level_directions(observations, factors, rules.noise.level_sd);
      if (chance_of_misfit(with_levels, base, settings) >= rules.levels.unexplained) least.push_back(factors);
    }
    if (least.empty()) continue;
    return size == 0 ? std::vector<std::vector<std::string>>{} : least;
  }
  return {};
}

std::vector<std::string> told_factors(const std::vector<std::vector<std::string>>& sets) {
  if (sets.empty()) return {};
  std::vector<std::string> told = sets.front();
  std::erase_if(told, [&](const std::string& factor) {
    return std::ranges::any_of(
        sets, [&](const std::vector<std::string>& other) { return std::ranges::find(other, factor) == other.end(); });
  });
  return told;
}

std::vector<std::string> without_law(std::vector<std::string> factors) {
  std::erase_if(factors, [](const std::string& factor) { return !is_without_law(factor); });
  return factors;
}

std::vector<std::string> factors_but_rate(const Observations& observations, std::vector<std::string> factors) {
  std::erase(factors, kStrainRate);
  const std::string material(kMaterial);
  const auto has_material = [&](const std::vector<std::string>& of) { return std::ranges::count(of, material) > 0; };
  if (!has_material(factors) && has_material(varying_factors(observations))) factors.push_back(material);
  return factors;
}

Eigen::MatrixXd free_directions(const Observations& observations, const FreeLevels& free, const NoiseRules& rules) {
  Eigen::MatrixXd directions = level_directions(observations, free.factors, rules.level_sd);
  if (!free.has_exponents) return directions;
  const Eigen::MatrixXd log_rates = log_rates_within_others(observations, free.factors);
  directions.conservativeResize(Eigen::NoChange, directions.cols() + log_rates.cols());
  directions.rightCols(log_rates.cols()) =
      exponent_scatter(observations, log_rates).value_or(rules.exponent_sd) * log_rates;
  return directions;
}

Observations with_levels_but_rate(Observations observations, std::vector<std::string> factors,
                                  const NoiseRules& rules) {
  observations.levels =
      free_directions(observations, {factors_but_rate(observations, std::move(factors)), false}, rules);
  return observations;
}

Observations with_free_exponents(Observations observations, const std::vector<std::string>& factors,
                                 const NoiseRules& rules) {
  observations.levels = free_directions(observations, {factors_but_rate(observations, factors), true}, rules);
  return observations;
}

namespace {

/// Of one material: rows that show its stiffness, by test.
std::map<std::string, std::vector<Eigen::Index>> stiffness_rows(const Observations& observations) {
  std::map<std::string, std::vector<Eigen::Index>> rows;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.kind != RowKind::mean || observations.group_of(i).design.layout()) continue;
    const Feature feature = row.test == tester::TestKind::modulus ? Feature::log_modulus : Feature::log_tangent_30;
    if (row.feature == feature)
      rows[fmt::format("{} {}", static_cast<int>(row.test), observations.group_of(i).material())].push_back(i);
  }
  return rows;
}

/// The far end of the interval of log E over the range of a condition; 0 where it does not vary.
double log_change_left(const Observations& observations, const Descriptor& condition,
                       const std::vector<Eigen::Index>& rows) {
  constexpr double kNinetyPercent = 1.645;
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(count, 2);
  for (Eigen::Index k = 0; k < count; ++k)
    columns(k, 1) = condition.of(observations.group_of(static_cast<int>(rows[k])));
  const double range = columns.col(1).maxCoeff() - columns.col(1).minCoeff();
  if (!(range > 0.0)) return 0.0;
  columns.col(1) = (columns.col(1).array() - columns.col(1).mean()) / range;
  const Whitener whitener(observations.covariance()(rows, rows));
  const Eigen::MatrixXd whitened = whitener(columns);
  const Eigen::LDLT<Eigen::MatrixXd> normal = (whitened.transpose() * whitened).ldlt();
  const Eigen::VectorXd line = normal.solve(whitened.transpose() * whitener(observations.values(rows)));
  Eigen::VectorXd change = Eigen::VectorXd::Zero(observations.size());
  change(rows) = columns.col(1);
  const double error = std::sqrt(normal.solve(Eigen::Vector2d::Unit(1))[1]);
  return std::abs(line[1]) + kNinetyPercent * student(dof_behind(observations, change)) * error;
}

}  // namespace

Change largest_change_left(const Observations& observations) {
  Change largest;
  const std::map<std::string, std::vector<Eigen::Index>> rows_of = stiffness_rows(observations);
  const std::vector<std::string> varying = varying_factors(observations);
  for (const Descriptor& condition : descriptors()) {
    const bool happened = condition.name == kPrintOrder || condition.name == kBatch;
    if (happened || std::ranges::find(varying, condition.name) == varying.end()) continue;
    for (const auto& [material, rows] : rows_of)
      if (const double size = std::expm1(log_change_left(observations, condition, rows)); size > largest.size)
        largest = {condition.name, size};
  }
  return largest;
}

bool rises_with_rate(const Observations& observations, const std::vector<std::string>& factors) {
  return (log_rates_within_others(observations, factors).transpose() * observations.values).sum() > 0.0;
}

}  // namespace nacre::diagnosis
