#include "sysid/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <optional>
#include <span>

#include "base/random.hpp"
#include "sysid/eta.hpp"
#include "sysid/fit.hpp"
#include "sysid/least_squares_fit.hpp"
#include "sysid/likelihood.hpp"
#include "sysid/objective.hpp"
#include "sysid/parallel_fit.hpp"
#include "sysid/posterior_fit.hpp"
#include "sysid/rivals/emulator_fit.hpp"
#include "sysid/rivals/objective_fit.hpp"
#include "sysid/spread.hpp"
#include "sysid/weights.hpp"

namespace nacre::sysid {
namespace {

using material::ParameterRange;
using material::ParameterSet;

/// The fit of one tester's parameters, and the measured designs that it uses.
struct TesterFit {
  std::unique_ptr<ParameterFit> fit;  ///< none when nothing was measured
  std::vector<std::size_t> items;     ///< indices into the measured designs
  double progress() const { return fit ? fit->progress() : 1.0; }
  double freedom_taken() const { return fit ? fit->freedom_taken() : 0.0; }
};

/// How a fit went: objectives of all trials, of the initial guess and of the best.
struct FitCourse {
  std::vector<double>& all;
  double &before, &after;
};

template <class Vector>
Point to_point(const Vector& vector, std::span<const ParameterRange> ranges, std::size_t dimensions) {
  Point point;
  for (std::size_t j = 0; j < dimensions; ++j) point.push_back(std::clamp(to_unit(ranges[j], vector[j]), 0.0, 1.0));
  return point;
}

FitData data_of(const std::vector<measurement::Replicates>& measured, const std::vector<double>& weights,
                const std::vector<double>& evidence, const std::vector<std::size_t>& items) {
  FitData data;
  for (const std::size_t item : items) {
    data.measured.push_back(measured[item]);
    data.weights.push_back(weights[item]);
    if (!evidence.empty()) data.evidence.push_back(evidence[item]);
  }
  return data;
}

/// The algorithm behind a search that sees the objective only.
optimize::Algorithm algorithm_of(ToughnessSearch search) {
  switch (search) {
    case ToughnessSearch::bayesian:
      return optimize::Algorithm::bayesian;
    case ToughnessSearch::random:
      return optimize::Algorithm::random;
    case ToughnessSearch::direct_l:
      return optimize::Algorithm::direct_l;
    case ToughnessSearch::crs2:
      return optimize::Algorithm::crs2;
    case ToughnessSearch::cma_es:
      return optimize::Algorithm::cma_es;
    default:
      return optimize::Algorithm::trust_region;
  }
}

/// Parameters of theta that act in the static tester: all but gamma, which stands last.
constexpr std::size_t kModulusDimensions = material::kModulusParameterCount - 1;
constexpr std::size_t kToughnessDimensions = material::kToughnessParameterCount;

/// A coordinate with a discretisation error besides, of standard deviation `log_sd` in the parameter's natural
/// logarithm.
CoordinateInterval widened(const CoordinateInterval& interval, const ParameterRange& range, double value,
                           double log_sd) {
  if (log_sd <= 0.0) return interval;
  const double sd = range.logarithmic() ? log_sd / std::log(range.maximum / range.minimum)
                                        : log_sd * value / (range.maximum - range.minimum);
  const double middle = 0.5 * (interval.low90 + interval.high90);
  const double half = std::hypot(0.5 * (interval.high90 - interval.low90), 1.645 * sd);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half), std::hypot(interval.deviation, sd)};
}

}  // namespace

struct Calibration::State {
  std::vector<measurement::Replicates> measured;
  CalibrationSettings settings;
  std::vector<double> weights;
  TesterFit modulus, toughness;
  std::vector<WantedEvaluation> wanted;
  std::size_t modulus_wanted = 0;  ///< the first ones of `wanted`; the rest are for toughness
  std::vector<std::optional<std::vector<Prediction>>> told;
  int batch_number = 0;
  int toughness_evaluations = 0;
  bool fitting_scatter = false;  ///< strength_cv, before the rest
  Calibrated result;

  std::span<const ParameterRange> modulus_ranges() const { return settings.ranges.modulus(settings.target); }
  std::span<const ParameterRange> toughness_ranges() const { return settings.ranges.toughness(settings.target); }

