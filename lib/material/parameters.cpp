#include "material/parameters.hpp"

#include <cassert>
#include <cmath>

#include "material/criterion_strengths.hpp"
#include "material/extensions.hpp"

namespace nacre::material {
namespace {

constexpr std::array<std::string_view, kModulusParameterCount> kModulusNames = {
    "e_tb_pa", "e_vw_pa", "e_if_pa", "nu_tb", "nu_vw", "nu_if", "gamma_per_s"};
constexpr std::array<std::string_view, kToughnessParameterCount> kToughnessNames = {
    "e_tb_pa", "e_vw_pa",       "e_if_pa",       "nu_tb",         "nu_vw",
    "nu_if",   "w_tb_j_per_m3", "w_vw_j_per_m3", "w_if_j_per_m3", "gamma_per_s"};

/// A sentence about the first value with which the testers cannot compute.
template <class Vector>
std::string vector_fault(std::string_view table, std::span<const std::string_view> names, const Vector& vector) {
  for (std::size_t i = 0; i < vector.size(); ++i) {
    const double value = vector[i];
    const bool is_poisson = names[i].starts_with("nu_");
    const bool is_damping = names[i] == "gamma_per_s";
    const bool usable = std::isfinite(value) && (is_poisson   ? value >= 0.0 && value <= 0.5
                                                 : is_damping ? value >= 0.0
                                                              : value > 0.0);
    if (!usable)
      return fmt::format("{}.{} = {} is not usable: expected a finite number {}", table, names[i], value,
                         is_poisson   ? "between 0 and 0.5"
                         : is_damping ? "not below 0"
                                      : "above 0");
  }
  return {};
}

std::string extension_fault(std::string_view name, const std::vector<double>& values) {
  const Effect* effect = find_effect(name);
  if (effect == nullptr) return fmt::format("unknown extension '{}'", name);
  if (!effect->takes(values.size()))
    return fmt::format("extension {} takes {} value(s), not {}", name, effect->parameters.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const EffectParameter& parameter = effect->parameter(i);
    if (!parameter.allows(values[i]))
      return fmt::format("extension {} = {} {}: expected {}", name, values[i], parameter.unit, parameter.range());
  }
  return {};
}

}  // namespace

std::span<const std::string_view> modulus_parameter_names() { return kModulusNames; }
std::span<const std::string_view> toughness_parameter_names() { return kToughnessNames; }

ModulusVector to_vector(const ModulusParameters& p) {
  return {p.e_tb_pa, p.e_vw_pa, p.e_if_pa, p.nu_tb, p.nu_vw, p.nu_if, p.gamma_per_s};
}

ToughnessVector to_vector(const ToughnessParameters& p) {
  return {p.e_tb_pa, p.e_vw_pa,       p.e_if_pa,       p.nu_tb,         p.nu_vw,
          p.nu_if,   p.w_tb_j_per_m3, p.w_vw_j_per_m3, p.w_if_j_per_m3, p.gamma_per_s};
}

ModulusParameters modulus_from_vector(const ModulusVector& v) {
  return {.e_tb_pa = v[0],
          .e_vw_pa = v[1],
          .e_if_pa = v[2],
          .nu_tb = v[3],
          .nu_vw = v[4],
          .nu_if = v[5],
          .gamma_per_s = v[6]};
}

ToughnessParameters toughness_from_vector(const ToughnessVector& v) {
  return {.e_tb_pa = v[0],
          .e_vw_pa = v[1],
          .e_if_pa = v[2],
          .nu_tb = v[3],
          .nu_vw = v[4],
          .nu_if = v[5],
          .w_tb_j_per_m3 = v[6],
          .w_vw_j_per_m3 = v[7],
          .w_if_j_per_m3 = v[8],
          .gamma_per_s = v[9]};
}

ToughnessParameters perturbed(const ToughnessParameters& eta, double relative, RandomStream& random) {
  constexpr double kLargestPoissonRatio = 0.499;
  ToughnessVector vector = to_vector(eta);
  constexpr double kSmallestFactor = 1e-3;  // no modulus below zero, however rare the draw
  for (double& value : vector) value *= std::max(kSmallestFactor, 1.0 + relative * random.normal());
  for (std::size_t i = 3; i < 6; ++i) vector[i] = std::min(vector[i], kLargestPoissonRatio);
  return toughness_from_vector(vector);
}

ParameterSet default_parameters(const FailureCriterion& criterion) {
  // theta: moduli measured on base materials (Table 3.4), the rest the middle of Table A.2. eta: the middle of Table
  // A.2, in log10 where the range is searched so; four digits, as in data/defaults.toml.
  ParameterSet set{.modulus = {.e_tb_pa = 1.0094e6,
                               .e_vw_pa = 2.6613e9,
                               .e_if_pa = 5.642e8,
                               .nu_tb = 0.45,
                               .nu_vw = 0.3,
                               .nu_if = 0.35,
                               .gamma_per_s = 2e5},
                   .toughness = {.e_tb_pa = 1.581e7,
                                 .e_vw_pa = 2.236e8,
                                 .e_if_pa = 7.071e7,
                                 .nu_tb = 0.45,
                                 .nu_vw = 0.3,
                                 .nu_if = 0.35,
                                 .w_tb_j_per_m3 = 2.236e5,
                                 .w_vw_j_per_m3 = 2.236e6,
                                 .w_if_j_per_m3 = 1e7,
                                 .gamma_per_s = 2.828e5},
                   .extensions = {},
                   .criterion = criterion,
                   .strength_cv = base_strength_cv()};
  set.toughness = with_strengths(set.toughness, strength_ratio(criterion));
  return set;
}

ParameterSet thesis_parameters() {
  ParameterSet set = default_parameters(FailureCriterion{.kind = CriterionKind::element});
  set.strength_cv = 0.0;
  return set;
}

std::string parameter_fault(const ParameterSet& parameters) {
  if (std::string fault = vector_fault("modulus", kModulusNames, to_vector(parameters.modulus)); !fault.empty())
    return fault;
  if (std::string fault = vector_fault("toughness", kToughnessNames, to_vector(parameters.toughness)); !fault.empty())
    return fault;
  for (const auto& [name, values] : parameters.extensions)
    if (std::string fault = extension_fault(name, values); !fault.empty()) return fault;
  if (!is_strength_cv(parameters.strength_cv))
    return fmt::format("strength_cv {}, expected 0 or {} to {}", parameters.strength_cv, kSmallestStrengthCv,
                       kLargestStrengthCv);
  return criterion_fault(parameters.criterion);
}

}  // namespace nacre::material
