#include "sysid/base_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>

#include "sysid/base_fit.hpp"
#include "sysid/eta.hpp"
#include "sysid/objective.hpp"

namespace nacre::sysid {
namespace {

using material::ParameterRange;
using material::ParameterSet;

constexpr double kModulusTolerance = 1e-6;
constexpr int kMaterials = 3;  // 0 soft, 1 rigid, 2 interface, as in the vectors of parameters
constexpr std::array<double, kMaterials> kRigidFractions = {0.0, 1.0, 0.5};

template <class Value>
std::size_t at(Value place, int material) {
  return static_cast<int>(place) + material;
}

double middle_of(const ParameterRange& range) { return 0.5 * (range.minimum + range.maximum); }

/// One candidate of one material; `modulus_pa` of theta or `trial` of eta.
struct CandidateConstant {
  int material = 0;
  double modulus_pa = 0.0;
  MaterialTrial trial;
};

}  // namespace

struct BaseCalibration::State {
  struct MaterialState {
    /// Indices into the measured designs: those of one material are two where its tests ran under different conditions.
    std::optional<std::size_t> modulus_item, toughness_item;
    std::optional<RatioSearch> modulus;
    std::optional<double> modulus_prediction_pa;  ///< at modulus->best()
    int modulus_evaluations = 0;
    std::vector<MaterialFit> toughness;  ///< one per damping tried; empty when not measured
  };
  /// The start is evaluated; then every material is fitted at one damping after another until one suits them all.
  enum class Phase { start, dampings, done };

  std::vector<measurement::Replicates> measured;
  CalibrationSettings settings;
  std::array<MaterialState, kMaterials> materials;
  Phase phase = Phase::start;
  std::vector<double> dampings_per_s;  ///< to be tried, in order
  std::size_t damping = 0;             ///< the one in use
  std::vector<WantedEvaluation> wanted;
  std::vector<std::vector<CandidateConstant>> candidates;  ///< of each wanted evaluation, one per item
  std::vector<std::optional<std::vector<Prediction>>> told;
  std::vector<Prediction> before, after;
  int batch_number = 0;
  Calibrated result;

  std::span<const ParameterRange> theta_ranges() const { return settings.ranges.modulus(settings.target); }
  std::span<const ParameterRange> eta_ranges() const { return settings.ranges.toughness(settings.target); }

  void begin() {
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const pattern::Mixture* mixture = measured[i].design.mixture();
      if (mixture == nullptr) continue;
      for (int m = 0; m < kMaterials; ++m) {
        if (mixture->rigid_fraction == kRigidFractions[at(0, m)]) begin_material(m, i);
      }
    }
    before.resize(measured.size());
    after.resize(measured.size());
    result.parameters = centred_start();
    list_dampings();
    begin_toughness();
    ask();
  }

  /// Of a test under several conditions the first ones count.
  void begin_material(int m, std::size_t item) {
    MaterialState& material = materials[at(0, m)];
    const measurement::Replicates& base = measured[item];
    if (base.toughness_count > 0 && !material.toughness_item) material.toughness_item = item;
    if (base.modulus_count == 0 || material.modulus_item) return;
    material.modulus_item = item;
    if (settings.modulus_budget == 0) return;
    const ParameterRange& range = theta_ranges()[at(kE0, m)];
    material.modulus.emplace(RatioSearch::Settings{
        .lower = range.minimum, .upper = range.maximum, .first = base.modulus_pa, .tolerance = kModulusTolerance});
  }

  /// The start, the bounds of the range above and below it, and a value between: a specimen that rings is judged broken
  /// too early, and the damping that calms it depends on the material.
  void list_dampings() {
    const ParameterRange& range = eta_ranges()[at(kGamma, 0)];
    const double start = to_vector(centred_start().toughness)[at(kGamma, 0)];
    for (const double gamma : {start, range.maximum, std::sqrt(start * range.maximum), range.minimum}) {
      if (std::find(dampings_per_s.begin(), dampings_per_s.end(), gamma) == dampings_per_s.end())
        dampings_per_s.push_back(gamma);
    }
  }

