#pragma once
// Tables of the structs that stand in messages and belong to lower modules, which know nothing of messages; and the
// ranges that messages share.

#include <string>
#include <vector>

#include "base/fields.hpp"
#include "crack/crack_record.hpp"
#include "explore/search.hpp"
#include "game/family_errors.hpp"
#include "material/parameters.hpp"
#include "measurement/limits.hpp"
#include "sysid/errors.hpp"
#include "sysid/evaluated_model.hpp"
#include "sysid/provenance.hpp"
#include "tester/simulation.hpp"

namespace nacre::wire {

/// Moduli, toughnesses and stresses beyond these are no material's; a value out of range is a broken program, not a
/// finding.
inline constexpr Range kPressurePa{0.0, measurement::kStressPa.most};
inline constexpr Range kStrain{0.0, measurement::kStrain.most};
inline constexpr Range kRoundNumber{0.0, 100'000.0};
inline constexpr Range kSquaredResiduals{0.0, 1e30};
/// GPa MPa. Nothing that is measured within its limits exceeds it.
inline constexpr Range kArea{0.0, 1e13};
inline constexpr std::size_t kMaximumCurvePoints = 1500;  ///< of a curve
inline constexpr Name kName{measurement::kLongestName};

/// An extension of the base model.
struct Extension {
  std::string name;
  std::vector<double> values;

  static void fields(auto& field, auto& m) {
    field("name", m.name);
    field.count("n_values", m.values);
    field("values", m.values);
  }
};

/// By name.
std::vector<Extension> listed(const material::Extensions& extensions);
/// The name of an extension that stands there twice; empty: none does.
std::string name_twice(const std::vector<Extension>& extensions);
material::Extensions by_name(const std::vector<Extension>& extensions);

/// Columns of the samples of a gamut.
inline constexpr auto kSampleColumns = [](auto& column, auto& sample) {
  column("pattern", sample.pattern);
  column("modulus_pa", sample.performance.modulus_pa, kPressurePa);
  column("toughness_pa", sample.performance.toughness_pa, kPressurePa);
};

/// An index into `count` things.
inline std::string index_fault(std::string_view name, int index, int count) {
  return index >= 0 && index < count ? "" : fmt::format("{}: {} is no index into {}", name, index, count);
}

}  // namespace nacre::wire

namespace nacre {

template <>
struct FieldsOf<material::ParameterSet> {
  static void fields(auto& field, auto& m) {
    auto modulus = material::to_vector(m.modulus);
    auto toughness = material::to_vector(m.toughness);
    std::vector<wire::Extension> extensions = wire::listed(m.extensions);
    field("modulus", modulus);
    field("toughness", toughness);
    field("strength_cv", m.strength_cv);
    field("criterion", m.criterion.kind);
    field("radius_m", m.criterion.radius_m);
    field("softening", m.criterion.softening);
    field.count("n_extensions", extensions);
    field("extensions", extensions);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(m)>>) {
      if (const std::string twice = wire::name_twice(extensions); !twice.empty())
        return field.refuse(fmt::format("extension {} twice", twice));
      m.modulus = material::modulus_from_vector(modulus);
      m.toughness = material::toughness_from_vector(toughness);
      m.extensions = wire::by_name(extensions);
    }
  }
  static std::string contradiction(const material::ParameterSet& m) { return material::parameter_fault(m); }
};

template <>
struct FieldsOf<sysid::EvaluatedModel> {
  static void fields(auto& field, auto& m) {
    field("parameters", m.parameters);
    field("specimen", m.specimen, kCounted);
  }
};

template <>
struct FieldsOf<tester::TestConditions> {
  /// 0, or 90: printed turned.
  static std::string orientation_fault(double deg) {
    return deg == 0.0 || deg == 90.0 ? "" : fmt::format("{} degrees, expected 0 or 90", deg);
  }
  static void fields(auto& field, auto& m) {
    using measurement::kStrainRatePerS, measurement::kThicknessMm;
    field("orientation_deg", m.orientation_deg, orientation_fault);
    field("strain_rate_per_s", m.strain_rate_per_s, Range{kStrainRatePerS.least, kStrainRatePerS.most});
    field("thickness_mm", m.thickness_mm, Range{kThicknessMm.least, kThicknessMm.most});
  }
};

template <>
struct FieldsOf<sysid::PredictionErrors> {
  static void fields(auto& field, auto& m) {
    constexpr Range kError{0.0, measurement::kStressPa.most / measurement::kToughnessPa.least};
    field("n_modulus", m.modulus_count, kCounted);
    field("modulus_mean", m.modulus_mean, kError);
    field("modulus_max", m.modulus_max, kError);
    field("n_toughness", m.toughness_count, kCounted);
    field("toughness_mean", m.toughness_mean, kError);
    field("toughness_max", m.toughness_max, kError);
    field("toughness_spearman", m.toughness_spearman, Range{-1.000001, 1.000001});
  }
  static bool holds_nothing(const sysid::PredictionErrors& m) { return m.modulus_count == 0 && m.toughness_count == 0; }
};

template <>
struct FieldsOf<sysid::GoodnessOfFit> {
  static void fields(auto& field, auto& m) {
    field("n_designs", m.count, kCounted);
    field("freedom", m.freedom, kCounted);
    field("chi_squared", m.chi_squared, wire::kSquaredResiduals);
    field("chi_squared_replicates", m.chi_squared_replicates, wire::kSquaredResiduals);
    field("p_value", m.p_value, Range{0.0, 1.0});
  }
};

template <>
struct FieldsOf<sysid::ParameterEstimate> {
  static void fields(auto& field, auto& m) {
    field("name", m.name);
    field("value", m.value, wire::kPressurePa);
    field("low90", m.low90, wire::kPressurePa);
    field("high90", m.high90, wire::kPressurePa);
    field("determined", m.determined);
  }
  static std::string contradiction(const sysid::ParameterEstimate& m) {
    return m.high90 >= m.low90 ? "" : fmt::format("high90: {} is below low90, {}", m.high90, m.low90);
  }
};

template <>
struct FieldsOf<game::FamilyDesign> {
  static void fields(auto& field, auto& m) {
    field("pattern", m.pattern);
    field("is_seed", m.is_seed);
    field.or_zero("measured_modulus_pa", m.measured.modulus_pa, wire::kPressurePa);
    field.or_zero("measured_toughness_pa", m.measured.toughness_pa, wire::kPressurePa);
    field.or_zero("global_modulus_pa", m.global_model.modulus_pa, wire::kPressurePa);
    field.or_zero("global_toughness_pa", m.global_model.toughness_pa, wire::kPressurePa);
    field.or_zero("family_modulus_pa", m.family_model.modulus_pa, wire::kPressurePa);
    field.or_zero("family_toughness_pa", m.family_model.toughness_pa, wire::kPressurePa);
  }
};

/// The path of a crack; a longer one is cut off: no specimen has room for one that means anything.
template <>
struct FieldsOf<crack::CrackPath> {
  static void fields(auto& field, auto& m) {
    constexpr Range kShare{0.0, 1.0};
    constexpr double kLargestLength = 100.0;  // m
    field("crosses", m.crosses);
    field("length_m", m.length_m, Range{0.0, kLargestLength});
    field("straight_length_m", m.straight_length_m, Range{1e-9, kLargestLength});
    field("bridged_share", m.bridged_share, kShare);
    field("material_share", m.material, kShare);
    field.first("n_path", m.elements, Range{1, 4000});
    field("path", m.elements);
  }
};

}  // namespace nacre
