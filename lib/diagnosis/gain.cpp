#include "diagnosis/gain.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/random.hpp"

namespace nacre::diagnosis {
namespace {

struct LinearRefit {
  double chi2 = 0.0;
  Eigen::VectorXd delta;
};

LinearRefit refit(const FittedModel& fit, const std::vector<Eigen::Index>& rows, const Eigen::VectorXd& y,
                  const Whitener& whitener) {
  LinearRefit result;
  result.chi2 = linear_refit(fit.restricted(rows), y(rows), whitener, &result.delta);
  return result;
}

/// Predictions of all rows by a model refitted to `rows`, with the shared discretisation error expected from those
/// rows.
Eigen::VectorXd predicted_from(const Observations& observations, const FittedModel& fit, const LinearRefit& refit,
                               const std::vector<Eigen::Index>& rows) {
  const Eigen::VectorXd model = fit.predicted + fit.jacobian * refit.delta;
  const Eigen::VectorXd residuals = observations.values - model;
  return model + observations.expected_shared(residuals(rows), rows);
}

/// Whether the overall figure is that of coupons: there are no layouts, or none of these effects acts on the tests of
/// layouts that there are. Without effects layouts count where there are any.
bool coupons_count(const Observations& observations, const std::vector<std::string>& effects) {
  const auto tests_of_layouts = [&](tester::TestKind test) {
    return std::any_of(observations.groups.begin(), observations.groups.end(),
                       [test](const Observation& g) { return g.test == test && g.design.layout(); });
  };
  const bool modulus = tests_of_layouts(tester::TestKind::modulus),
             toughness = tests_of_layouts(tester::TestKind::toughness);
  const bool layouts_change =
      effects.empty() || std::any_of(effects.begin(), effects.end(), [&](const std::string& name) {
        const material::Effect& effect = *material::find_effect(name);
        return (modulus && effect.acts_on_modulus) || (toughness && effect.acts_on_toughness);
      });
  return !((modulus || toughness) && layouts_change);
}

/// Rows whose errors count for the overall figure: moduli and toughness; of coupons slopes and stresses, and moduli of
/// homogeneous specimens.
bool counts(const Observations& observations, int index, bool coupons) {
  const DataRow& row = observations.rows[index];
  const bool tensile = row.test == tester::TestKind::tensile;
  if (!coupons) return !tensile && (row.feature == Feature::log_modulus || row.feature == Feature::log_toughness);
  if (row.feature == Feature::log_modulus && !tensile) return observations.group_of(index).design.mixture() != nullptr;
  return tensile && (row.feature == Feature::log_tangent_10 || row.feature == Feature::log_tangent_30 ||
                     row.feature == Feature::log_tangent_50 || row.feature == Feature::log_peak);
}

/// Sums over the rows of one design.
struct DesignErrors {
  double before = 0.0, after = 0.0;
};

double reduction(const std::vector<DesignErrors>& errors, const std::vector<std::size_t>& picks) {
  double before = 0.0, after = 0.0;
  for (const std::size_t i : picks) before += errors[i].before, after += errors[i].after;
  return before > 0.0 ? 1.0 - after / before : 0.0;
}

/// Held-out errors of all rows that belong to a group, base and the model selected without them.
struct HeldOut {
  Eigen::VectorXd before, after;
};

HeldOut hold_out(const Observations& observations, const FittedModel& base, const ExtendedModels& extending, int folds,
                 const std::vector<std::vector<Eigen::Index>>& designs) {
  const Eigen::VectorXd& y = observations.values;
  const Observations& extended = extending.observations != nullptr ? *extending.observations : observations;
  const Eigen::MatrixXd covariance = observations.covariance(), of_extended = extended.covariance();
  HeldOut result{Eigen::VectorXd::Zero(y.size()), Eigen::VectorXd::Zero(y.size())};
  for (int fold = 0; fold < folds; ++fold) {
    std::vector<bool> held(y.size(), false);
    for (std::size_t d = fold; d < designs.size(); d += folds)
      for (const Eigen::Index row : designs[d]) held[row] = true;
    std::vector<Eigen::Index> train;
    for (Eigen::Index row = 0; row < y.size(); ++row)
      if (!held[row]) train.push_back(row);
    const LinearRefit plain = refit(base, train, y, Whitener(covariance(train, train)));
    const Whitener whitener(of_extended(train, train));
    const FittedModel* chosen = &base;
    LinearRefit chosen_refit = plain;
    std::vector<FittedModel> fitted = extending.models;
    for (FittedModel& model : fitted) {
      LinearRefit own;
      if (extending.refits != nullptr) {
        model = extending.refits->without(held, extended, model);
        own = {whitener.chi2(y(train) - model.predicted(train)), Eigen::VectorXd::Zero(model.u.size())};
      } else {
        own = refit(model, train, y, whitener);
      }
      if (own.chi2 < chosen_refit.chi2 && own.chi2 < plain.chi2 - extending.least_drop)
        chosen = &model, chosen_refit = own;
    }
    const Eigen::VectorXd before = y - predicted_from(observations, base, plain, train),
                          after = y - predicted_from(extended, *chosen, chosen_refit, train);
    for (Eigen::Index row = 0; row < y.size(); ++row)
      if (held[row]) result.before[row] = before[row], result.after[row] = after[row];
  }
  return result;
}

/// The key of groups that are held out together: a layout with its twins, homogeneous specimens of one material under
/// one set of conditions. Without a whole material its constants would be undetermined.
std::string held_out_with(const Observation& group) {
  const std::string name = group.design.name();
  if (group.design.layout()) return name;
  if (group.test == tester::TestKind::tensile) return fmt::format("{} {}", name, group.conditions.strain_rate_per_s);
  return fmt::format("{} {} {} {}", name, group.conditions.strain_rate_per_s, group.conditions.thickness_mm,
                     measurement::nominal_surroundings(group.surroundings));
}

/// The rows that are held out together, in an order shuffled by the seed.
std::vector<std::vector<Eigen::Index>> shuffled_designs(const Observations& observations, std::uint64_t seed) {
  std::map<std::string, std::vector<Eigen::Index>> rows_of;
  for (int i = 0; i < observations.size(); ++i)
    if (observations.rows[i].group >= 0) rows_of[held_out_with(observations.group_of(i))].push_back(i);
  std::vector<std::vector<Eigen::Index>> designs;
  for (const auto& [name, rows] : rows_of) designs.push_back(rows);
  RandomStream random(seed, "gain/folds");
  for (std::size_t i = designs.size(); i > 1; --i)
    std::swap(designs[i - 1], designs[random.index(static_cast<int>(i))]);
  return designs;
}

/// Reduction of the error, with its interval from a bootstrap over designs.
void put_reduction(Gain& gain, const std::vector<DesignErrors>& errors, int count, std::uint64_t seed) {
  std::vector<std::size_t> all(errors.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  gain.relative_reduction = reduction(errors, all);
  RandomStream draws(seed, "gain/interval");
  std::vector<double> reductions;
  for (int i = 0; i < count; ++i) {
    std::vector<std::size_t> picks(errors.size());
    for (std::size_t& pick : picks) pick = draws.index(static_cast<int>(errors.size()));
    reductions.push_back(reduction(errors, picks));
  }
  std::sort(reductions.begin(), reductions.end());
  gain.interval_low = reductions[count / 20];
  gain.interval_high = reductions[count - 1 - count / 20];
}

/// Rows of one feature of layouts, under tests of one kind and the same conditions.
bool are_comparable(const Observations& observations, int a, int b) {
  const DataRow &one = observations.rows[a], &other = observations.rows[b];
  if (one.group < 0 || other.group < 0 || one.feature != other.feature || one.test != other.test) return false;
  const Observation &g = observations.group_of(a), &h = observations.group_of(b);
  return g.design.layout() && h.design.layout() && g.conditions == h.conditions;
}

/// Pairs of layouts in the measured order, by this feature.
Ranking ranking_by(Feature feature, const Observations& observations, const HeldOut& held, double set_apart) {
  Ranking ranking;
  const Eigen::VectorXd& y = observations.values;
  const auto ordered_by = [&](const Eigen::VectorXd& errors, int a, int b) {
    return (y[a] > y[b]) == (y[a] - errors[a] > y[b] - errors[b]);
  };
  for (int b = 1; b < observations.size(); ++b) {
    const DataRow& row = observations.rows[b];
    if (row.feature != feature) continue;
    for (int a = 0; a < b; ++a) {
      if (!are_comparable(observations, a, b)) continue;
      const double weight = observations.rows[a].weight + row.weight;
      const double error = observations.replicate_sd(feature, row.test) * std::sqrt(weight);
      if (std::abs(y[a] - y[b]) < set_apart * error) continue;
      ++ranking.pairs;
      ranking.before += ordered_by(held.before, a, b);
      ranking.after += ordered_by(held.after, a, b);
    }
  }
  return ranking;
}

std::vector<FeatureGain> gain_by_feature(const Observations& observations, const HeldOut& held, double set_apart) {
  // A normal error of deviation s is 0.8 s large on average. The shared discretisation error is in the predictions.
  const Eigen::VectorXd deviation = observations.own_variances().cwiseSqrt();
  std::map<Feature, std::pair<FeatureGain, int>> by_feature;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.group < 0) continue;
    auto& [sums, count] = by_feature[row.feature];
    sums.feature = row.feature;
    sums.before += std::abs(held.before[i]);
    sums.after += std::abs(held.after[i]);
    sums.noise += 0.7979 * deviation[i];
    ++count;
  }
  std::vector<FeatureGain> gains;
  for (auto& [feature, entry] : by_feature) {
    auto& [sums, count] = entry;
    gains.push_back({feature, sums.before / count, sums.after / count, sums.noise / count,
                     ranking_by(feature, observations, held, set_apart)});
  }
  return gains;
}

}  // namespace