  /// `point` as a complete set: coordinates that did not move from a start in range, or that may not move (no
  /// `budget`), keep its exact value.
  template <class Vector>
  static Vector from_point(const Point& point, const Point& start_point, Vector vector,
                           std::span<const ParameterRange> ranges, int budget) {
    for (std::size_t j = 0; j < point.size(); ++j) {
      const bool start_inside = vector[j] >= ranges[j].minimum && vector[j] <= ranges[j].maximum;
      if (point[j] != start_point[j] || (!start_inside && budget > 0)) {
        vector[j] = std::clamp(from_unit(ranges[j], point[j]), ranges[j].minimum, ranges[j].maximum);
      }
    }
    return vector;
  }
  material::ModulusParameters modulus_at(const Point& point) const {
    const material::ModulusVector start = to_vector(settings.start.modulus);
    return material::modulus_from_vector(from_point(point, to_point(start, modulus_ranges(), kModulusDimensions), start,
                                                    modulus_ranges(), settings.modulus_budget));
  }
  material::ToughnessParameters toughness_at(const Point& point) const {
    const material::ToughnessVector start = to_vector(settings.start.toughness);
    return material::toughness_from_vector(from_point(point, to_point(start, toughness_ranges(), kToughnessDimensions),
                                                      start, toughness_ranges(), settings.toughness_budget));
  }

