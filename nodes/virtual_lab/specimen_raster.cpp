#include "virtual_lab/specimen_raster.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "material/neo_hookean.hpp"
#include "tester/fidelity.hpp"

namespace nacre::virtual_laboratory {
namespace {

/// Lengths in pixels. Pixel k of a row of pixels is centred half a tester element from the specimen's edge plus k
/// pixels.
constexpr double kFirstCentre = 0.5 * kTesterElementM / kPixelM;
constexpr double kInterfaceReach = 0.25;
/// Elements of the laboratory along one side of a repeated unit.
constexpr int kUnitElements = static_cast<int>(pattern::kSide * kPixelM / kElementM + 0.5);
/// Thresholds are meant at the testers' element size; deletion of smaller elements dissipates W h per area.
constexpr double kThresholdScale = kTesterElementM / kElementM;

int wrapped(int index) { return (index % pattern::kSide + pattern::kSide) % pattern::kSide; }

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

/// Pixel (column, row) counted from the lower left, the unit repeated without end.
bool rigid_at(const pattern::Layout& layout, int column, int row) {
  return layout.rigid(pattern::kSide - 1 - wrapped(row), wrapped(column));
}

double rigid_fraction_of(Site site) { return site == Site::rigid ? 1.0 : site == Site::soft ? 0.0 : 0.5; }

/// One periodic unit at the laboratory's resolution.
struct Unit {
  std::vector<Site> site;
  std::vector<double> rigid_fraction;
};
std::size_t unit_index(int row, int column) { return static_cast<std::size_t>(row * kUnitElements + column); }

/// Integral up to t of the hat function of width two around 0: how much of an element a window of its size has passed.
double hat_integral(double t) {
  if (t <= -1.0) return 0.0;
  if (t >= 1.0) return 1.0;
  return t < 0.0 ? 0.5 * (1.0 + t) * (1.0 + t) : 1.0 - 0.5 * (1.0 - t) * (1.0 - t);
}

/// Share of the element at distance k = -reach .. reach in the mean over an element of the moving average of width
/// `width`, both in elements.
std::vector<double> window_shares(double width) {
  const int reach = static_cast<int>(std::ceil(0.5 * width));
  std::vector<double> shares;
  for (int k = -reach; k <= reach; ++k) {
    shares.push_back((hat_integral(k + 0.5 * width) - hat_integral(k - 0.5 * width)) / width);
  }
  return shares;
}

/// Mean of `field` over a square window of `shares` around each element, the unit repeated without end.
std::vector<double> averaged(const std::vector<double>& field, const std::vector<double>& shares, bool along_rows) {
  const int reach = static_cast<int>(shares.size() / 2);
  std::vector<double> result(field.size());
  for (int row = 0; row < kUnitElements; ++row) {
    for (int column = 0; column < kUnitElements; ++column) {
      double sum = 0.0;
      for (int k = -reach; k <= reach; ++k) {
        const int r = along_rows ? (row + k + kUnitElements) % kUnitElements : row;
        const int c = along_rows ? column : (column + k + kUnitElements) % kUnitElements;
        sum += shares[static_cast<std::size_t>(k + reach)] * field[unit_index(r, c)];
      }
      result[unit_index(row, column)] = sum;
    }
  }
  return result;
}

Unit unit_of(const pattern::Layout& layout, double mixing_pixels) {
  Unit unit;
  for (int row = 0; row < kUnitElements; ++row) {
    for (int column = 0; column < kUnitElements; ++column) {
      const Site site = site_at(layout, (column + 0.5) * kElementM, (row + 0.5) * kElementM);
      unit.site.push_back(site);
      unit.rigid_fraction.push_back(rigid_fraction_of(site));
    }
  }
  const double window_elements = mixing_pixels * kPixelM / kElementM;
  if (window_elements > 0.0) {
    const std::vector<double> shares = window_shares(window_elements);
    unit.rigid_fraction = averaged(averaged(unit.rigid_fraction, shares, false), shares, true);
  }
  return unit;
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

struct ElementConstants {
  double mu_pa, lambda_pa, threshold;
};

ElementConstants element_constants(const Constants& constants, double rigid_fraction, double factor) {
  const double young = mixed_in_log(constants.young_pa, rigid_fraction) * factor;
  const material::Lame lame = material::lame_from_engineering(young, mixed(constants.poisson, rigid_fraction));
  return {lame.mu_pa, lame.lambda_pa, mixed_in_log(constants.threshold, rigid_fraction) * factor * kThresholdScale};
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

Raster rasterised(const Constants& constants, const HiddenEffects& effects, const pattern::Design& design,
                  double orientation_deg, const SpecimenSize& size) {
  Raster raster = empty_raster(size);
  const bool homogeneous = design.mixture() != nullptr;
  raster.all_soft = design.rigid_fraction() == 0.0;
  std::vector<ElementConstants> unit;
  if (homogeneous) {
    unit.assign(kUnitElements * kUnitElements, element_constants(constants, design.mixture()->rigid_fraction, 1.0));
  } else {
    // Orientation 90: the design lies in the printer's axes, the specimen is pulled along the printer's x.
    const pattern::Layout layout = orientation_deg == 90.0 ? design.layout()->rotated() : *design.layout();
    const Unit printed = unit_of(layout, effects.droplet_mixing_pixels);
    for (std::size_t i = 0; i < printed.site.size(); ++i) {
      const double factor = site_factor(printed.site[i], effects, orientation_deg);
      unit.push_back(element_constants(constants, printed.rigid_fraction[i], factor));
    }
  }
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column) {
      if (is_cut_away(size, (column + 0.5) * kElementM, (row + 0.5) * kElementM)) continue;
      const ElementConstants& element = unit[unit_index(row % kUnitElements, column % kUnitElements)];
      const auto e = static_cast<std::size_t>(row * raster.columns + column);
      raster.mu_pa[e] = element.mu_pa;
      raster.lambda_pa[e] = element.lambda_pa;
      raster.threshold_j_per_m3[e] = element.threshold;
    }
  }
  return raster;
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

Raster modulus_raster(const Truth& truth, const pattern::Design& design, double orientation_deg,
                      const SpecimenSize& size) {
  return rasterised(constants_of(truth.modulus), truth.effects, design, orientation_deg, size);
}

Raster fracture_raster(const Truth& truth, const pattern::Design& design, double orientation_deg,
                       const SpecimenSize& size) {
  return rasterised(constants_of(truth.toughness), truth.effects, design, orientation_deg, size);
}

double homogeneous_modulus(const Truth& truth, double rigid_fraction) {
  return mixed_in_log(constants_of(truth.modulus).young_pa, rigid_fraction);
}

material::Lame homogeneous_lame(const Truth& truth, double rigid_fraction) {
  return material::lame_from_engineering(homogeneous_modulus(truth, rigid_fraction),
                                         mixed(constants_of(truth.modulus).poisson, rigid_fraction));
}

}  // namespace nacre::virtual_laboratory
