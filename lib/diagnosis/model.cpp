#include "diagnosis/model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.hpp"

namespace nacre::diagnosis {
namespace {

struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

/// Range of a base parameter widened three-fold about its middle (docs/METHODS.md): moduli in log scale, ratios kept physical.
Bounds widened(int i) {
  const material::ParameterRange& range = material::modulus_ranges(material::FitTarget::microstructures)[static_cast<std::size_t>(i)];
  if (i < 3) {
    const double half = 1.5 * std::log(range.maximum / range.minimum);
    const double middle = 0.5 * std::log(range.maximum * range.minimum);
    return {middle - half, middle + half};
  }
  const double half = 1.5 * (range.maximum - range.minimum);
  const double middle = 0.5 * (range.maximum + range.minimum);
  return {std::max(0.02, middle - half), std::min(0.495, middle + half)};
}

}  // namespace

CoordinateMap::CoordinateMap(std::span<const std::string> effects) : effects_(effects.begin(), effects.end()) {
  for (const std::string& name : effects_) {
    const material::Effect* effect = material::find_effect(name);
    assert(effect != nullptr);
    for (int p = 0; p < static_cast<int>(effect->parameters.size()); ++p) extension_.push_back({effect, p});
  }
}

double CoordinateMap::scale(int extension_index) const {
  const EffectCoordinate& c = extension_[static_cast<std::size_t>(extension_index)];
  const material::EffectParameter& p = c.effect->parameters[static_cast<std::size_t>(c.parameter)];
  return std::max(std::abs(p.minimum), std::abs(p.maximum));
}

double CoordinateMap::lower(int i) const {
  if (i < kBaseCount) return 0.0;
  const EffectCoordinate& c = extension_[static_cast<std::size_t>(i - kBaseCount)];
  return c.effect->parameters[static_cast<std::size_t>(c.parameter)].minimum / scale(i - kBaseCount);
}

double CoordinateMap::upper(int i) const {
  if (i < kBaseCount) return 1.0;
  const EffectCoordinate& c = extension_[static_cast<std::size_t>(i - kBaseCount)];
  return c.effect->parameters[static_cast<std::size_t>(c.parameter)].maximum / scale(i - kBaseCount);
}

double CoordinateMap::value(int i, double u) const {
  if (i >= kBaseCount) return u * scale(i - kBaseCount);
  const Bounds b = widened(i);
  const double x = b.low + u * (b.high - b.low);
  return i < 3 ? std::exp(x) : x;
}

material::ParameterSet CoordinateMap::parameters(const Eigen::VectorXd& u) const {
  material::ParameterSet set = material::default_parameters();
  material::ModulusVector theta = to_vector(set.modulus);
  for (int i = 0; i < kBaseCount; ++i) theta[static_cast<std::size_t>(i)] = value(i, u[i]);
  set.modulus = material::modulus_from_vector(theta);
  for (std::size_t k = 0; k < extension_.size(); ++k) {
    set.extensions[std::string(extension_[k].effect->name)].push_back(value(kBaseCount + static_cast<int>(k), u[kBaseCount + static_cast<int>(k)]));
  }
  return set;
}

Eigen::VectorXd CoordinateMap::coordinates(const material::ModulusParameters& parameters) const {
  const material::ModulusVector theta = to_vector(parameters);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(size());
  for (int i = 0; i < kBaseCount; ++i) {
    const Bounds b = widened(i);
    const double x = i < 3 ? std::log(theta[static_cast<std::size_t>(i)]) : theta[static_cast<std::size_t>(i)];
    u[i] = std::clamp((x - b.low) / (b.high - b.low), 0.02, 0.98);
  }
  return u;
}

double ModulusModel::log_modulus(const Observation& group, const material::ParameterSet& set) const {
  const tester::Simulation simulation{group.design, set, group.conditions, fidelity_};
  const std::string key = tester::simulation_key(simulation, tester::TestKind::modulus);
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(key); found != known_.end()) {
      return std::log(measurement::observe_modulus(found->second, set.extensions));
    }
  }
  const auto result = tester::test_modulus(simulation);
  if (!result) throw std::runtime_error(fmt::format("modulus of {}: {}", group.design.name(), result.error().message));
  {
    const std::lock_guard lock(mutex_);
    known_.emplace(key, result->modulus_pa);
  }
  return std::log(measurement::observe_modulus(result->modulus_pa, set.extensions));
}

Eigen::VectorXd ModulusModel::mesh_change(const material::ParameterSet& set) const {
  Eigen::VectorXd finer(static_cast<Eigen::Index>(groups_.size()));
  parallel_for(static_cast<int>(groups_.size()), [&](int i) {
    const Observation& group = groups_[static_cast<std::size_t>(i)];
    const auto result = tester::test_modulus({group.design, set, group.conditions, fidelity_}, {.refinement = 2});
    if (!result) throw std::runtime_error(fmt::format("modulus of {} at h/2: {}", group.design.name(), result.error().message));
    finer[i] = std::log(measurement::observe_modulus(result->modulus_pa, set.extensions));
  });
  return finer - predict(set);
}

Eigen::MatrixXd ModulusModel::predict(std::span<const material::ParameterSet> sets) const {
  const int count = static_cast<int>(groups_.size());
  Eigen::MatrixXd y(count, static_cast<int>(sets.size()));
  parallel_for(count * static_cast<int>(sets.size()), [&](int job) {
    const int set = job / count, group = job % count;
    y(group, set) = log_modulus(groups_[static_cast<std::size_t>(group)], sets[static_cast<std::size_t>(set)]);
  });
  return y;
}

}  // namespace nacre::diagnosis
