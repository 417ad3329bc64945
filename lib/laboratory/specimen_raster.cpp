#include "laboratory/specimen_raster.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "base/random.hpp"
#include "laboratory/laid_unit.hpp"
#include "material/neo_hookean.hpp"
#include "tester/fidelity.hpp"

namespace nacre::laboratory {
namespace {

/// Thresholds are meant at the testers' element size; deletion of smaller elements dissipates W h per area.
constexpr double kThresholdScale = kTesterElementM / kElementM;

/// Which pixels, counted along one axis, lie within reach of a coordinate: one, or the two on both sides of a boundary.
struct Neighbours {
  int first = 0, second = 0;
  bool at_boundary() const { return first != second; }
};

Neighbours neighbours(double coordinate_m) {
  const double along = coordinate_m / kPixelM - kFirstCentre + 0.5;  // pixel k covers [k, k + 1)
  const double nearest_boundary = std::round(along);
  const int own = static_cast<int>(std::floor(along));
  if (std::abs(along - nearest_boundary) >= kInterfaceReach) return {own, own};
  return {static_cast<int>(nearest_boundary) - 1, static_cast<int>(nearest_boundary)};
}

/// Constants of soft, interface and rigid material, in this order.
struct Constants {
  std::array<double, 3> young_pa, poisson, threshold;
};

Constants constants_of(const material::ModulusParameters& p) {
  return {.young_pa = {p.e_tb_pa, p.e_if_pa, p.e_vw_pa},
          .poisson = {p.nu_tb, p.nu_if, p.nu_vw},
          .threshold = {1.0, 1.0, 1.0}};  // the modulus bench breaks nothing
}

Constants constants_of(const material::ToughnessParameters& p) {
  return {.young_pa = {p.e_tb_pa, p.e_if_pa, p.e_vw_pa},
          .poisson = {p.nu_tb, p.nu_if, p.nu_vw},
          .threshold = {p.w_tb_j_per_m3, p.w_if_j_per_m3, p.w_vw_j_per_m3}};
}

/// What is left of stiffness and strength in turned specimens, which are pulled across the printer's passes.
Constants as_laid(Constants constants, const HiddenEffects& effects, const Making& making) {
  if (making.orientation_deg != 90.0) return constants;
  for (double& young_pa : constants.young_pa) young_pa *= 1.0 - effects.bulk_anisotropy;
  for (double& threshold : constants.threshold) threshold *= 1.0 - effects.bulk_anisotropy;
  return constants;
}

/// A value piecewise linear through soft (0), interface (0.5) and rigid (1).
double mixed(const std::array<double, 3>& values, double rigid_fraction) {
  const double position = 2.0 * rigid_fraction;
  return position <= 1.0 ? values[0] + position * (values[1] - values[0])
                         : values[1] + (position - 1.0) * (values[2] - values[1]);
}

double mixed_in_log(const std::array<double, 3>& values, double rigid_fraction) {
  return std::pow(10.0, mixed({std::log10(values[0]), std::log10(values[1]), std::log10(values[2])}, rigid_fraction));
}

/// What the hidden effects at interfaces make of stiffness and strength. Orientation 90 exchanges the printer's axes.
double site_factor(Site site, const HiddenEffects& effects, double orientation_deg) {
  const double along_x = orientation_deg == 90.0 ? -effects.interface_anisotropy : effects.interface_anisotropy;
  switch (site) {
    case Site::interface_x:
      return 1.0 + along_x;
    case Site::interface_y:
      return 1.0 - along_x;
    case Site::corner:
      return 1.0 - effects.corner_debonding;
    case Site::diagonal:
      return (1.0 - effects.corner_debonding) * (1.0 - effects.diagonal_debonding);
    default:
      return 1.0;
  }
}

/// How far a rigid fraction is soft, or rigid, beyond the interface.
double soft_part(double rigid_fraction) { return std::max(0.0, 1.0 - 2.0 * rigid_fraction); }
double rigid_part(double rigid_fraction) { return std::max(0.0, 2.0 * rigid_fraction - 1.0); }

/// Stress through the thickness keeps the sheet from contracting; thicker sheets more.
material::Lame held_in_thickness(material::Lame lame, double poisson, const HiddenEffects& effects,
                                 const Making& making) {
  if (effects.plane_strain == 0.0) return lame;
  const double odds = effects.plane_strain * making.thickness_mm / 3.2,
               share = odds / (odds + 1.0 - effects.plane_strain);
  const double nu = std::min(poisson, 0.49);
  const double full_pa = 2.0 * lame.mu_pa * nu / (1.0 - 2.0 * nu);
  lame.lambda_pa += share * std::max(0.0, full_pa - lame.lambda_pa);
  return lame;
}

struct ElementConstants {
  double mu_pa, lambda_pa, threshold;
};

ElementConstants element_constants(const Constants& constants, double rigid_fraction, double factor,
                                   const HiddenEffects& effects, const Making& making) {
  const double young = mixed_in_log(constants.young_pa, rigid_fraction) * factor;
  const double poisson = mixed(constants.poisson, rigid_fraction);
  const material::Lame lame =
      held_in_thickness(material::lame_from_engineering(young, poisson), poisson, effects, making);
  return {lame.mu_pa, lame.lambda_pa, mixed_in_log(constants.threshold, rigid_fraction) * factor};
}

/// A rigid pixel that stands nearly alone.
bool is_thin_feature(const pattern::Layout& layout, int row, int column) {
  const auto pixel = [](int element) {
    return static_cast<int>(std::floor((element + 0.5) * kElementM / kPixelM - kFirstCentre + 0.5));
  };
  const int y = pixel(row), x = pixel(column);
  if (!rigid_at(layout, x, y)) return false;
  const int neighbours =
      rigid_at(layout, x - 1, y) + rigid_at(layout, x + 1, y) + rigid_at(layout, x, y - 1) + rigid_at(layout, x, y + 1);
  return neighbours < 3;
}

/// A place of the specimen, for what does not repeat with the unit; 0 to 1 along each axis, pixels along the printer's.
struct Place {
  double x = 0.0, y = 0.0, side_pixels = 0.0;
  int printer_row = 0;
  double printed = 0.0;  ///< 0 first, 1 last
};

/// Factors on stiffness and strength of what hidden effects do at a place.
struct PlaceFactors {
  double stiffness = 1.0, strength = 1.0;
};

PlaceFactors place_factors(const HiddenEffects& effects, const Place& place, double rigid_fraction) {
  constexpr double kEdgePixels = 2.0;
  constexpr int kRowsPerLayer = 10;
  PlaceFactors factors;
  const auto lose = [&](double share) {
    factors.stiffness *= 1.0 - share;
    factors.strength *= 1.0 - share;
  };
  lose(effects.void_gradient * place.printed * soft_part(rigid_fraction));
  if (place.side_pixels < kEdgePixels) lose(effects.edge_layer);
  if (place.printer_row % kRowsPerLayer == kRowsPerLayer / 2) factors.strength *= 1.0 - effects.weak_layers;
  return factors;
}

Place place_of(const SpecimenSize& size, int row, int column, double orientation_deg) {
  const double x = (column + 0.5) * kElementM, y = (row + 0.5) * kElementM;
  const double width = size.columns * kTesterElementM, height = size.rows * kTesterElementM;
  const bool turned = orientation_deg == 90.0;
  return {.x = x / width,
          .y = y / height,
          .side_pixels = std::min(x, width - x) / kPixelM,
          .printer_row = static_cast<int>((turned ? x : y) / kPixelM),
          .printed = turned ? x / width : y / height};
}

/// Share of an element that was not cut away.
double remaining_share(const SpecimenSize& size, int row, int column) {
  if (size.root_radius_columns == 0.0)
    return is_cut_away(size, (column + 0.5) * kElementM, (row + 0.5) * kElementM) ? 0.0 : 1.0;
  constexpr int kPoints = 6;
  int left = 0;
  for (int i = 0; i < kPoints * kPoints; ++i) {
    const double x = (column + (i % kPoints + 0.5) / kPoints) * kElementM,
                 y = (row + (i / kPoints + 0.5) / kPoints) * kElementM;
    left += is_cut_away(size, x, y) ? 0 : 1;
  }
  return left < 3 ? 0.0 : static_cast<double>(left) / (kPoints * kPoints);
}

/// Weibull factors of mean 1, one for each voxel of a tester element's size.
std::vector<double> voxel_strengths(const Truth& truth, const pattern::Design& design, const Making& making,
                                    const SpecimenSize& size) {
  const double variation = variation_of_strength(truth);
  if (variation == 0.0) return {};
  RandomStream stream(truth.seed,
                      fmt::format("voxels/{}/{}/{}", design.name(), making.orientation_deg, making.specimen));
  // Justus' approximation of the shape is right within 1 % from 5 to 60 %.
  const double shape = std::pow(variation, -1.086);
  std::vector<double> factors(size.columns * size.rows);
  for (double& factor : factors)
    factor = std::pow(-std::log(1.0 - stream.uniform()), 1.0 / shape) / std::tgamma(1.0 + 1.0 / shape);
  return factors;
}

Raster empty_raster(const SpecimenSize& size) {
  const int refinement = static_cast<int>(kTesterElementM / kElementM + 0.5);
  Raster raster;
  raster.columns = size.columns * refinement;
  raster.rows = size.rows * refinement;
  const auto count = static_cast<std::size_t>(raster.columns * raster.rows);
  raster.mu_pa.assign(count, 0.0);
  raster.lambda_pa.assign(count, 0.0);
  raster.threshold_j_per_m3.assign(count, std::numeric_limits<double>::infinity());
  return raster;
}

/// What the repeated unit is made of.
struct UnitElements {
  std::vector<ElementConstants> constants;
  std::vector<double> rigid_fraction;
};

UnitElements unit_elements(const Constants& constants, const Truth& truth, const pattern::Design& design,
                           const Making& making) {
  UnitElements unit;
  const HiddenEffects& effects = truth.effects;
  if (const pattern::Mixture* mixture = design.mixture()) {
    unit.rigid_fraction.assign(kUnitElements * kUnitElements, mixture->rigid_fraction);
    unit.constants.assign(kUnitElements * kUnitElements,
                          element_constants(constants, mixture->rigid_fraction, 1.0, effects, making));
    return unit;
  }
  const pattern::Layout& layout = *design.layout();  // outline and layout are turned together when printed
  const LaidUnit printed = unit_of(layout, effects);
  unit.rigid_fraction = printed.rigid_fraction;
  for (int row = 0; row < kUnitElements; ++row) {
    for (int column = 0; column < kUnitElements; ++column) {
      const std::size_t i = unit_index(row, column);
      double factor = site_factor(printed.site[i], effects, making.orientation_deg);
      if (effects.undercured_features > 0.0 && is_thin_feature(layout, row, column))
        factor *= 1.0 - effects.undercured_features;
      unit.constants.push_back(element_constants(constants, printed.rigid_fraction[i], factor, effects, making));
    }
  }
  return unit;
}

/// The hidden laws of element `e` of a fracture specimen.
void set_laws(HiddenLaw& law, std::size_t e, std::size_t count, const HiddenEffects& effects, double rigid_fraction,
              bool homogeneous) {
  const auto put = [&](std::vector<double>& field, bool acts, double otherwise, double value) {
    if (!acts) return;
    if (field.empty()) field.assign(count, otherwise);
    field[e] = value;
  };
  const double never = std::numeric_limits<double>::infinity(), rigid = rigid_part(rigid_fraction);
  put(law.yield_pa, effects.rigid_yield_pa > 0.0, never, rigid > 0.0 ? effects.rigid_yield_pa / rigid : never);
  put(law.inverse_limit, effects.soft_stiffening_limit > 0.0, 0.0,
      soft_part(rigid_fraction) / std::max(effects.soft_stiffening_limit, 1e-9));
  put(law.eigenstrain, effects.residual_strain != 0.0 && !homogeneous, 0.0, -effects.residual_strain * rigid_fraction);
  put(law.overstress, effects.rate_overstress > 0.0, 0.0, effects.rate_overstress);
  put(law.overstress, effects.soft_overstress > 0.0, 0.0, effects.soft_overstress * soft_part(rigid_fraction));
}

/// A criterion with a length keeps W on every mesh, and draws its tails out instead: an unrefined element takes up as
/// much.
void set_criterion(Raster& raster, const material::FailureCriterion& criterion) {
  if (criterion.kind == material::CriterionKind::element) return;
  HiddenLaw& law = raster.law;
  if (criterion.kind == material::CriterionKind::neighbourhood) raster.neighbourhood_m = criterion.radius_m;
  if (criterion.kind == material::CriterionKind::crack_band)
    (law.drawn_out_softening > 0.0 ? law.drawn_out_softening : law.linear_softening) += criterion.softening;
  for (double* softening : {&law.linear_softening, &law.drawn_out_softening})
    if (*softening > 0.0) *softening = (1.0 + *softening) * kTesterElementM / kElementM - 1.0;
}

Raster rasterised(const Constants& constants, const Truth& truth, const pattern::Design& design, const Making& making,
                  const SpecimenSize& size) {
  Raster raster = empty_raster(size);
  const HiddenEffects& effects = truth.effects;
  raster.all_soft = design.rigid_fraction() == 0.0;
  raster.grips.tilt = effects.grip_tilt;
  if (effects.grip_friction > 0.0)
    raster.grips.side_stiffness_pa =
        effects.grip_friction / (1.0 - effects.grip_friction) * mixed_in_log(constants.young_pa, 0.5);
  const UnitElements unit = unit_elements(constants, truth, design, making);
  const double scale = truth.criterion.kind == material::CriterionKind::element ? kThresholdScale : 1.0;
  const std::vector<double> strengths =
      size.notched ? voxel_strengths(truth, design, making, size) : std::vector<double>{};
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      const double remaining = remaining_share(size, row, column);
      if (remaining == 0.0) continue;
      const std::size_t in_unit = unit_index(row % kUnitElements, column % kUnitElements);
      const ElementConstants& element = unit.constants[in_unit];
      const double rigid_fraction = unit.rigid_fraction[in_unit];
      const PlaceFactors factors =
          place_factors(effects, place_of(size, row, column, making.orientation_deg), rigid_fraction);
      const auto e = static_cast<std::size_t>(row * raster.columns + column);
      raster.mu_pa[e] = element.mu_pa * factors.stiffness * remaining;
      raster.lambda_pa[e] = element.lambda_pa * factors.stiffness * remaining;
      raster.threshold_j_per_m3[e] = scale * element.threshold * factors.strength * remaining;
      if (!strengths.empty()) raster.threshold_j_per_m3[e] *= strengths[row / 2 * size.columns + column / 2];
      if (size.notched)
        set_laws(raster.law, e, raster.mu_pa.size(), effects, rigid_fraction, design.mixture() != nullptr);
    }
  }
  return raster;
}