  void begin_toughness() {
    const material::ToughnessVector eta = to_vector(centred_start().toughness);
    for (int m = 0; m < kMaterials; ++m) {
      MaterialState& material = materials[at(0, m)];
      if (!material.toughness_item || settings.toughness_budget == 0) continue;
      const measurement::Replicates& base = measured[*material.toughness_item];
      const MaterialRanges ranges = {eta_ranges()[at(kE0, m)], eta_ranges()[at(kW0, m)], eta_ranges()[at(kGamma, 0)]};
      const double e_pa = material.modulus_item ? measured[*material.modulus_item].modulus_pa : eta[at(kE0, m)];
      const double w = material.toughness.empty() ? eta[at(kW0, m)] : material.toughness.back().best().w_j_per_m3;
      material.toughness.emplace_back(base, ranges, MaterialTrial{e_pa, w, dampings_per_s[damping]},
                                      std::max(1, settings.toughness_budget - used_by(material)));
    }
  }

  /// The start within the ranges, Poisson's ratios in the middle of theirs: nothing measured here tells them. What has
  /// no budget stays as it is.
  ParameterSet centred_start() const {
    material::ModulusVector theta = to_vector(settings.start.modulus);
    material::ToughnessVector eta = to_vector(settings.start.toughness);
    for (std::size_t j = 0; j < theta.size(); ++j) theta[j] = theta_ranges()[j].clamped(theta[j]);
    for (std::size_t j = 0; j < eta.size(); ++j) eta[j] = eta_ranges()[j].clamped(eta[j]);
    for (int m = 0; m < kMaterials; ++m) {
      theta[at(kNu0, m)] = middle_of(theta_ranges()[at(kNu0, m)]);
      eta[at(kNu0, m)] = middle_of(eta_ranges()[at(kNu0, m)]);
    }
    ParameterSet centred = settings.start;
    if (settings.modulus_budget > 0) centred.modulus = material::modulus_from_vector(theta);
    if (settings.toughness_budget > 0) centred.toughness = material::toughness_from_vector(eta);
    return centred;
  }

  void ask() {
    wanted.clear();
    candidates.clear();
    ++batch_number;
    if (phase == Phase::start) want_start();
    while (phase == Phase::dampings) {
      want_candidates();
      if (!wanted.empty() || !next_damping()) break;
    }
    for (std::size_t k = 0; k < wanted.size(); ++k) wanted[k].id = fmt::format("B{}.{}", batch_number, k);
    told.assign(wanted.size(), std::nullopt);
    if (!wanted.empty()) return;
    phase = Phase::done;
    settle();
    conclude();
  }

  /// The worst toughness error of the materials at one of the dampings tried.
  double worst_error(std::size_t index) const {
    double worst = 0.0;
    for (const MaterialState& material : materials) {
      if (!material.toughness.empty()) worst = std::max(worst, material.toughness[index].error());
    }
    return worst;
  }

  /// Toughness simulations of one material so far: its budget counts over all dampings.
  static int used_by(const MaterialState& material) {
    int used = 0;
    for (const MaterialFit& fit : material.toughness) used += fit.evaluations();
    return used;
  }

  /// Some material may not be simulated any more.
  bool spent() const {
    return std::ranges::any_of(
        materials, [&](const MaterialState& material) { return used_by(material) >= settings.toughness_budget; });
  }

  /// Called when the fits at one damping have ended; false when there is nothing left to try.
  bool next_damping() {
    if (worst_error(damping) <= kToughnessAim) return false;
    if (damping + 1 < dampings_per_s.size() && !spent()) {
      ++damping;
      begin_toughness();
      return true;
    }
    damping = fairest_damping();
    return false;
  }

  /// The damping at which the worst material misses least. The thesis keeps the median of three separate estimates,
  /// which leaves the two other materials with thresholds that were fitted at another damping.
  std::size_t fairest_damping() const {
    std::size_t fairest = 0;
    for (std::size_t k = 1; k <= damping; ++k) {  // later ones were not tried
      if (worst_error(k) < worst_error(fairest)) fairest = k;
    }
    return fairest;
  }

