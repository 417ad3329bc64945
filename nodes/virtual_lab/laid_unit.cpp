#include "virtual_lab/laid_unit.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace nacre::virtual_laboratory {
namespace {

int wrapped(int index) { return (index % pattern::kSide + pattern::kSide) % pattern::kSide; }

double rigid_fraction_of(Site site) { return site == Site::rigid ? 1.0 : site == Site::soft ? 0.0 : 0.5; }

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

/// Weights of a bell of standard deviation `deviation` elements, out to three of them.
std::vector<double> bell_shares(double deviation) {
  const int reach = static_cast<int>(std::ceil(3.0 * deviation));
  const auto below = [&](double t) { return 0.5 * std::erfc(-t / (deviation * std::numbers::sqrt2)); };
  std::vector<double> shares;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    shares.push_back(below(k + 0.5) - below(k - 0.5));
    sum += shares.back();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

/// Places in an element along one direction, and at each the pixels that reach it when grown: those of a probe before,
/// at and behind the place.
constexpr int kPlaces = 16, kProbes = 3;  // fewer places would round the growth to steps of a sixteenth of a pixel
struct Reached {
  int first = 0, last = 0;
};
using ReachedAlong = std::array<std::array<Reached, kProbes>, kPlaces>;

ReachedAlong reached_along(int element, double growth) {
  ReachedAlong along;
  for (int place = 0; place < kPlaces; ++place) {
    const double at = (element + (place + 0.5) / kPlaces) * kElementM / kPixelM - kFirstCentre;
    for (int probe = 0; probe < kProbes; ++probe) {
      const double x = at + (probe - 1) * kInterfaceReach, reach = 0.5 + growth;
      along[static_cast<std::size_t>(place)][static_cast<std::size_t>(probe)] = {
          static_cast<int>(std::ceil(x - reach)), static_cast<int>(std::floor(x + reach))};
    }
  }
  return along;
}

bool any_rigid(const pattern::Layout& layout, Reached rows, Reached columns) {
  for (int row = rows.first; row <= rows.last; ++row)
    for (int column = columns.first; column <= columns.last; ++column)
      if (rigid_at(layout, column, row)) return true;
  return false;
}

/// Rigid fraction of an element where rigid regions have grown on every side by `growth` pixels: the mean over places
/// in it, each soft, rigid or, where probes a quarter pixel away disagree, interface.
double grown_fraction(const pattern::Layout& layout, int row, int column, double growth) {
  const ReachedAlong up = reached_along(row, growth), across = reached_along(column, growth);
  double sum = 0.0;
  for (const auto& rows : up)
    for (const auto& columns : across) {
      int rigid = 0;
      for (const Reached y : rows)
        for (const Reached x : columns) rigid += any_rigid(layout, y, x) ? 1 : 0;
      sum += rigid == kProbes * kProbes ? 1.0 : rigid == 0 ? 0.0 : 0.5;
    }
  return sum / (kPlaces * kPlaces);
}

}  // namespace

bool rigid_at(const pattern::Layout& layout, int column, int row) {
  return layout.rigid(pattern::kSide - 1 - wrapped(row), wrapped(column));
}

Unit unit_of(const pattern::Layout& layout, const HiddenEffects& effects) {
  Unit unit;
  for (int row = 0; row < kUnitElements; ++row) {
    for (int column = 0; column < kUnitElements; ++column) {
      const Site site = site_at(layout, (column + 0.5) * kElementM, (row + 0.5) * kElementM);
      unit.site.push_back(site);
      unit.rigid_fraction.push_back(effects.rigid_overprint_pixels > 0.0
                                        ? grown_fraction(layout, row, column, effects.rigid_overprint_pixels)
                                        : rigid_fraction_of(site));
    }
  }
  const double elements_per_pixel = kPixelM / kElementM;
  const auto mix = [&](const std::vector<double>& shares) {
    unit.rigid_fraction = averaged(averaged(unit.rigid_fraction, shares, false), shares, true);
  };
  const double window_elements = effects.droplet_mixing_pixels * elements_per_pixel;
  if (window_elements > 0.0) mix(window_shares(window_elements));
  if (effects.smooth_mixing_pixels > 0.0) mix(bell_shares(effects.smooth_mixing_pixels * elements_per_pixel));
  return unit;
}

}  // namespace nacre::virtual_laboratory