/// E of a tensile test over its relaxed value: means of the branch's stress rate between 0.05 and 0.25 % strain.
double branch_stiffness(double overstress, double relaxation_s, double rate_per_s) {
  if (overstress == 0.0) return 1.0;
  const double first = 0.0005 / rate_per_s, last = 0.0025 / rate_per_s;
  return 1.0 + overstress * relaxation_s * (std::exp(-first / relaxation_s) - std::exp(-last / relaxation_s)) /
                   (last - first);
}

/// The same of a held strain: the branch takes up stress during the ramp and relaxes.
double branch_stiffness_held(double overstress, double relaxation_s, const Making& making) {
  if (overstress == 0.0) return 1.0;
  const double after = making.held_s - 0.5 * making.ramp_s, before = making.held_s + 0.5 * making.ramp_s;
  return 1.0 + overstress * relaxation_s * (std::exp(-after / relaxation_s) - std::exp(-before / relaxation_s)) /
                   making.ramp_s;
}

double branch_stiffness(double overstress, double relaxation_s, const Making& making) {
  return making.held_s > 0.0 ? branch_stiffness_held(overstress, relaxation_s, making)
                             : branch_stiffness(overstress, relaxation_s, making.strain_rate_per_s);
}

/// What a phase gains by a pull faster than the usual one; or of a held strain, over that usual pull: both stresses are
/// integrals of a relaxation function that falls as time to the power -n, n < 1.
double power_law_factor(double exponent, const Making& making) {
  constexpr double kUsualRate = 6.17e-4, kFirst = 0.0005, kLast = 0.0025;
  if (making.held_s == 0.0) return std::pow(making.strain_rate_per_s / kUsualRate, exponent);
  const auto integral = [&](double from, double to) {
    return std::pow(to, 1.0 - exponent) - std::pow(from, 1.0 - exponent);
  };
  const double held = integral(making.held_s - 0.5 * making.ramp_s, making.held_s + 0.5 * making.ramp_s);
  const double pulled = integral(kFirst / kUsualRate, kLast / kUsualRate) * kUsualRate / (kLast - kFirst);
  return held / making.ramp_s / pulled;
}

