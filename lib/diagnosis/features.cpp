#include "diagnosis/features.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnosis/smoothing.hpp"
#include "measurement/reduction.hpp"

namespace nacre::diagnosis {
namespace {

struct Names {
  std::string_view name, words;
};
constexpr std::array<Names, kFeatureCount> kNames = {{{"log_modulus", "Young's modulus"},
                                                      {"log_toughness", "toughness"},
                                                      {"toe_strain", "offset of the toe"},
                                                      {"log_tangent_10", "slope at 10 % of the peak"},
                                                      {"log_tangent_30", "slope at 30 % of the peak"},
                                                      {"log_tangent_50", "slope at 50 % of the peak"},
                                                      {"knee", "bend before the peak"},
                                                      {"log_peak", "stress at the peak"},
                                                      {"log_peak_strain", "strain at the peak"},
                                                      {"drop", "fall after the peak"},
                                                      {"tail", "energy after the peak"},
                                                      {"log_unloading", "slope on unloading"},
                                                      {"set_share", "permanent set"},
                                                      {"toe_share", "offset of the toe"},
                                                      {"log_held", "stress after a hold"},
                                                      {"held_set", "set at zero force"},
                                                      {"dwelled_set", "set after a dwell"}}};

/// The rising part of a curve, strain never decreasing, up to its largest stress.
struct Rise {
  tester::Curve path;
  double peak_pa = 0.0, peak_strain = 0.0;
  /// Strain at which `share` of the peak is first reached.
  double strain_at(double share) const {
    const double stress = share * peak_pa;
    std::size_t k = 1;
    while (k + 1 < path.size() && path.stress_pa[k] < stress) ++k;
    const double low = path.stress_pa[k - 1], high = path.stress_pa[k];
    const double t = high > low ? std::clamp((stress - low) / (high - low), 0.0, 1.0) : 0.0;
    return path.strain[k - 1] + t * (path.strain[k] - path.strain[k - 1]);
  }
};

std::optional<Rise> rise_of(const tester::Curve& forward) {
  if (forward.size() < 4) return std::nullopt;
  const auto peak = static_cast<std::size_t>(std::max_element(forward.stress_pa.begin(), forward.stress_pa.end()) -
                                             forward.stress_pa.begin());
  if (peak < 2 || forward.stress_pa[peak] <= 0.0 || forward.strain[peak] <= 0.0) return std::nullopt;
  Rise rise{{}, forward.stress_pa[peak], forward.strain[peak]};
  rise.path.strain.assign(forward.strain.begin(), forward.strain.begin() + static_cast<std::ptrdiff_t>(peak) + 1);
  rise.path.stress_pa.assign(forward.stress_pa.begin(),
                             forward.stress_pa.begin() + static_cast<std::ptrdiff_t>(peak) + 1);
  return rise;
}

void put_slope(FeatureValues& values, Feature feature, const Rise& rise, double low, double high) {
  const double strain = rise.strain_at(high) - rise.strain_at(low);
  if (strain > 0.0) value_of(values, feature) = std::log((high - low) * rise.peak_pa / strain);
}

/// Features of the way up to the peak.
void put_rise(FeatureValues& values, const Rise& rise) {
  put_slope(values, Feature::log_tangent_10, rise, 0.05, 0.15);
  put_slope(values, Feature::log_tangent_30, rise, 0.2, 0.4);
  put_slope(values, Feature::log_tangent_50, rise, 0.4, 0.6);
  if (const auto slope = value_of(values, Feature::log_tangent_30))
    value_of(values, Feature::toe_strain) =
        0.5 * (rise.strain_at(0.2) + rise.strain_at(0.4)) - 0.3 * rise.peak_pa / std::exp(*slope);
  const double energy = tester::area_under(rise.path);
  if (energy > 0.0) value_of(values, Feature::knee) = std::log(energy / (0.5 * rise.peak_pa * rise.peak_strain));
  value_of(values, Feature::log_peak) = std::log(rise.peak_pa);
  value_of(values, Feature::log_peak_strain) = std::log(rise.peak_strain);
}

/// A stretch of a curve from where strain turns back to the least strain before it goes beyond that again.
struct Unloading {
  std::size_t turn = 0, end = 0;
};

std::optional<Unloading> first_unloading(const tester::Curve& curve, const CurveReading& reading) {
  for (std::size_t turn = 1; turn + 1 < curve.size(); ++turn) {
    const double top = curve.stress_pa[turn];
    if (curve.strain[turn + 1] >= curve.strain[turn] || top <= 0.0) continue;
    std::size_t next = turn + 1;
    while (next < curve.size() && curve.strain[next] <= curve.strain[turn]) ++next;
    const auto at = [&](std::size_t k) { return curve.stress_pa.begin() + static_cast<std::ptrdiff_t>(k); };
    const auto fallen =
        std::find_if(at(turn + 1), at(next), [&](double stress) { return stress < reading.turned_share * top; });
    // Readings of strain waver: a turn without a fall of the stress is none. A break lets go of everything between two.
    if (fallen == at(next) || *fallen < reading.parted_share * top) continue;
    const auto least = std::min_element(curve.strain.begin() + static_cast<std::ptrdiff_t>(turn),
                                        curve.strain.begin() + static_cast<std::ptrdiff_t>(next));
    return Unloading{turn, static_cast<std::size_t>(least - curve.strain.begin())};
  }
  return std::nullopt;
}

/// The readings of an unloading, least strain first.
tester::Curve unloading_of(const tester::Curve& curve, const Unloading& unloading) {
  tester::Curve path;
  for (std::size_t k = unloading.end + 1; k-- > unloading.turn;) {
    path.strain.push_back(curve.strain[k]);
    path.stress_pa.push_back(curve.stress_pa[k]);
  }
  return path;
}

/// Features of the first unloading.
void put_unloading(FeatureValues& values, const tester::Curve& curve, const CurveReading& reading) {
  const auto unloading = first_unloading(curve, reading);
  if (!unloading) return;
  const tester::Curve path = smoothed(unloading_of(curve, *unloading), reading);
  const double top = path.stress_pa.back();
  const auto strain_at = [&](double stress) -> std::optional<double> {
    for (std::size_t k = path.size() - 1; k > 0; --k) {
      if (path.stress_pa[k] < stress || path.stress_pa[k - 1] > stress) continue;
      const double fall = path.stress_pa[k] - path.stress_pa[k - 1];
      const double t = fall > 0.0 ? (path.stress_pa[k] - stress) / fall : 0.0;
      return path.strain[k] + t * (path.strain[k - 1] - path.strain[k]);
    }
    return std::nullopt;
  };
  const double highest = 0.9 * top, lowest = std::max(0.5 * top, path.stress_pa.front());
  const auto high = strain_at(highest), low = strain_at(lowest);
  if (!high || !low || *high <= *low) return;
  const double slope = (highest - lowest) / (*high - *low);
  value_of(values, Feature::log_unloading) = std::log(slope);
  value_of(values, Feature::set_share) = (*low - lowest / slope) / path.strain.back();
}

}  // namespace

std::string_view to_string(Feature feature) { return kNames[static_cast<std::size_t>(feature)].name; }
std::string_view in_words(Feature feature) { return kNames[static_cast<std::size_t>(feature)].words; }

bool is_curve_stress(Feature f) {
  return f == Feature::log_toughness || f == Feature::log_tangent_10 || f == Feature::log_tangent_30 ||
         f == Feature::log_tangent_50 || f == Feature::log_peak || f == Feature::log_unloading;
}

Result<Feature> feature_from_string(std::string_view name) {
  for (int i = 0; i < kFeatureCount; ++i) {
    if (kNames[i].name == name) return static_cast<Feature>(i);
  }
  return fail("unknown feature '{}'", name);
}

FeatureValues fracture_features(const tester::Curve& curve, const CurveReading& reading) {
  FeatureValues values;
  tester::Curve forward = measurement::forward_part(curve);
  if (forward.size() < 4 || !(tester::area_under(forward) > 0.0)) return values;
  const auto points = static_cast<std::size_t>(reading.fracture_points);
  if (forward.size() > points) forward = tester::resampled(forward, points);
  const std::optional<Rise> rise = rise_of(forward);
  if (!rise) return values;
  put_rise(values, *rise);
  const double energy = tester::area_under(forward);
  value_of(values, Feature::log_toughness) = std::log(energy);
  value_of(values, Feature::tail) = 1.0 - tester::area_under(rise->path) / energy;
  std::size_t half = rise->path.size() - 1;
  while (half + 1 < forward.size() && forward.stress_pa[half] > 0.5 * rise->peak_pa) ++half;
  value_of(values, Feature::drop) =
      std::log(reading.drop_offset + (forward.strain[half] - rise->peak_strain) / rise->peak_strain);
  return values;
}

FeatureValues tensile_features(const tester::Curve& curve, const CurveReading& reading, std::optional<double> up_to) {
  FeatureValues values;
  tester::Curve forward = measurement::forward_part(curve);
  if (up_to) forward = tester::cut_at(forward, *up_to);
  forward = smoothed(forward, reading);
  const std::optional<Rise> rise = rise_of(forward);
  if (!rise) return values;
  put_rise(values, *rise);
  value_of(values, Feature::log_peak_strain).reset();
  const double scale = rise->strain_at(0.3);
  if (const auto& toe = value_of(values, Feature::toe_strain); toe && scale > 0.0)
    value_of(values, Feature::toe_share) = *toe / scale;
  value_of(values, Feature::toe_strain).reset();
  if (const double energy = tester::area_under(forward); energy > 0.0)
    value_of(values, Feature::knee) = std::log(energy / (0.5 * rise->peak_pa * forward.strain.back()));
  put_unloading(values, curve, reading);
  return values;
}

void put_pauses(FeatureValues& values, const measurement::PauseReadings& pauses) {
  if (pauses.held_share && *pauses.held_share > 0.0) value_of(values, Feature::log_held) = std::log(*pauses.held_share);
  value_of(values, Feature::held_set) = pauses.set_share;
  value_of(values, Feature::dwelled_set) = pauses.dwelled_share;
}

bool is_unloaded(const tester::Curve& curve, const CurveReading& reading) {
  return first_unloading(curve, reading).has_value();
}

std::optional<double> carried_strain(const tester::Curve& curve, const CurveReading& reading) {
  if (curve.empty() || is_unloaded(curve, reading)) return std::nullopt;
  const auto peak = std::max_element(curve.stress_pa.begin(), curve.stress_pa.end());
  if (*peak <= 0.0) return std::nullopt;
  const auto parted =
      std::find_if(peak, curve.stress_pa.end(), [&](double stress) { return stress < reading.carried_share * *peak; });
  return curve.strain[static_cast<std::size_t>(std::prev(parted) - curve.stress_pa.begin())];
}

}  // namespace nacre::diagnosis