  void begin() {
    weights = settings.weights.empty() ? sample_weights(measured) : settings.weights;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      if (measured[i].modulus_count > 0) modulus.items.push_back(i);
      if (measured[i].toughness_count > 0) toughness.items.push_back(i);
    }
    result.parameters = settings.start;
    result.predictions.resize(measured.size());
    if (!modulus.items.empty()) {
      modulus.fit =
          make_modulus_fit(data_of(measured, weights, settings.weights, modulus.items),
                           {.start = to_point(to_vector(settings.start.modulus), modulus_ranges(), kModulusDimensions),
                            .budget = std::max(1, settings.modulus_budget),
                            .batch = settings.batch,
                            .seed = settings.seed,
                            .floor = settings.floor});
    }
    if (!toughness.items.empty()) begin_toughness();
    if (!ask_for_scatter()) ask();
  }

  void begin_toughness() {
    std::vector<std::unique_ptr<ParameterFit>> fits;
    for (int k = 0; k < std::max(1, settings.searches); ++k) {
      const FitSettings fit_settings = {
          .start = to_point(to_vector(settings.start.toughness), toughness_ranges(), kToughnessDimensions),
          .budget = std::max(1, settings.toughness_budget),
          .batch = settings.batch,
          .seed = k == 0 ? settings.seed : RandomStream(settings.seed, fmt::format("search {}", k)).bits(),
          .floor = settings.floor};
      fits.push_back(make_toughness_fit(fit_settings));
    }
    toughness.fit = make_parallel_fit(std::move(fits));
  }

  std::unique_ptr<ParameterFit> make_toughness_fit(const FitSettings& fit_settings) const {
    FitData data = data_of(measured, weights, settings.weights, toughness.items);
    std::vector<Point> others = settings.other_starts.empty() ? other_starts(fit_settings.start) : given_starts();
    switch (settings.toughness_search) {
      case ToughnessSearch::posterior:
        return make_posterior_fit(std::move(data), fit_settings, toughness_ranges(), std::move(others));
      case ToughnessSearch::emulator:
        return make_emulator_fit(std::move(data), fit_settings, toughness_ranges(), std::move(others));
      case ToughnessSearch::gauss_newton:
        return make_gauss_newton_fit(std::move(data), fit_settings);
      default:
        break;
    }
    return make_objective_fit(std::move(data), fit_settings, toughness_ranges(), std::move(others),
                              algorithm_of(settings.toughness_search));
  }

  std::vector<Point> given_starts() const {
    std::vector<Point> others;
    for (const ParameterSet& set : settings.other_starts)
      others.push_back(to_point(to_vector(set.toughness), toughness_ranges(), kToughnessDimensions));
    return others;
  }

  /// The further initial guesses of the first batch: the middle of the ranges, and the start with another interface.
  std::vector<Point> other_starts(const Point& start) const {
    constexpr double kApart = 1e-3;  // mean square distance below which two starts are one
    Point middle = start, interface = start;
    for (const std::size_t j : kSearchedEta) middle[j] = 0.5;
    for (const std::size_t j : {kE0 + 2, kW0 + 2}) interface[j] += interface[j] > 0.5 ? -0.2 : 0.2;
    std::vector<Point> others;
    if (pull_to_start(middle, start, 1.0) > kApart) others.push_back(middle);
    others.push_back(interface);
    return others;
  }

  void ask() {
    wanted.clear();
    ++batch_number;
    const auto add = [&](const TesterFit& tester, bool is_modulus) {
      if (tester.fit == nullptr) return;
      const std::vector<Point> points = tester.fit->ask();
      for (const Point& point : points) {
        WantedEvaluation evaluation{.id = fmt::format("{}{}.{}", is_modulus ? 'E' : 'T', batch_number, wanted.size()),
                                    .parameters = settings.start,
                                    .modulus = is_modulus,
                                    .toughness = !is_modulus,
                                    .items = tester.items};
        if (is_modulus) evaluation.parameters.modulus = modulus_at(point);
        if (!is_modulus) evaluation.parameters.toughness = toughness_at(point);
        if (!is_modulus) evaluation.first_specimen = tester::kFirstCalibrationSpecimen + toughness_evaluations++;
        wanted.push_back(std::move(evaluation));
      }
    };
    add(modulus, true);
    modulus_wanted = wanted.size();
    add(toughness, false);
    told.assign(wanted.size(), std::nullopt);
  }

  /// How much specimens scatter at the start, of every design whose replicates do: hardly a matter of eta, while T
  /// itself falls with strength_cv, so that this comes first. Whether it was asked for.
  bool ask_for_scatter() {
    if (!settings.strength_variation || settings.toughness_budget == 0 || settings.start.strength_cv <= 0.0)
      return false;
    std::vector<std::size_t> replicated;
    std::ranges::copy_if(toughness.items, std::back_inserter(replicated),
                         [&](std::size_t item) { return measured[item].toughness_count > 1; });
    if (replicated.empty()) return false;
    for (const double strength_cv : {kSmallVariation, kLargeVariation}) {
      wanted.push_back({.id = fmt::format("scatter.{}", wanted.size()),
                        .parameters = settings.start,
                        .toughness = true,
                        .items = replicated,
                        .first_specimen = tester::kFirstScatterSpecimen,
                        .specimens = kScatterSpecimens});
      wanted.back().parameters.strength_cv = strength_cv;
    }
    told.assign(wanted.size(), std::nullopt);
    fitting_scatter = true;
    return true;
  }

  void take_scatter() {
    fitting_scatter = false;
    std::array<std::vector<Prediction>, 2> simulated;
    for (std::size_t which = 0; which < simulated.size(); ++which) {
      simulated[which].resize(measured.size());
      for (std::size_t k = 0; k < wanted[which].items.size(); ++k)
        simulated[which][wanted[which].items[k]] = (*told[which])[k];
    }
    const std::vector<DesignScatter> designs = design_scatter(measured, simulated[0], simulated[1]);
    if (designs.empty()) return;
    result.strength_variation = fit_strength_variation(designs, expected_measuring_sd(measured));
    settings.start.strength_cv = result.parameters.strength_cv = result.strength_variation->strength_cv;
  }

  void take(std::size_t index, const std::vector<Prediction>& predictions) {
    assert(index < wanted.size() && predictions.size() == wanted[index].items.size());
    if (told[index]) return;  // a repeat
    std::vector<Prediction> shown;
    for (std::size_t j = 0; j < predictions.size(); ++j)
      shown.push_back(observed(predictions[j], settings.start.extensions, measured[wanted[index].items[j]]));
    told[index] = std::move(shown);
    result.simulations += predictions.size();
    if (std::any_of(told.begin(), told.end(), [](const auto& each) { return !each; })) return;
    fitting_scatter ? take_scatter() : hand_over();
    ask();
    if (wanted.empty()) conclude();
  }

  void hand_over() {
    std::vector<std::vector<Prediction>> of_modulus, of_toughness;
    for (std::size_t k = 0; k < told.size(); ++k) {
      (k < modulus_wanted ? of_modulus : of_toughness).push_back(std::move(*told[k]));
    }
    if (!of_modulus.empty()) modulus.fit->tell(std::move(of_modulus));
    if (!of_toughness.empty()) toughness.fit->tell(std::move(of_toughness));
  }

  /// Adds a row per parameter to the result.
  template <class Vector>
  void add_estimates(std::string_view table, std::span<const std::string_view> names,
                     std::span<const ParameterRange> ranges, const Vector& vector, const ParameterFit* fit,
                     const Vector& log_sd) {
    std::vector<CoordinateInterval> intervals;
    if (fit != nullptr) intervals = fit->intervals();
    intervals.resize(vector.size(), {0.0, 1.0, kUnknownDeviation});  // theta's gamma is not searched
    for (std::size_t j = 0; j < vector.size(); ++j) {
      intervals[j] = widened(intervals[j], ranges[j], vector[j], log_sd[j]);
      ParameterEstimate estimate{fmt::format("{}.{}", table, names[j]), vector[j], ranges[j].minimum, ranges[j].maximum,
                                 intervals[j].deviation < 0.5 * kUnknownDeviation};
      if (estimate.determined) {
        estimate.low90 = from_unit(ranges[j], intervals[j].low90);
        estimate.high90 = from_unit(ranges[j], intervals[j].high90);
      }
      result.estimates.push_back(std::move(estimate));
    }
  }

  /// The course of a tester's fit; what it first and at last predicts of each design goes to `before` and the result.
  void take_over(const TesterFit& tester, std::optional<double> Prediction::*value, FitCourse course,
                 std::vector<Prediction>& before) {
    for (const FitTrial& trial : tester.fit->trials()) course.all.push_back(trial.objective);
    const FitTrial &first = tester.fit->first(), &best = tester.fit->best();
    course.before = first.objective, course.after = best.objective;
    for (std::size_t k = 0; k < tester.items.size(); ++k) {
      before[tester.items[k]].*value = first.predictions[k].*value;
      result.predictions[tester.items[k]].*value = best.predictions[k].*value;
    }
  }

  void conclude() {
    std::vector<Prediction> before(measured.size());
    if (modulus.fit != nullptr) {
      result.parameters.modulus = modulus_at(modulus.fit->best().point);
      take_over(modulus, &Prediction::modulus_pa,
                {result.modulus_objectives, result.modulus_objective_before, result.modulus_objective_after}, before);
    }
    if (toughness.fit != nullptr) {
      result.parameters.toughness = toughness_at(toughness.fit->best().point);
      take_over(toughness, &Prediction::toughness_pa,
                {result.toughness_objectives, result.toughness_objective_before, result.toughness_objective_after},
                before);
      for (std::size_t k = 0; k < toughness.items.size(); ++k)
        result.predictions[toughness.items[k]].curve = toughness.fit->best().predictions[k].curve;
    }
    add_estimates("modulus", material::modulus_parameter_names(), modulus_ranges(),
                  to_vector(result.parameters.modulus), modulus.fit.get(), material::ModulusVector{});
    add_estimates("toughness", material::toughness_parameter_names(), toughness_ranges(),
                  to_vector(result.parameters.toughness), toughness.fit.get(), settings.floor.log_eta_sd);
    if (const auto& fitted = result.strength_variation)
      result.estimates.push_back(
          {"toughness.strength_cv", fitted->strength_cv, fitted->low90, fitted->high90, fitted->determined()});
    result.before = prediction_errors(measured, before);
    result.after = prediction_errors(measured, result.predictions);
    add_likelihood();
    add_ensemble();
  }

  void add_likelihood() {
    const Likelihood modulus_likelihood =
        modulus_likelihood_of(measured, result.predictions, settings.floor, modulus.freedom_taken());
    const Likelihood toughness_likelihood =
        toughness_likelihood_of(measured, result.predictions, settings.floor, toughness.freedom_taken());
    result.modulus_deviance = modulus_likelihood.deviance;
    result.modulus_fit = modulus_likelihood.fit;
    result.toughness_deviance = toughness_likelihood.deviance;
    result.toughness_fit = toughness_likelihood.fit;
    if (toughness.fit != nullptr && settings.searches > 1) result.search_objectives = toughness.fit->best_objectives();
  }

  void add_ensemble() {
    if (toughness.fit == nullptr) return;
    for (const Point& point : toughness.fit->plausible(settings.ensemble_size)) {
      result.ensemble.push_back(result.parameters);
      result.ensemble.back().toughness = toughness_at(point);
    }
  }

  double progress() const {
    // A toughness simulation is by far the dearer one.
    if (toughness.fit == nullptr) return modulus.progress();
    return 0.05 * modulus.progress() + 0.95 * toughness.progress();
  }
};

Calibration::Calibration(std::vector<measurement::Replicates> measured, const CalibrationSettings& settings)
    : state_(std::make_unique<State>()) {
  state_->measured = std::move(measured);
  state_->settings = settings;
  state_->begin();
}

Calibration::~Calibration() = default;
Calibration::Calibration(Calibration&&) noexcept = default;
Calibration& Calibration::operator=(Calibration&&) noexcept = default;

const std::vector<WantedEvaluation>& Calibration::wanted() const { return state_->wanted; }

void Calibration::tell(std::size_t index, const std::vector<Prediction>& predictions) {
  state_->take(index, predictions);
}

double Calibration::progress() const { return finished() ? 1.0 : state_->progress(); }

const Calibrated& Calibration::result() const { return state_->result; }

}  // namespace nacre::sysid
