#include "diagnosis/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "diagnosis/joined_sets.hpp"
#include "measurement/piece.hpp"
#include "measurement/surroundings.hpp"
#include "sysid/likelihood.hpp"

namespace nacre::diagnosis {
namespace {

/// Replicates that agree better than a testing machine reads do not determine scatter; exactly equal ones would leave a
/// singular covariance.
double least_sd(std::size_t f, const NoiseRules& rules) {
  const auto feature = static_cast<Feature>(f);
  return feature == Feature::toe_strain    ? rules.least_strain_sd
         : feature == Feature::log_modulus ? rules.least_modulus_sd
                                           : rules.least_curve_sd;
}

/// Without replicates a scatter must still be assumed to weigh specimens; every statement is then relative to the fit.
AssumedScatter assumed_scatter(const NoiseRules& rules) {
  const double sd = rules.assumed_sd;
  return {.modulus = sd, .stress = sd, .strain = sd, .toe_strain = rules.assumed_toe * sd};
}

double assumed_sd(Feature f, const AssumedScatter& scatter) {
  switch (f) {
    case Feature::log_modulus:
      return scatter.modulus;
    case Feature::toe_strain:
      return scatter.toe_strain;
    case Feature::log_peak_strain:
    case Feature::knee:
    case Feature::set_share:
    case Feature::toe_share:
    case Feature::log_held:
    case Feature::held_set:
    case Feature::dwelled_set:
      return scatter.strain;
    default:
      return scatter.stress;
  }
}

/// The mean of all deviations of one kind comes off each of them.
void take_off_means(std::vector<Deviation>& deviations, const std::function<double(const Deviation&)>& kind) {
  std::map<double, std::pair<FeatureValues, std::array<int, kFeatureCount>>> sums;
  for (const Deviation& d : deviations) {
    auto& [sum, count] = sums[kind(d)];
    for (std::size_t f = 0; f < kFeatureCount; ++f)
      if (d.from_mean[f]) sum[f] = sum[f].value_or(0.0) + *d.from_mean[f], ++count[f];
  }
  for (Deviation& d : deviations) {
    const auto& [sum, count] = sums[kind(d)];
    for (std::size_t f = 0; f < kFeatureCount; ++f)
      if (d.from_mean[f]) *d.from_mean[f] -= *sum[f] / count[f];
  }
}

double batch_of(const Deviation& d) { return d.measured->batch_step; }

/// Takes off the means of batches, then the means of groups that this leaves, in turn.
void take_off_batches(std::vector<Deviation>& deviations) {
  constexpr int kTurns = 10;
  for (int turn = 0; turn < kTurns; ++turn) {
    take_off_means(deviations, batch_of);
    take_off_means(deviations, [](const Deviation& d) { return static_cast<double>(d.group); });
  }
}

/// How many differences between batches these groups determine.
int batch_differences(const std::vector<Deviation>& deviations) {
  std::map<int, std::set<double>> batches_of_group;
  for (const Deviation& d : deviations) batches_of_group[d.group].insert(batch_of(d));
  int count = 0;
  for (const std::set<double>& batches : joined(batches_of_group)) count += static_cast<int>(batches.size()) - 1;
  return count;
}

/// Sums of squares and products of the deviations. A feature that some groups do not show (an unloading slope, the peak
/// of a specimen without a curve) must not appear to scatter less: there the loading slope takes the place of the
/// unloading slope, and for every degree of freedom filled in so the assumed variance is added, or the feature's own
/// where that is larger.
Eigen::MatrixXd sums_of_products(const std::vector<Deviation>& deviations, int dof, const AssumedScatter& assumed) {
  const auto count = static_cast<double>(deviations.size());
  std::vector<FeatureValues> filled;
  std::array<int, kFeatureCount> lacking{};
  for (const Deviation& d : deviations) {
    filled.push_back(d.from_mean);
    auto& unloading = value_of(filled.back(), Feature::log_unloading);
    if (!unloading) unloading = value_of(d.from_mean, Feature::log_tangent_30);
    for (std::size_t f = 0; f < kFeatureCount; ++f) lacking[f] += !d.from_mean[f];
  }
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(kFeatureCount, kFeatureCount);
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    for (std::size_t g = 0; g <= f; ++g) {
      double sum = 0.0;
      for (const FeatureValues& each : filled)
        if (each[f] && each[g]) sum += *each[f] * *each[g];
      const auto i = static_cast<Eigen::Index>(f), j = static_cast<Eigen::Index>(g);
      products(i, j) = products(j, i) = sum;
    }
    if (lacking[f] == 0) continue;
    double own = 0.0;
    for (const Deviation& d : deviations) own += std::pow(d.from_mean[f].value_or(0.0), 2);
    const double filled_dof = dof * lacking[f] / count, own_dof = dof - filled_dof;
    products.diagonal()[f] += filled_dof * std::max(std::pow(assumed_sd(static_cast<Feature>(f), assumed), 2),
                                                    own_dof > 0.0 ? own / own_dof : 0.0);
  }
  return products;
}

/// The share of their variance that pieces keep from one group to another: the mean of the products of their deviations
/// in both, over that of the squares. 0 where no two pieces of a group are in another.
double piece_share_of(const std::vector<Deviation>& deviations) {
  std::map<std::string, std::vector<const Deviation*>> of_piece;
  for (const Deviation& d : deviations) of_piece[measurement::piece_of(*d.measured->specimen)].push_back(&d);
  double products = 0.0, squares = 0.0;
  for (const auto& [piece, own] : of_piece) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (own[i]->group == own[j]->group) continue;
        for (std::size_t f = 0; f < kFeatureCount; ++f) {
          const auto &a = own[i]->from_mean[f], &b = own[j]->from_mean[f];
          if (!a || !b) continue;
          products += *a * *b;
          squares += 0.5 * (*a * *a + *b * *b);
        }
      }
    }
  }
  constexpr double kMost = 0.999;  // a covariance must stay positive definite
  return squares > 0.0 ? std::clamp(products / squares, 0.0, kMost) : 0.0;
}