/// Of soft, interface and rigid phase as in Constants.
std::array<double, 3> power_law_factors(const HiddenEffects& effects, const Making& making) {
  const double soft = effects.rate_exponent, rigid = soft * effects.rate_exponent_ratio;
  return {power_law_factor(soft, making), power_law_factor(0.5 * (soft + rigid), making),
          power_law_factor(rigid, making)};
}

/// The constants of theta as a modulus test finds them, at its rate or after its hold.
Constants tested_constants(const Truth& truth, const Making& making) {
  const HiddenEffects& effects = truth.effects;
  Constants constants = as_laid(constants_of(truth.modulus), effects, making);
  const double all =
      branch_stiffness(effects.rate_overstress, effects.rate_relaxation_s, making) *
      (branch_stiffness(effects.two_overstresses, effects.shorter_relaxation_s, making) +
       branch_stiffness(effects.two_overstresses, kLongerRelaxation * effects.shorter_relaxation_s, making) - 1.0);
  for (double& young_pa : constants.young_pa) young_pa *= all;
  constants.young_pa[0] *= branch_stiffness(effects.soft_overstress, effects.soft_relaxation_s, making);
  if (effects.rate_exponent > 0.0) {
    const std::array<double, 3> gained = power_law_factors(effects, making);
    for (std::size_t phase = 0; phase < gained.size(); ++phase) constants.young_pa[phase] *= gained[phase];
  }
  return constants;
}