  /// Base materials that this test was done on, whether or not there is a budget to fit them.
  std::vector<std::size_t> items_with(bool modulus) const {
    std::vector<std::size_t> items;
    for (const MaterialState& material : materials) {
      if (const auto item = modulus ? material.modulus_item : material.toughness_item) items.push_back(*item);
    }
    return items;
  }

  void want_start() {
    for (const bool modulus : {true, false}) {
      const std::vector<std::size_t> items = items_with(modulus);
      if (items.empty()) continue;
      wanted.push_back({"", settings.start, modulus, !modulus, items});
      candidates.emplace_back(items.size());
    }
  }

  void want_candidates() {
    const ParameterSet base = centred_start();
    for (int m = 0; m < kMaterials; ++m) {
      MaterialState& material = materials[at(0, m)];
      if (material.modulus && material.modulus_evaluations < settings.modulus_budget) {
        for (const double modulus_pa : material.modulus->ask(settings.batch)) want(base, true, {m, modulus_pa, {}});
      }
      if (material.toughness.empty()) continue;
      for (const MaterialTrial& trial : material.toughness[damping].ask(settings.batch))
        want(base, false, {m, 0.0, trial});
    }
  }

  /// Candidates of different materials share an evaluation, since none depends on the others' parameters; all but the
  /// damping.
  void want(const ParameterSet& base, bool modulus, const CandidateConstant& candidate) {
    std::size_t k = 0;
    for (; k < wanted.size(); ++k) {
      if (wanted[k].modulus != modulus) continue;
      const auto& others = candidates[k];
      const bool same_material = std::any_of(others.begin(), others.end(), [&](const CandidateConstant& other) {
        return other.material == candidate.material;
      });
      if (!same_material) break;
    }
    if (k == wanted.size()) {
      wanted.push_back({"", base, modulus, !modulus, {}});
      candidates.emplace_back();
    }
    const MaterialState& material = materials[at(0, candidate.material)];
    wanted[k].items.push_back(modulus ? *material.modulus_item : *material.toughness_item);
    candidates[k].push_back(candidate);
    if (modulus) {
      material::ModulusVector theta = to_vector(wanted[k].parameters.modulus);
      theta[at(kE0, candidate.material)] = candidate.modulus_pa;
      wanted[k].parameters.modulus = material::modulus_from_vector(theta);
    } else {
      material::ToughnessVector eta = to_vector(wanted[k].parameters.toughness);
      eta[at(kE0, candidate.material)] = candidate.trial.e_pa;
      eta[at(kW0, candidate.material)] = candidate.trial.w_j_per_m3;
      eta[at(kGamma, 0)] = candidate.trial.gamma_per_s;
      wanted[k].parameters.toughness = material::toughness_from_vector(eta);
    }
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
    for (std::size_t k = 0; k < wanted.size(); ++k) hand_over(wanted[k], candidates[k], *told[k]);
    if (phase == Phase::start) {
      phase = Phase::dampings;
      after = before;  // what has no budget stays as it is
    }
    ask();
  }

  void hand_over(const WantedEvaluation& evaluation, const std::vector<CandidateConstant>& tried,
                 const std::vector<Prediction>& predictions) {
    for (std::size_t j = 0; j < evaluation.items.size(); ++j) {
      const std::size_t item = evaluation.items[j];
      if (phase == Phase::start) {
        Prediction& kept = before[item];
        if (evaluation.modulus) kept.modulus_pa = predictions[j].modulus_pa;
        if (evaluation.toughness) {
          kept.toughness_pa = predictions[j].toughness_pa;
          kept.curve = predictions[j].curve;
        }
        continue;
      }
      MaterialState& material = materials[at(0, tried[j].material)];
      if (evaluation.modulus) {
        const std::optional<double>& modulus = predictions[j].modulus_pa;
        material.modulus->tell(tried[j].modulus_pa,
                               modulus ? std::optional(*modulus / measured[item].modulus_pa) : std::nullopt);
        ++material.modulus_evaluations;
        const double wanted_pa = measured[item].modulus_pa;
        if (!material.modulus_prediction_pa ||
            relative_error(modulus, wanted_pa) < relative_error(material.modulus_prediction_pa, wanted_pa)) {
          material.modulus_prediction_pa = modulus;
        }
      } else {
        material.toughness[damping].tell(tried[j].trial, predictions[j]);
      }
    }
  }

