#include "diagnosis/coordinates.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sysid/eta.hpp"

namespace nacre::diagnosis {

Bounds searched_bounds(const material::ParameterRange& range, bool logarithmic, const ConstantRules& rules) {
  const double half_width = 0.5 * rules.widening;
  if (logarithmic) {
    const double half = half_width * std::log(range.maximum / range.minimum),
                 middle = 0.5 * std::log(range.maximum * range.minimum);
    return {middle - half, middle + half};
  }
  const double half = half_width * (range.maximum - range.minimum), middle = 0.5 * (range.maximum + range.minimum);
  return {std::max(rules.least_ratio, middle - half), std::min(rules.most_ratio, middle + half)};
}

CoordinateMap::CoordinateMap(const Basis& basis, std::span<const std::string> effects)
    : centre_(basis.centre),
      rules_(basis.rules),
      machines_(basis.machines),
      materials_(basis.materials),
      effects_(effects.begin(), effects.end()) {
  centre_.extensions.clear();
  const auto add_moduli = [&](Block block, material::FitTarget target) {
    for (int i = 0; i < 6; ++i) {
      const bool logarithmic = i < 3;
      const Bounds b = searched_bounds(basis.ranges.modulus(target)[i], logarithmic, rules_);
      base_.push_back({block, i, b.low, b.high, logarithmic, rules_.prior_sd});
    }
  };
  if (basis.modulus) add_moduli(Block::modulus, material::FitTarget::microstructures);
  if (basis.toughness) {
    const material::ToughnessVector eta = to_vector(centre_.toughness);
    for (const std::size_t i : sysid::kSearchedEta) {
      const double middle = std::log(eta[i]);
      base_.push_back({Block::toughness, static_cast<int>(i), middle - rules_.eta_reach, middle + rules_.eta_reach,
                       true, rules_.eta_sd / (2.0 * rules_.eta_reach)});
    }
  }
  // Poisson's ratios too: they bend the curves of coupons pulled far.
  if (basis.coupon) add_moduli(Block::coupon, material::FitTarget::base);
  for (const std::string& name : effects_) {
    const material::Effect* effect = material::find_effect(name);
    assert(effect != nullptr);
    for (int p = 0; p < count_of(*effect); ++p) extension_.push_back({effect, p});
  }
}

const material::EffectParameter& CoordinateMap::parameter_of(int i) const {
  const EffectCoordinate& c = extension_[i - base_count()];
  return c.effect->parameter(c.parameter);
}

int CoordinateMap::count_of(const material::Effect& effect) const {
  if (effect.one_for_each == "machine") return std::max(1, machines_ - 1);
  if (effect.one_for_each == "material") return std::max(1, materials_);
  return static_cast<int>(effect.parameters.size());
}

double CoordinateMap::lower(int i) const {
  if (i < base_count()) return 0.0;
  const material::EffectParameter& p = parameter_of(i);
  return p.minimum < 0.0 ? material::strength_of(p, p.minimum) : 0.0;
}

double CoordinateMap::upper(int i) const {
  if (i < base_count()) return 1.0;
  const material::EffectParameter& p = parameter_of(i);
  return p.strength == material::Strength::proportional ? material::strength_of(p, p.maximum) : 1.0;
}

double CoordinateMap::usual(int i) const { return 0.5 * (lower(i) + upper(i)); }

int CoordinateMap::first_coordinate(std::size_t effect) const {
  for (std::size_t k = 0; k < extension_.size(); ++k) {
    if (extension_[k].effect->name == effects_[effect]) return base_count() + static_cast<int>(k);
  }
  return size();
}

double CoordinateMap::plain(const BaseCoordinate& c, double u) const {
  const double x = c.low + u * (c.high - c.low);
  return c.logarithmic ? std::exp(x) : x;
}

double CoordinateMap::value(int i, double u) const {
  return i >= base_count() ? material::value_at_strength(parameter_of(i), u) : plain(base_[i], u);
}

std::vector<ModulusAtBound> CoordinateMap::moduli_at_bounds(const Eigen::VectorXd& u) const {
  constexpr int kModuli = 3;
  std::vector<ModulusAtBound> found;
  for (int i = 0; i < base_count(); ++i) {
    const BaseCoordinate& c = base_[i];
    if (c.block == Block::toughness || c.index >= kModuli || std::min(u[i], 1.0 - u[i]) > rules_.at_bound) continue;
    found.push_back({c.index, value(i, u[i]), c.block == Block::coupon});
  }
  return found;
}

material::ParameterSet CoordinateMap::with_extensions(material::ParameterSet set, const Eigen::VectorXd& u) const {
  for (std::size_t k = 0; k < extension_.size(); ++k) {
    const int i = base_count() + static_cast<int>(k);
    set.extensions[std::string(extension_[k].effect->name)].push_back(value(i, u[i]));
  }
  return set;
}

material::ParameterSet CoordinateMap::parameters(const Eigen::VectorXd& u) const {
  material::ParameterSet set = centre_;
  material::ModulusVector theta = to_vector(set.modulus);
  material::ToughnessVector eta = to_vector(set.toughness);
  for (int i = 0; i < base_count(); ++i) {
    const BaseCoordinate& c = base_[i];
    if (c.block == Block::modulus) theta[c.index] = plain(c, u[i]);
    if (c.block == Block::toughness) eta[c.index] = plain(c, u[i]);
  }
  set.modulus = material::modulus_from_vector(theta);
  set.toughness = material::toughness_from_vector(eta);
  return with_extensions(std::move(set), u);
}

material::ParameterSet CoordinateMap::coupon_parameters(const Eigen::VectorXd& u) const {
  material::ParameterSet set = centre_;
  material::ModulusVector theta = to_vector(centre_.modulus);
  for (int i = 0; i < base_count(); ++i) {
    const BaseCoordinate& c = base_[i];
    if (c.block == Block::coupon) theta[c.index] = plain(c, u[i]);
  }
  set.modulus = material::modulus_from_vector(theta);
  return with_extensions(std::move(set), u);
}

Eigen::VectorXd CoordinateMap::coordinates(const material::ParameterSet& parameters) const {
  const material::ModulusVector theta = to_vector(parameters.modulus);
  const material::ToughnessVector eta = to_vector(parameters.toughness);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(size());
  for (int i = 0; i < base_count(); ++i) {
    const BaseCoordinate& c = base_[i];
    const auto index = static_cast<std::size_t>(c.index);
    const double plain_value = c.block == Block::toughness ? eta[index] : theta[index];
    const double x = c.logarithmic ? std::log(plain_value) : plain_value;
    u[i] = std::clamp((x - c.low) / (c.high - c.low), rules_.start_margin, 1.0 - rules_.start_margin);
  }
  return u;
}

}  // namespace nacre::diagnosis