/// Whether a piece was tested in several groups of this test.
bool pieces_return(const std::vector<std::vector<Measured>>& groups, tester::TestKind test) {
  std::set<std::string> seen;
  for (const auto& group : groups)
    for (const Measured& each : group)
      if (each.specimen->test == test && !seen.insert(measurement::piece_of(*each.specimen)).second) return true;
  return false;
}

/// Variance of log E about lines over the logarithm of the rate, within each material, or each piece, under otherwise
/// equal conditions, and its degrees of freedom. What is no line counts as scatter: nothing tells them apart.
std::pair<double, int> variance_about_lines(const std::vector<std::vector<Measured>>& groups, tester::TestKind test,
                                            bool of_pieces) {
  std::map<std::string, std::vector<std::pair<double, double>>> points;
  for (const auto& group : groups) {
    for (const Measured& each : group) {
      const measurement::SpecimenRecord& specimen = *each.specimen;
      const auto& log_e = value_of(each.features, Feature::log_modulus);
      if (specimen.test != test || !specimen.design.mixture() || !log_e) continue;
      const tester::TestConditions& c = specimen.conditions;
      const std::string key = fmt::format("{} {} {} {} {}", specimen.design.name(), c.orientation_deg, c.thickness_mm,
                                          measurement::nominal_surroundings(measurement::surroundings_of(specimen)),
                                          of_pieces ? measurement::piece_of(specimen) : "");
      points[key].emplace_back(std::log(c.strain_rate_per_s), *log_e);
    }
  }
  double squares = 0.0;
  int dof = 0;
  for (const auto& [key, own] : points) {
    const auto count = static_cast<Eigen::Index>(own.size());
    if (count < 3) continue;
    Eigen::MatrixXd line(count, 2);
    Eigen::VectorXd log_e(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      line.row(i) << 1.0, own[i].first;
      log_e[i] = own[i].second;
    }
    squares += (log_e - line * line.colPivHouseholderQr().solve(log_e)).squaredNorm();
    dof += static_cast<int>(count) - 2;
  }
  return {dof > 0 ? squares / dof : 0.0, dof};
}

bool are_all_homogeneous(const std::vector<std::vector<Measured>>& groups, tester::TestKind test) {
  return std::ranges::all_of(groups, [test](const std::vector<Measured>& group) {
    const measurement::SpecimenRecord& first = *group.front().specimen;
    return first.test != test || first.design.mixture() != nullptr;
  });
}