double drop_needed(const Evidence& evidence) {
  std::vector<double> drops;
  for (const DrawStatistics& draw : evidence.base_draws) drops.push_back(draw.largest_drop());
  return threshold(std::move(drops), evidence.settings.procedure.levels.name);
}

FittedModel ExactRefits::without(const std::vector<bool>& held, Observations observations,
                                 const FittedModel& fit) const {
  constexpr double kTellsNothing = 1e6;  // log units, squared
  if (observations.emulator_variance.size() != observations.size())
    observations.emulator_variance = Eigen::VectorXd::Zero(observations.size());
  for (std::size_t row = 0; row < held.size(); ++row)
    if (held[row]) observations.emulator_variance[static_cast<Eigen::Index>(row)] = kTellsNothing;
  return fit_model(model, observations, rules, fit.effects, fit.u);
}

Gain gain_of(const Evidence& evidence, const FittedModel& decided) {
  std::vector<FittedModel> models = evidence.singles;
  if (std::ranges::find(models, decided.effects, &FittedModel::effects) == models.end()) models.push_back(decided);
  return held_out_gain(evidence.observations, evidence.base.fit,
                       {.models = std::move(models), .least_drop = drop_needed(evidence)}, decided.effects,
                       evidence.settings.procedure.gain, evidence.settings.seed);
}

