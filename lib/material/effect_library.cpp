#include "material/effect_library.hpp"

#include <array>

namespace nacre::material {
namespace {

constexpr std::array kInterfaceAnisotropy = {EffectParameter{
    "(x - y)/(x + y) of the interface's stiffness and strength, x and y being the printer's axes", "1", -0.8, 0.8}};
constexpr std::array kDropletMixing = {
    EffectParameter{"side of the square over which material fractions are averaged", "pixels", 0.0, 4.0}};
constexpr std::array kRigidOverprint = {
    EffectParameter{"distance by which rigid regions grow on every side", "pixels", 0.0, 1.0}};
constexpr std::array kRigidYield = {
    EffectParameter{"yield stress of the rigid phase", "Pa", 0.0, 1e9, Strength::reciprocal, 1e7}};
constexpr std::array kSoftStiffening = {
    EffectParameter{"limit J_m of I_1 - 2 in the soft phase", "1", 0.0, 1e3, Strength::reciprocal, 0.2}};
constexpr std::array kRateDependence = {
    EffectParameter{"stress of an instantaneous stretch over the relaxed stress, less one", "1", 0.0, 2.0},
    EffectParameter{"time in which the overstress relaxes", "s", 0.0, 1e4, Strength::scale, 1e-2}};
constexpr std::array kRatePowerLaw = {
    EffectParameter{"exponent n of the soft phase: its stiffness grows as the strain rate to the power n", "1", 0.0,
                    0.6},
    EffectParameter{"exponent of the interface over that of the soft phase", "1", 0.0, 2.0},
    EffectParameter{"exponent of the rigid phase over that of the soft phase", "1", 0.0, 2.0}};
constexpr std::array kExponents = {
    DerivedNumber{"soft_exponent", "exponent of the soft phase", [](std::span<const double> p) { return p[0]; }},
    DerivedNumber{"interface_exponent", "exponent of the interface",
                  [](std::span<const double> p) { return p[0] * p[1]; }},
    DerivedNumber{"rigid_exponent", "exponent of the rigid phase",
                  [](std::span<const double> p) { return p[0] * p[2]; }}};
constexpr std::array kBlendLaw = {EffectParameter{
    "log of E of a blend halfway between two of the three materials over what the mixture law says", "1", -1.5, 1.5}};
constexpr std::array kRateProny = {
    EffectParameter{"overstress of an instantaneous stretch by the first branch over the relaxed stress", "1", 0.0,
                    4.0},
    EffectParameter{"relaxation time of the first branch", "s", 0.0, 1e4, Strength::scale, 1e-3},
    EffectParameter{"overstress by the second branch", "1", 0.0, 4.0},
    EffectParameter{"relaxation time of the second branch over that of the first", "1", 0.0, 1e5, Strength::scale,
                    3.0}};
constexpr std::array kRateByPhase = {
    EffectParameter{"overstress of an instantaneous stretch of the soft phase over its relaxed stress", "1", 0.0, 4.0},
    EffectParameter{"time in which the overstress relaxes", "s", 0.0, 1e4, Strength::scale, 1e-2},
    EffectParameter{"overstress of the interface over that of the soft phase", "1", 0.0, 2.0},
    EffectParameter{"overstress of the rigid phase over that of the soft phase", "1", 0.0, 2.0}};
constexpr std::array kOverstresses = {
    DerivedNumber{"soft_overstress", "overstress of the soft phase", [](std::span<const double> p) { return p[0]; }},
    DerivedNumber{"interface_overstress", "overstress of the interface",
                  [](std::span<const double> p) { return p[0] * p[2]; }},
    DerivedNumber{"rigid_overstress", "overstress of the rigid phase",
                  [](std::span<const double> p) { return p[0] * p[3]; }},
    DerivedNumber{"relaxation_time", "relaxation time", [](std::span<const double> p) { return p[1]; }, "s"}};
constexpr std::array kTemperatureShift = {
    EffectParameter{"decades of the strain rate that one degree at 23 C is worth", "1/K", 0.0, 0.5},
    EffectParameter{"degrees below 23 C at which the shift has its pole (Williams, Landel, Ferry)", "K", 0.0, 1e4,
                    Strength::scale, 20.0}};
constexpr std::array kOneMachineCompliance = {EffectParameter{
    "strain per nominal stress of another machine's load train, less that of the first", "1/Pa", -2e-9, 2e-9}};
constexpr std::array kOneMachineGain = {
    EffectParameter{"force that another machine records over that of the first, less one", "relative", -0.5, 0.5}};
constexpr std::array kHumidity = {
    EffectParameter{"growth of the logarithm of stiffness by one per cent of relative humidity", "1/%", -0.1, 0.1}};
constexpr std::array kAgeing = {
    EffectParameter{"exponent a: stiffness grows as (1 + age in days) to the power a", "1", -0.5, 0.5}};
constexpr std::array kProgressiveDamage = {
    EffectParameter{"energy spent in softening over the threshold energy", "1", 0.0, 4.0}};
constexpr std::array kTensionOnlyFailure = {
    EffectParameter{"share of the compressive energy that causes no failure", "1", 0.0, 1.0}};
constexpr std::array kStrengthScatter = {
    EffectParameter{"coefficient of variation of the thresholds of elements", "1", 0.0, 0.6}};
constexpr std::array kBluntNotch = {EffectParameter{"radius of the notch root", "share of the width", 0.0, 0.05}};
constexpr std::array kResidualStrain = {
    EffectParameter{"shrinkage of the rigid phase against the soft one", "strain", -0.02, 0.02}};
constexpr std::array kPlaneStrain = {EffectParameter{
    "share of the way from plane stress to plane strain at the standard thickness of 3.2 mm", "1", 0.0, 1.0}};
constexpr std::array kMachineCompliance = {
    EffectParameter{"strain per nominal stress of the load train", "1/Pa", 0.0, 2e-9}};
constexpr std::array kToeSlack = {EffectParameter{"strain recorded before the specimen carries", "strain", 0.0, 0.02}};
constexpr std::array kBatchDrift = {
    EffectParameter{"growth of stiffness and stress from one batch to the next", "relative per batch step", -0.2, 0.2}};
constexpr std::array kLoadCellGain = {EffectParameter{"error of the recorded force", "relative", -0.3, 0.3}};

/// The tests in which an effect acts.
struct ActsOn {
  bool modulus = false, toughness = false, tensile = false;
};
constexpr ActsOn kFracture{.toughness = true}, kLayouts{.modulus = true, .toughness = true},
    kLargeStrain{.toughness = true, .tensile = true}, kEverything{.modulus = true, .toughness = true, .tensile = true},
    kElastic{.modulus = true, .tensile = true};

constexpr Effect effect(std::string_view name, std::string_view family, EffectSide side,
                        std::span<const EffectParameter> parameters, ActsOn acts_on, std::string_view explanation) {
  return {.name = name,
          .family = family,
          .side = side,
          .parameters = parameters,
          .acts_on_modulus = acts_on.modulus,
          .acts_on_toughness = acts_on.toughness,
          .acts_on_tensile = acts_on.tensile,
          .explanation = explanation};
}

/// One of several forms of an effect.
constexpr Effect form(Effect one, std::string_view form_of, std::string_view form,
                      std::span<const DerivedNumber> derived = {}) {
  one.form_of = form_of;
  one.form = form;
  one.derived = derived;
  return one;
}

constexpr Effect by_phase(Effect one) {
  one.is_by_phase = true;
  return one;
}

constexpr Effect law_of(std::string_view condition, Effect one) {
  one.law_of = condition;
  return one;
}

constexpr Effect one_for_each(std::string_view of, Effect one) {
  one.one_for_each = of;
  return one;
}

// In the order in which they are reported.
constexpr std::array kLibrary = {
    effect("interface_anisotropy", "interface", EffectSide::material, kInterfaceAnisotropy, kLayouts,
           "Interfaces between x-neighbours and between y-neighbours differ in stiffness and strength; seen in "
           "rotated twins and between laminates along and across the load."),
    effect("droplet_mixing", "geometry", EffectSide::material, kDropletMixing, kLayouts,
           "Droplets of the two materials mix over some pixels before they cure; depends on run length, not on the "
           "rigid fraction."),
    effect("rigid_overprint", "geometry", EffectSide::material, kRigidOverprint, kLayouts,
           "Rigid regions come out larger than drawn; thin soft features vanish, thick ones hardly change."),
    effect("rigid_yield", "rigid bulk", EffectSide::material, kRigidYield, kLargeStrain,
           "The rigid phase flows beyond a yield stress: a knee in the curve, and a permanent set on unloading."),
    effect("soft_stiffening", "soft bulk", EffectSide::material, kSoftStiffening, kLargeStrain,
           "The chains of the soft phase reach their limit (Gent): the late curve rises, its start is unchanged."),
    form(effect("rate_dependence", "rate", EffectSide::material, kRateDependence, kEverything,
                "All materials are stiffer the faster they are pulled (a Maxwell branch); seen at a second strain "
                "rate."),
         "", "maxwell"),
    by_phase(form(effect("rate_power_law", "rate", EffectSide::material, kRatePowerLaw, kElastic,
                         "Each phase is stiffer by a power of the strain rate, over decades; seen at three rates, in "
                         "several blends."),
                  "rate_dependence", "power_law", kExponents)),
    effect("blend_law", "blends", EffectSide::material, kBlendLaw, kElastic,
           "Homogeneous blends are stiffer or softer than the mixture law between the three materials says."),
    effect("progressive_damage", "failure", EffectSide::material, kProgressiveDamage, kLargeStrain,
           "Material softens before it breaks: a rounder peak and a longer tail."),
    effect("tension_only_failure", "failure", EffectSide::material, kTensionOnlyFailure, kFracture,
           "Compression does not break material: compressed and bent ligaments survive."),
    effect("strength_scatter", "failure", EffectSide::material, kStrengthScatter, kFracture,
           "The strength of voxels scatters (Weibull); replicates scatter more and mean toughness falls."),
    effect("blunt_notch", "geometry", EffectSide::material, kBluntNotch, kFracture,
           "The root of the notch is round instead of sharp; changes toughness alone, and no specimen without notch."),
    effect("residual_strain", "residual", EffectSide::material, kResidualStrain, kFracture,
           "The rigid phase shrank when it cured and is under residual stress before any load, which adds to the "
           "stress of the test."),
    effect("plane_strain", "stress state", EffectSide::material, kPlaneStrain, kEverything,
           "The specimen cannot contract freely through its thickness; seen between two thicknesses."),
    effect("machine_compliance", "measurement", EffectSide::measurement, kMachineCompliance, kEverything,
           "A spring in series with the specimen: the error grows with stiffness, in loading and unloading alike."),
    effect("toe_slack", "measurement", EffectSide::measurement, kToeSlack, kLargeStrain,
           "The grips move before the specimen carries; only the first part of the curve changes."),
    effect("batch_drift", "batch", EffectSide::measurement, kBatchDrift, kEverything,
           "Stiffness and stress drift from print batch to print batch; seen in a reference coupon in each batch."),
    effect("load_cell_gain", "measurement", EffectSide::measurement, kLoadCellGain, kEverything,
           "The load cell reads too high or too low; collinear with other constants of the materials."),
};

constexpr std::array kConditionLaws = {
    law_of("strain rate", form(effect("rate_prony", "rate", EffectSide::material, kRateProny, kElastic,
                                      "All materials are stiffer the faster they are pulled, by two relaxation times "
                                      "(a Prony series)."),
                               "rate_dependence", "prony")),
    law_of("strain rate",
           by_phase(form(effect("rate_by_phase", "rate", EffectSide::material, kRateByPhase, kElastic,
                                "Each phase is stiffer by an overstress of its own the faster it is pulled; all relax "
                                "in one time (a Maxwell branch each)."),
                         "rate_dependence", "maxwell_by_phase", kOverstresses))),
    law_of("machine",
           one_for_each("machine",
                        form(effect("compliance_of_one_machine", "measurement", EffectSide::measurement,
                                    kOneMachineCompliance, kElastic,
                                    "One machine has a spring in series that another has not: the difference between "
                                    "them grows with stiffness."),
                             "machine_compliance", "one_machine"))),
    law_of("machine",
           one_for_each(
               "machine",
               form(effect("gain_of_one_machine", "measurement", EffectSide::measurement, kOneMachineGain, kElastic,
                           "One machine reads higher than another by one factor, whatever the material: load "
                           "cell, cross-section or gauge length."),
                    "load_cell_gain", "one_machine"))),
    law_of("temperature", effect("temperature_shift", "temperature", EffectSide::material, kTemperatureShift, kElastic,
                                 "A warm specimen responds as a cold one that is pulled more slowly (time-temperature "
                                 "superposition).")),
    law_of("humidity",
           one_for_each("material", effect("humidity_dependence", "humidity", EffectSide::material, kHumidity, kElastic,
                                           "Water softens a material by the same share for each per cent of relative "
                                           "humidity."))),
    law_of("age", one_for_each("material", effect("ageing", "age", EffectSide::material, kAgeing, kElastic,
                                                  "A material stiffens by the same share for each decade of its "
                                                  "age."))),
};

}  // namespace

std::span<const Effect> effect_library() { return kLibrary; }

std::span<const Effect> condition_laws() { return kConditionLaws; }

}  // namespace nacre::material
