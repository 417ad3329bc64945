#include "laboratory/laid_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nacre::laboratory {
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
        sum += shares[k + reach] * field[unit_index(r, c)];
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

/// Pixels that reach a place when grown.
struct Reached {
  int first = 0, last = 0;
};

/// Probes before, at and behind a place.
constexpr std::array kProbes = {-kInterfaceReach, 0.0, kInterfaceReach};

/// A stretch of an element along one direction in which no probe comes to other pixels.
struct Stretch {
  double share = 0.0;  ///< of the element
  std::array<Reached, kProbes.size()> reached;
};

/// The stretches of an element where every pixel reaches `reach` pixels from its centre.
std::vector<Stretch> stretches_of(int element, double reach) {
  const auto in_pixels = [](int at) { return at * kElementM / kPixelM - kFirstCentre; };
  const double begin = in_pixels(element), end = in_pixels(element + 1);
  std::vector<double> ends = {begin, end};
  for (const double probe : kProbes)
    for (const double side : {-reach, reach})
      for (double at = std::ceil(begin + probe - side) + side - probe; at < end; at += 1.0) ends.push_back(at);
  std::sort(ends.begin(), ends.end());
  std::vector<Stretch> stretches;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (ends[i] <= ends[i - 1]) continue;
    const double middle = 0.5 * (ends[i - 1] + ends[i]);
    stretches.push_back({.share = (ends[i] - ends[i - 1]) / (end - begin), .reached = {}});
    for (std::size_t k = 0; k < kProbes.size(); ++k)
      stretches.back().reached[k] = {.first = static_cast<int>(std::ceil(middle + kProbes[k] - reach)),
                                     .last = static_cast<int>(std::floor(middle + kProbes[k] + reach))};
  }
  return stretches;
}

bool any_rigid(const pattern::Layout& layout, Reached rows, Reached columns) {
  for (int row = rows.first; row <= rows.last; ++row)
    for (int column = columns.first; column <= columns.last; ++column)
      if (rigid_at(layout, column, row)) return true;
  return false;
}

/// Rigid fraction of an element where rigid regions have grown on every side by `growth` pixels: the mean over its
/// area, each place soft, rigid or, where probes a quarter pixel away disagree, interface.
double grown_fraction(const pattern::Layout& layout, int row, int column, double growth) {
  const std::vector<Stretch> rows = stretches_of(row, 0.5 + growth), columns = stretches_of(column, 0.5 + growth);
  double fraction = 0.0;
  for (const Stretch& y : rows)
    for (const Stretch& x : columns) {
      std::size_t rigid = 0;
      for (const Reached up : y.reached)
        for (const Reached across : x.reached) rigid += any_rigid(layout, up, across) ? 1 : 0;
      fraction += y.share * x.share * (rigid == kProbes.size() * kProbes.size() ? 1.0 : rigid == 0 ? 0.0 : 0.5);
    }
  return std::clamp(fraction, 0.0, 1.0);
}

}  // namespace

bool rigid_at(const pattern::Layout& layout, int column, int row) {
  return layout.rigid(pattern::kSide - 1 - wrapped(row), wrapped(column));
}

LaidUnit unit_of(const pattern::Layout& layout, const HiddenEffects& effects) {
  LaidUnit unit;
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

}  // namespace nacre::laboratory