/// Without replicates. Of layouts the assumed scatter is known; homogeneous specimens may be of any material: theirs is
/// an opinion worth some degrees of freedom, and no less than what their moduli show. Where one piece stands for a
/// material at all conditions, how it differs from the next piece is assumed too, and what changes from one of its
/// tests to the next is known as well as a single test.
ReplicateScatter assumed_for(const std::vector<std::vector<Measured>>& groups, tester::TestKind test,
                             Eigen::MatrixXd covariance, const NoiseRules& rules) {
  ReplicateScatter scatter{std::move(covariance), 0, rules.enough_dof};
  const bool of_pieces = pieces_return(groups, test);
  const double assumed = rules.assumed_sd * rules.assumed_sd;
  double single = assumed;
  if (are_all_homogeneous(groups, test)) {
    scatter.worth = rules.assumed_worth;
    const auto [about_lines, dof] = variance_about_lines(groups, test, of_pieces);
    if (dof >= 2 && about_lines > assumed) {
      single = about_lines;
      scatter.worth = std::min(dof, rules.enough_dof);
    }
  }
  const double all = of_pieces ? rules.piece_sd * rules.piece_sd - assumed + single : single;
  scatter.covariance *= all / assumed;
  scatter.piece_share = 1.0 - single / all;
  return scatter;
}

/// Degrees of freedom within groups.
int dof_within(const std::vector<Deviation>& deviations) {
  std::set<int> groups;
  for (const Deviation& d : deviations) groups.insert(d.group);
  return deviations.size() - groups.size();
}

/// Pieces beyond one in each set of groups that share some.
int dof_of_pieces(const std::vector<Deviation>& deviations) {
  std::map<int, std::set<std::string>> of_group;
  std::set<std::string> all;
  for (const Deviation& d : deviations) {
    const std::string piece = measurement::piece_of(*d.measured->specimen);
    of_group[d.group].insert(piece);
    all.insert(piece);
  }
  return static_cast<int>(all.size()) - static_cast<int>(joined(of_group).size());
}

/// Whether every feature that all specimens show scatters less than is assumed.
bool agree_too_well(const std::vector<Deviation>& deviations, const Eigen::MatrixXd& covariance,
                    const Eigen::MatrixXd& assumed) {
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    const auto i = static_cast<Eigen::Index>(f);
    const bool all_show_it = std::ranges::all_of(deviations, [f](const Deviation& d) { return bool(d.from_mean[f]); });
    if (all_show_it && covariance(i, i) > assumed(i, i)) return false;
  }
  return true;
}

/// Correlations of one covariance, variances of another. Few replicates determine how much one material scatters, not
/// how its features correlate: combinations of features that seem not to scatter would count for everything.
Eigen::MatrixXd with_correlations_of(const Eigen::MatrixXd& all, const Eigen::MatrixXd& own) {
  const Eigen::VectorXd scale = (own.diagonal().array() / all.diagonal().array()).sqrt();
  return scale.asDiagonal() * all * scale.asDiagonal();
}

}  // namespace

Eigen::MatrixXd covariance_of(const AssumedScatter& scatter, const NoiseRules& rules) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kFeatureCount, kFeatureCount);
  for (int i = 0; i < kFeatureCount; ++i) {
    for (int j = 0; j < kFeatureCount; ++j) {
      const auto a = static_cast<Feature>(i), b = static_cast<Feature>(j);
      const double correlation = i == j                                     ? 1.0
                                 : is_curve_stress(a) && is_curve_stress(b) ? rules.stresses_together
                                                                            : 0.0;
      covariance(i, j) = correlation * assumed_sd(a, scatter) * assumed_sd(b, scatter);
    }
  }
  return covariance;
}

