#include "diagnosis/pairs.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "diagnosis/global_fit.hpp"
#include "diagnosis/misfit.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {
namespace {

/// Pairs that contain a single effect, where the second effect earns its place on top of the first.
std::vector<FittedModel> significant_pairs(const Evidence& evidence, const FittedModel& single) {
  std::vector<std::string> others;
  for (const std::string& effect : evidence.effects) {
    // Two forms of one effect are no two effects.
    if (material::find_effect(effect)->cause() != material::find_effect(single.effects.front())->cause())
      others.push_back(effect);
  }
  const Anchor anchor{
      single, signatures_on(evidence.model, single, others, evidence.settings.procedure.fit.sizes), {}, {}};
  const std::vector<double> largest =
      over_draws(bootstrap_anchor(anchor, evidence.observations, evidence.settings.procedure.names.imitated,
                                  evidence.settings.bootstraps, evidence.settings.seed + 3),
                 &DrawStatistics::largest_drop);
  const FitRules& rules = evidence.settings.procedure.fit;
  std::vector<FittedModel> pairs;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const std::vector<Start> starts =
        starts_on(evidence.model, evidence.observations, rules, single, anchor.signatures[k]);
    FittedModel pair =
        global_fit(evidence.model, evidence.observations, rules, {single.effects.front(), others[k]}, starts);
    if (exceedance(largest, single.chi2 - pair.chi2) <= evidence.settings.procedure.levels.name)
      pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// An effect refitted by itself from where each of these pairs with it ended: a pair may have found an optimum that its
/// first effect missed alone, and its gain must not be better optimisation.
FittedModel refitted_alone(const Evidence& evidence, const FittedModel& single, const std::vector<FittedModel>& pairs) {
  std::vector<Start> starts;
  for (const FittedModel& pair : pairs) starts.push_back(at_relative(pair, single.u.size()));
  return global_fit(evidence.model, evidence.observations, evidence.settings.procedure.fit, single.effects, starts,
                    single);
}

std::vector<FittedModel> pairs_on(const Evidence& evidence, const FittedModel& single,
                                  std::vector<PairsOnSingle>& built) {
  const auto known = std::ranges::find_if(built, [&](const PairsOnSingle& earlier) {
    return earlier.single.effects == single.effects && earlier.single.u == single.u;
  });
  if (known != built.end()) return known->pairs;
  built.push_back({single, significant_pairs(evidence, single)});
  return built.back().pairs;
}

}  // namespace

std::vector<std::size_t> pair_anchors(const Evidence& evidence) {
  const NameRules& rules = evidence.settings.procedure.names;
  std::vector<std::size_t> anchors(evidence.singles.size());
  std::iota(anchors.begin(), anchors.end(), std::size_t{0});
  std::ranges::stable_sort(anchors, {}, [&](std::size_t k) { return evidence.singles[k].chi2; });
  const auto drop = [&](std::size_t k) { return evidence.base.fit.chi2 - evidence.singles[k].chi2; };
  std::erase_if(anchors,
                [&, best = drop(anchors.front())](std::size_t k) { return drop(k) < rules.pair_share * best; });
  anchors.resize(std::min(anchors.size(), static_cast<std::size_t>(rules.pair_anchors)));
  return anchors;
}

Pairs pairs_on_best(const Evidence& evidence, std::vector<PairsOnSingle> built_before) {
  Pairs found{.pairs = {}, .singles = evidence.singles, .built = std::move(built_before)};
  std::set<std::set<std::string>> known;
  for (const std::size_t anchor : pair_anchors(evidence)) {
    FittedModel& single = found.singles[anchor];
    const double before = single.chi2;
    std::vector<FittedModel> built = pairs_on(evidence, single, found.built);
    single = refitted_alone(evidence, single, built);
    found.improved = single.chi2 < before - evidence.settings.procedure.fit.better;
    if (found.improved) return found;
    for (FittedModel& pair : built)
      if (known.insert({pair.effects.begin(), pair.effects.end()}).second) found.pairs.push_back(std::move(pair));
  }
  return found;
}

}  // namespace nacre::diagnosis
