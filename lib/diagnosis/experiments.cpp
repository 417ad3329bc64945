#include "diagnosis/experiments.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "pattern/coupons.hpp"

namespace nacre::diagnosis {
namespace {

/// Specimens that could be made, as groups without a measurement.
std::vector<Observation> possible_specimens(const Observations& observations) {
  std::set<std::string> taken;
  const auto name_of = [](const pattern::Design& design, double orientation) { return design.name() + (orientation == 90.0 ? "/90" : "/0"); };
  for (const Observation& g : observations.groups) taken.insert(name_of(g.design, g.conditions.orientation_deg));
  std::vector<Observation> possible;
  const auto offer = [&](const pattern::Design& design, double orientation) {
    if (!taken.insert(name_of(design, orientation)).second) return;
    Observation specimen;
    specimen.design = design;
    specimen.conditions.orientation_deg = orientation;
    possible.push_back(specimen);
  };
  for (const Observation& g : observations.groups) {
    offer(g.design, g.conditions.orientation_deg == 0.0 ? 90.0 : 0.0);
  }
  for (const int period : {1, 2, 5}) {
    offer(pattern::checkerboard(period), 0.0);
    offer(pattern::laminate(pattern::LayerDirection::along_x, period, period), 0.0);
    offer(pattern::laminate(pattern::LayerDirection::along_y, period, period), 0.0);
  }
  return possible;
}

/// Which two models a specimen separates best, and by how much.
struct Separation {
  double score = 0.0;
  std::size_t first = 0, second = 0;
};

Separation best_separation(const Eigen::RowVectorXd& predicted, double variance) {
  Separation best;
  for (Eigen::Index a = 0; a < predicted.size(); ++a) {
    for (Eigen::Index b = a + 1; b < predicted.size(); ++b) {
      const double score = std::pow(predicted[a] - predicted[b], 2) / variance;
      if (score > best.score) best = {score, static_cast<std::size_t>(a), static_cast<std::size_t>(b)};
    }
  }
  return best;
}

std::string model_name(const Fit& fit) {
  if (fit.effects.empty()) return "the base model";
  return fit.effects.size() == 1 ? fit.effects[0] : fit.effects[0] + " with " + fit.effects[1];
}

}  // namespace

std::vector<NextExperiment> next_experiments(const std::vector<Fit>& models, const Observations& observations, tester::Fidelity fidelity,
                                             int count, int replicates) {
  if (models.size() < 2) return {};
  const std::vector<Observation> specimens = possible_specimens(observations);
  std::vector<material::ParameterSet> sets;
  for (const Fit& model : models) sets.push_back(model.parameters);
  const Eigen::MatrixXd predicted = ModulusModel(specimens, fidelity).predict(sets);
  const double variance = observations.replicate_sd * observations.replicate_sd / replicates + observations.numerics_sd * observations.numerics_sd;
  struct Ranked {
    Separation separation;
    std::size_t specimen = 0;
  };
  std::vector<Ranked> ranked;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    ranked.push_back({best_separation(predicted.row(static_cast<Eigen::Index>(i)), variance), i});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.separation.score > b.separation.score; });
  std::vector<NextExperiment> experiments;
  for (const Ranked& r : ranked) {
    if (static_cast<int>(experiments.size()) == count || r.separation.score < 1.0) break;
    experiments.push_back({specimens[r.specimen].design, tester::TestKind::modulus, specimens[r.specimen].conditions, replicates,
                           fmt::format("separates {} from {} by {:.1f} standard errors", model_name(models[r.separation.first]),
                                       model_name(models[r.separation.second]), std::sqrt(r.separation.score))});
  }
  return experiments;
}

}  // namespace nacre::diagnosis