/// A blend's E over that of the mixture law: a parabola between the three materials, in the logarithm.
double blended(const HiddenEffects& effects, double rigid_fraction) {
  const double off_middle = 4.0 * std::abs(std::fmod(rigid_fraction, 0.5) - 0.25);
  return effects.blend_bulge == 0.0 ? 1.0 : std::exp(effects.blend_bulge * (1.0 - off_middle * off_middle));
}

}  // namespace

Site site_at(const pattern::Layout& layout, double x_m, double y_m) {
  const Neighbours x = neighbours(x_m), y = neighbours(y_m);
  const bool lower_left = rigid_at(layout, x.first, y.first), lower_right = rigid_at(layout, x.second, y.first);
  const bool upper_left = rigid_at(layout, x.first, y.second), upper_right = rigid_at(layout, x.second, y.second);
  const bool agree = lower_left == lower_right && lower_left == upper_left && lower_left == upper_right;
  if (agree) return lower_left ? Site::rigid : Site::soft;
  if (!x.at_boundary()) return Site::interface_y;
  if (!y.at_boundary()) return Site::interface_x;
  const bool crossed = lower_left == upper_right && lower_right == upper_left;  // and neighbours differ
  return crossed ? Site::diagonal : Site::corner;
}

bool is_cut_away(const SpecimenSize& size, double x_m, double y_m) {
  if (!size.notched) return false;
  const double x = x_m / kTesterElementM, above_axis = y_m / kTesterElementM - (size.notch_row + 0.5);
  const bool in_notch = x < size.notch_columns && std::abs(above_axis) < 0.5;
  const double radius = size.root_radius_columns;
  if (std::hypot(x - (size.notch_columns - radius), above_axis) < radius) return true;
  const double half_opening = std::tan(std::numbers::pi / 6.0);  // of 60 degrees
  return in_notch || std::abs(above_axis) < (size.cut_columns - x) * half_opening;
}

