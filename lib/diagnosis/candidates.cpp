#include "diagnosis/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/result.hpp"
#include "material/effect_library.hpp"

namespace nacre::diagnosis {
namespace {

bool holds(const std::vector<FittedModel>& fits, const std::string& effect) {
  return std::any_of(fits.begin(), fits.end(), [&](const FittedModel& f) {
    return std::find(f.effects.begin(), f.effects.end(), effect) != f.effects.end();
  });
}

bool is_unaffordable(const DiagnosisSettings& settings, const material::Effect& effect) {
  return settings.fractures && std::ranges::count(settings.fractures->unaffordable, effect.name) > 0;
}

/// The smallest parameter of effect k whose signature is visible in these data, beyond what the base imitates.
std::optional<double> smallest_seen(const Evidence& evidence, std::size_t k, double usual_signal,
                                    const Whitener& whitener) {
  const Procedure& rules = evidence.settings.procedure;
  const auto sizes = Eigen::seqN(0, static_cast<Eigen::Index>(rules.fit.sizes.size()));
  const Signature& signature = evidence.base.signatures[k];
  const Eigen::MatrixXd projected =
      projected_signatures(evidence.base.fit, signature.changes(Eigen::all, sizes), whitener);
  // Further parameters are where the effect shows most: it grows as it does at their usual values.
  const double usual = projected.col(rules.fit.typical).norm(), factor = usual > 1e-9 ? usual_signal / usual : 1.0;
  std::vector<double> signals;
  for (const auto& column : projected.colwise()) signals.push_back(factor * column.norm());
  const auto strength = smallest_strength(rules.fit.sizes, signals, rules.names.visible_signal);
  if (!strength) return std::nullopt;
  return material::value_at_strength(material::find_effect(evidence.effects[k])->parameters.front(), *strength);
}

}  // namespace

std::optional<double> smallest_strength(std::span<const double> strengths, const std::vector<double>& value,
                                        double wanted) {
  constexpr double kNothing = 0.01;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (value[i] < wanted) continue;
    if (i == 0) return strengths[0] * wanted / value[0];
    if (value[i - 1] < kNothing) return strengths[i];
    const double t = std::log(wanted / value[i - 1]) / std::log(value[i] / value[i - 1]);
    return strengths[i - 1] * std::pow(strengths[i] / strengths[i - 1], t);
  }
  return std::nullopt;
}

std::vector<CandidateEffect> candidates_of(const Evidence& evidence, const Decision& decision) {
  const Procedure& rules = evidence.settings.procedure;
  const Whitener whitener(evidence.observations.covariance());
  Eigen::MatrixXd changes(evidence.observations.size(), static_cast<Eigen::Index>(evidence.effects.size()));
  // The change between base and the joint fit; of a typical size where the effect was not noticed.
  std::vector<SignatureSize> typical;
  for (std::size_t k = 0; k < evidence.effects.size(); ++k) {
    const Eigen::VectorXd usual =
        usual_change(evidence.base.signatures[k], rules.fit.typical, evidence.base.fit, whitener);
    typical.push_back(signature_size(evidence.base.fit, usual, whitener));
    const bool noticed = evidence.p_family_wise[k] <= rules.levels.name;
    changes.col(static_cast<Eigen::Index>(k)) =
        noticed ? Eigen::VectorXd(evidence.singles[k].predicted - evidence.base.fit.predicted) : usual;
  }
  const Eigen::MatrixXd projected = projected_signatures(evidence.base.fit, changes, whitener);
  std::vector<CandidateEffect> candidates;
  for (const material::Effect& effect : material::effect_library()) {
    CandidateEffect candidate;
    candidate.name = effect.name;
    const auto found = std::find(evidence.effects.begin(), evidence.effects.end(), effect.name);
    if (found == evidence.effects.end()) {
      if (is_unaffordable(evidence.settings, effect)) candidate.status = CandidateStatus::not_simulated;
      candidates.push_back(candidate);
      continue;
    }
    const auto k = static_cast<std::size_t>(found - evidence.effects.begin());
    const FittedModel& single = evidence.singles[k];
    candidate.statistic = evidence.base.fit.chi2 - single.chi2;
    candidate.p_family_wise = evidence.p_family_wise[k];
    candidate.p_fit = evidence.p_fit[k];
    candidate.absorption = typical[k].absorption();
    candidate.signal_to_noise = projected.col(static_cast<Eigen::Index>(k)).norm();
    candidate.parameter = single.parameters.extensions.at(candidate.name).front();
    for (std::size_t j = 0; j < evidence.effects.size(); ++j) {
      const double lengths = candidate.signal_to_noise * projected.col(static_cast<Eigen::Index>(j)).norm();
      if (j == k || lengths < 1e-9) continue;
      const double cosine = std::min(
          1.0, std::abs(projected.col(static_cast<Eigen::Index>(k)).dot(projected.col(static_cast<Eigen::Index>(j)))) /
                   lengths);
      if (cosine > candidate.rival_cosine)
        candidate.rival_cosine = cosine, candidate.nearest_rival = evidence.effects[j];
    }
    candidate.smallest_seen = smallest_seen(evidence, k, typical[k].projected, whitener);
    candidate.distance = candidate.signal_to_noise * std::sqrt((1.0 - candidate.rival_cosine) / 2.0);
    const bool visible = typical[k].projected >= rules.names.visible_signal;
    const bool noticed = candidate.p_family_wise <= rules.levels.name;
    const bool is_form = decision.finding.reason == Reason::free_form &&
                         effect.cause() == material::find_effect(decision.possible.front().effects.front())->cause();
    candidate.status = is_form || holds(decision.possible, candidate.name) ? CandidateStatus::in_set
                       : visible || noticed                                ? CandidateStatus::excluded
                                                                           : CandidateStatus::invisible;
    candidates.push_back(candidate);
  }
  for (const material::Effect& law : material::condition_laws()) {
    if (!holds(decision.possible, std::string(law.name))) continue;
    CandidateEffect& named = candidates.emplace_back();
    named.name = law.name;
    named.status = CandidateStatus::in_set;
    named.parameter = decision.possible.front().parameters.extensions.at(named.name).front();
  }
  return candidates;
}

CommonGround common_ground(const std::vector<std::vector<std::string>>& possible) {
  if (possible.empty()) return {};
  // An effect that is in every model is certain, whatever else it comes with.
  for (const std::string& name : possible.front()) {
    if (std::all_of(possible.begin(), possible.end(),
                    [&](const auto& model) { return std::find(model.begin(), model.end(), name) != model.end(); }))
      return {CommonGround::Kind::effect, name};
  }
  std::set<std::string_view> families;
  std::set<material::EffectSide> sides;
  for (const auto& model : possible) {
    for (const std::string& name : model) {
      const material::Effect* effect = material::find_effect(name);
      families.insert(effect->family);
      sides.insert(effect->side);
    }
  }
  if (families.size() == 1) return {CommonGround::Kind::family, std::string(*families.begin())};
  if (sides.size() > 1) return {};
  return {*sides.begin() == material::EffectSide::material ? CommonGround::Kind::material_side
                                                           : CommonGround::Kind::measurement_side};
}

}  // namespace nacre::diagnosis