  /// Puts the best of each material into one set.
  void settle() {
    material::ModulusVector theta = to_vector(result.parameters.modulus);
    material::ToughnessVector eta = to_vector(result.parameters.toughness);
    for (int m = 0; m < kMaterials; ++m) {
      const MaterialState& material = materials[at(0, m)];
      if (material.modulus && material.modulus->best()) {
        theta[at(kE0, m)] = *material.modulus->best();
        after[*material.modulus_item].modulus_pa = material.modulus_prediction_pa;
      }
      if (material.toughness.empty()) continue;
      const MaterialFit& fit = material.toughness[damping];
      eta[at(kE0, m)] = fit.best().e_pa;
      eta[at(kW0, m)] = fit.best().w_j_per_m3;
      eta[at(kGamma, 0)] = dampings_per_s[damping];
      after[*material.toughness_item].toughness_pa = fit.best_prediction().toughness_pa;
      after[*material.toughness_item].curve = fit.best_prediction().curve;
    }
    result.parameters.modulus = material::modulus_from_vector(theta);
    result.parameters.toughness = material::toughness_from_vector(eta);
  }

  /// Each material meets its measured values, whatever their scatter: no intervals are known.
  void add_estimates(std::string_view table, std::span<const std::string_view> names,
                     std::span<const ParameterRange> ranges, std::span<const double> values) {
    for (std::size_t j = 0; j < values.size(); ++j)
      result.estimates.push_back(
          {fmt::format("{}.{}", table, names[j]), values[j], ranges[j].minimum, ranges[j].maximum, false});
  }

  void conclude() {
    add_estimates("modulus", material::modulus_parameter_names(), theta_ranges(), to_vector(result.parameters.modulus));
    add_estimates("toughness", material::toughness_parameter_names(), eta_ranges(),
                  to_vector(result.parameters.toughness));
    const std::vector<double> equal(measured.size(), 1.0);
    result.before = prediction_errors(measured, before);
    result.after = prediction_errors(measured, after);
    result.modulus_objective_before = modulus_objective(measured, equal, before);
    result.modulus_objective_after = modulus_objective(measured, equal, after);
    result.toughness_objective_before = toughness_objective(measured, equal, before);
    result.toughness_objective_after = toughness_objective(measured, equal, after);
    result.predictions = after;
  }

  double progress() const {
    if (phase == Phase::done) return 1.0;
    double sum = 0.0;
    int count = 0;
    for (const MaterialState& material : materials) {
      if (material.toughness.empty()) continue;
      sum += material.toughness[damping].progress();
      ++count;
    }
    // How many dampings will be needed is not known: one is the rule.
    return count == 0 ? 0.0 : (static_cast<double>(damping) + sum / count) / static_cast<double>(damping + 1);
  }
};

bool is_base_material(const pattern::Design& design) {
  return design.mixture() != nullptr && std::ranges::count(kRigidFractions, design.mixture()->rigid_fraction) > 0;
}

BaseCalibration::BaseCalibration(std::vector<measurement::Replicates> base_materials,
                                 const CalibrationSettings& settings)
    : state_(std::make_unique<State>()) {
  state_->measured = std::move(base_materials);
  state_->settings = settings;
  state_->begin();
}

BaseCalibration::~BaseCalibration() = default;
BaseCalibration::BaseCalibration(BaseCalibration&&) noexcept = default;
BaseCalibration& BaseCalibration::operator=(BaseCalibration&&) noexcept = default;

const std::vector<WantedEvaluation>& BaseCalibration::wanted() const { return state_->wanted; }

void BaseCalibration::tell(std::size_t index, const std::vector<Prediction>& predictions) {
  state_->take(index, predictions);
}

double BaseCalibration::progress() const { return state_->progress(); }

const Calibrated& BaseCalibration::result() const { return state_->result; }

}  // namespace nacre::sysid