SpecimenSize specimen_size(tester::TestKind test, tester::Fidelity fidelity) {
  const bool notched = test == tester::TestKind::toughness;
  const tester::SpecimenUnits units = notched ? tester::toughness_units(fidelity) : tester::modulus_units(fidelity);
  const int per_unit = pattern::kSide * thesis::kElementsPerPixel;
  SpecimenSize size;
  size.columns = units.x * per_unit;
  size.rows = units.y * per_unit;
  if (!notched) return size;
  const double share = size.columns / static_cast<double>(thesis::kToughnessUnitsX * per_unit);
  size.notched = true;
  size.notch_row = size.rows / 2;
  size.notch_columns = static_cast<int>(std::lround(share * thesis::kNotchElements));
  size.cut_columns = share * thesis::kCutElements;
  return size;
}

SpecimenSize specimen_size(tester::TestKind test, tester::Fidelity fidelity, const HiddenEffects& effects) {
  SpecimenSize size = specimen_size(test, fidelity);
  if (!size.notched) return size;
  size.root_radius_columns = effects.blunt_notch * size.columns;
  size.notch_columns += static_cast<int>(std::lround(effects.longer_notch * size.columns));
  return size;
}

Raster modulus_raster(const Truth& truth, const pattern::Design& design, const Making& making,
                      const SpecimenSize& size) {
  return rasterised(tested_constants(truth, making), truth, design, making, size);
}