std::vector<Deviation> deviations_of(const std::vector<std::vector<Measured>>& groups, tester::TestKind test) {
  std::vector<Deviation> deviations;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].size() < 2 || groups[g].front().specimen->test != test) continue;
    FeatureValues mean;
    for (std::size_t f = 0; f < kFeatureCount; ++f) {
      const bool all =
          std::all_of(groups[g].begin(), groups[g].end(), [f](const Measured& m) { return m.features[f].has_value(); });
      if (!all) continue;
      double sum = 0.0;
      for (const Measured& each : groups[g]) sum += *each.features[f];
      mean[f] = sum / static_cast<double>(groups[g].size());
    }
    for (const Measured& each : groups[g]) {
      Deviation deviation{&each, static_cast<int>(g), {}};
      for (std::size_t f = 0; f < kFeatureCount; ++f)
        if (mean[f]) deviation.from_mean[f] = *each.features[f] - *mean[f];
      deviations.push_back(deviation);
    }
  }
  return deviations;
}

ReplicateScatter pooled_scatter(const std::vector<std::vector<Measured>>& groups, tester::TestKind test,
                                const NoiseRules& rules, const std::string& design) {
  std::vector<Deviation> deviations = deviations_of(groups, test);
  const int within = dof_within(deviations);
  // Means of batches come off where enough is left to estimate scatter.
  const int differences = batch_differences(deviations);
  const int of_pieces = std::min(within, dof_of_pieces(deviations));
  const bool by_batch = differences > 0 && of_pieces >= rules.dof_per_batch * differences;
  if (by_batch) take_off_batches(deviations);
  ReplicateScatter scatter;
  scatter.piece_share = piece_share_of(deviations);
  scatter.dof = within - (by_batch ? differences : 0);
  scatter.piece_dof = of_pieces - (by_batch ? differences : 0);
  if (!design.empty()) {
    std::erase_if(deviations, [&](const Deviation& d) { return d.measured->specimen->design.name() != design; });
    // All designs share the means of batches: each bears its share of the degrees of freedom that they take.
    scatter.dof = within > 0 ? dof_within(deviations) * scatter.dof / within : 0;
    scatter.piece_dof = std::min(scatter.dof, dof_of_pieces(deviations));
  }
  const AssumedScatter assumption = assumed_scatter(rules);
  const Eigen::MatrixXd assumed = covariance_of(assumption, rules);
  if (scatter.dof <= 0) return assumed_for(groups, test, assumed, rules);
  int features = 0;
  for (std::size_t f = 0; f < kFeatureCount; ++f)
    features += std::any_of(deviations.begin(), deviations.end(),
                            [f](const Deviation& d) { return d.from_mean[f].has_value(); });
  scatter.covariance = sums_of_products(deviations, scatter.dof, assumption) / scatter.dof;
  if (scatter.dof < rules.enough_dof && agree_too_well(deviations, scatter.covariance, assumed)) {
    scatter.assumed_dof = rules.enough_dof - scatter.dof;
    scatter.covariance = (scatter.dof * scatter.covariance + scatter.assumed_dof * assumed) / rules.enough_dof;
  }
  const double dof = scatter.dof + scatter.assumed_dof, keep = dof / (dof + features);
  for (Eigen::Index f = 0; f < kFeatureCount; ++f) {
    for (Eigen::Index g = 0; g < kFeatureCount; ++g)
      if (f != g) scatter.covariance(f, g) *= keep;
    const double least = least_sd(f, rules);
    scatter.covariance(f, f) = std::max(scatter.covariance(f, f), least * least);
  }
  return scatter;
}

bool materials_scatter_differently(const std::vector<std::vector<Measured>>& groups, const NoiseRules& rules) {
  std::map<std::string, std::vector<std::vector<Measured>>> groups_of;
  for (const auto& group : groups) {
    const measurement::SpecimenRecord& first = *group.front().specimen;
    if (first.test == tester::TestKind::modulus && first.design.mixture())
      groups_of[first.design.name()].push_back(group);
  }
  std::map<std::string, std::pair<double, int>> of_material;  // sum of squares, degrees of freedom
  for (const auto& [material, own] : groups_of) {
    const std::vector<Deviation> deviations = deviations_of(own, tester::TestKind::modulus);
    auto& [squares, dof] = of_material[material];
    for (const Deviation& each : deviations)
      squares += std::pow(value_of(each.from_mean, Feature::log_modulus).value_or(0.0), 2);
    const int tests = dof_within(deviations);
    dof = std::min(tests, dof_of_pieces(deviations));
    if (dof < tests) squares *= static_cast<double>(dof) / tests;
  }
  std::erase_if(of_material, [&](const auto& entry) { return entry.second.second < rules.own_dof; });
  if (of_material.size() < 2) return false;
  double squares = 0.0, logarithms = 0.0, inverse = 0.0;
  int dof = 0;
  for (const auto& [material, own] : of_material) {
    const double variance = std::max(own.first / own.second, std::pow(rules.least_modulus_sd, 2));
    squares += own.second * variance;
    dof += own.second;
    logarithms += own.second * std::log(variance);
    inverse += 1.0 / own.second;
  }
  const int differences = static_cast<int>(of_material.size()) - 1;
  const double correction = 1.0 + (inverse - 1.0 / dof) / (3.0 * differences);
  const double bartlett = (dof * std::log(squares / dof) - logarithms) / correction;
  constexpr double kMany = 1e6;  // F of so many below is chi squared
  return sysid::f_tail(bartlett / differences, differences, kMany) < rules.unlike_scatter;
}