Gain held_out_gain(const Observations& observations, const FittedModel& base, const ExtendedModels& extending,
                   const std::vector<std::string>& effects, const GainRules& rules, std::uint64_t seed) {
  const std::vector<std::vector<Eigen::Index>> designs = shuffled_designs(observations, seed);
  const HeldOut held = hold_out(observations, base, extending, rules.folds, designs);
  Gain gain;
  gain.of_coupons = coupons_count(observations, effects);
  int rows = 0;
  std::vector<DesignErrors> errors(designs.size());
  for (std::size_t d = 0; d < designs.size(); ++d) {
    for (const Eigen::Index row : designs[d]) {
      if (!counts(observations, static_cast<int>(row), gain.of_coupons)) continue;
      errors[d].before += std::abs(held.before[row]);
      errors[d].after += std::abs(held.after[row]);
      ++rows;
    }
    gain.held_out_error_before += errors[d].before;
    gain.held_out_error_after += errors[d].after;
  }
  gain.held_out_error_before /= std::max(rows, 1);
  gain.held_out_error_after /= std::max(rows, 1);
  put_reduction(gain, errors, rules.interval_draws, seed);
  gain.features = gain_by_feature(observations, held, rules.set_apart);
  return gain;
}

}  // namespace nacre::diagnosis