Raster fracture_raster(const Truth& truth, const pattern::Design& design, const Making& making,
                       const SpecimenSize& size) {
  const HiddenEffects& effects = truth.effects;
  Raster raster = rasterised(as_laid(constants_of(truth.toughness), effects, making), truth, design, making, size);
  // The machine pulls slowly, the bench fast: what relaxes does so at the same strain.
  raster.law.relaxation_s = (effects.rate_overstress > 0.0 ? effects.rate_relaxation_s : effects.soft_relaxation_s) *
                            making.strain_rate_per_s / making.pull_rate_per_s;
  raster.law.linear_softening = effects.progressive_damage;
  raster.law.drawn_out_softening = effects.drawn_out_damage;
  set_criterion(raster, truth.criterion);
  raster.law.tension_only = effects.tension_only_failure;
  return raster;
}

double homogeneous_modulus(const Truth& truth, double rigid_fraction, const Making& making) {
  if (truth.effects.plane_strain == 0.0)
    return mixed_in_log(tested_constants(truth, making).young_pa, rigid_fraction) *
           blended(truth.effects, rigid_fraction);
  const material::Lame lame = homogeneous_lame(truth, rigid_fraction, making);
  return 4.0 * lame.mu_pa * (lame.lambda_pa + lame.mu_pa) / (lame.lambda_pa + 2.0 * lame.mu_pa);
}

material::Lame homogeneous_lame(const Truth& truth, double rigid_fraction, const Making& making) {
  const Constants constants = tested_constants(truth, making);
  const double poisson = mixed(constants.poisson, rigid_fraction);
  const double young_pa = mixed_in_log(constants.young_pa, rigid_fraction) * blended(truth.effects, rigid_fraction);
  return held_in_thickness(material::lame_from_engineering(young_pa, poisson), poisson, truth.effects, making);
}

}  // namespace nacre::laboratory