double student(int dof) {
  if (dof <= 0) return 2.0 / 1.645;
  const double v = 1.0 / dof;
  return 1.0 + v * (0.926 + v * (0.863 + v * (0.598 + v * 0.264)));
}

int dof_behind(const Observations& observations, const Eigen::VectorXd& change) {
  const Eigen::VectorXd variances = observations.covariance().diagonal();
  std::vector<double> information(observations.scatter.size());
  for (int i = 0; i < observations.size(); ++i)
    information[observations.rows[i].scatter] += std::pow(change[i], 2) / variances[i];
  const ReplicateScatter& most = observations.scatter[std::ranges::max_element(information) - information.begin()];
  return most.dof > 0 ? most.dof + most.assumed_dof : most.worth;
}

int disconnected_batches(const std::vector<std::vector<Measured>>& groups) {
  std::map<int, std::set<double>> batches_of_group;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Measured& each : groups[g])
      if (!each.specimen->batch.empty()) batches_of_group[static_cast<int>(g)].insert(each.batch_step);
  return static_cast<int>(joined(batches_of_group).size());
}

void put_scatter(Observations& observations, const std::vector<std::vector<Measured>>& groups,
                 const NoiseRules& rules) {
  std::vector<std::vector<Measured>> notched_layouts, notched_bulk;
  for (const auto& group : groups) {
    const measurement::SpecimenRecord& first = *group.front().specimen;
    if (first.test == tester::TestKind::toughness)
      (first.design.layout() ? notched_layouts : notched_bulk).push_back(group);
  }
  const bool both_notched = !notched_layouts.empty() && !notched_bulk.empty();
  for (int t = 0; t < 3; ++t) {
    const auto test = static_cast<tester::TestKind>(t);
    observations.scatter[t] =
        pooled_scatter(both_notched && test == tester::TestKind::toughness ? notched_layouts : groups, test, rules);
  }
  const std::size_t of_notched_bulk = observations.scatter.size();
  if (both_notched) observations.scatter.push_back(pooled_scatter(notched_bulk, tester::TestKind::toughness, rules));
  const bool moduli_by_material = materials_scatter_differently(groups, rules);
  std::map<std::pair<tester::TestKind, std::string>, std::size_t> own;
  for (DataRow& row : observations.rows) {
    row.scatter = static_cast<std::size_t>(row.test);
    if (row.group < 0) continue;
    const Observation& group = observations.groups[row.group];
    if (both_notched && is_notched_bulk(group)) row.scatter = of_notched_bulk;
    const bool is_own_modulus = row.test == tester::TestKind::modulus && group.design.mixture() && moduli_by_material;
    if (row.test != tester::TestKind::tensile && !is_own_modulus) continue;
    const std::string material = group.material();
    const auto [place, unknown] = own.emplace(std::pair(row.test, material), row.scatter);
    if (unknown) {
      ReplicateScatter scatter = pooled_scatter(groups, row.test, rules, material);
      if (std::min(scatter.dof, scatter.piece_dof) >= rules.own_dof) {
        place->second = observations.scatter.size();
        scatter.covariance = with_correlations_of(observations.scatter[row.scatter].covariance, scatter.covariance);
        observations.scatter.push_back(std::move(scatter));
      }
    }
    row.scatter = place->second;
  }
}

}  // namespace nacre::diagnosis
