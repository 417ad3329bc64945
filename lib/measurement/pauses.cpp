#include "measurement/pauses.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/csv.hpp"
#include "base/statistics.hpp"

namespace nacre::measurement {
namespace {

constexpr double kOfTurn = 0.98, kAtTurn = 0.998, kNoForce = 0.01, kSomeForce = 0.1;

/// The strain at which the coupon is held, the middle one of the largest; else the largest.
double turn_strain(const tester::Curve& curve) {
  const double largest = *std::ranges::max_element(curve.strain);
  std::vector<double> near;
  for (const double strain : curve.strain)
    if (strain >= kOfTurn * largest) near.push_back(strain);
  const double middle = quantile(std::move(near), 0.5);
  return middle >= kAtTurn * largest ? middle : largest;
}

std::size_t first_at_turn(const tester::Curve& curve, double strain) {
  const auto at = std::ranges::find_if(curve.strain, [&](double each) { return each >= strain; });
  return static_cast<std::size_t>(at - curve.strain.begin());
}

/// The last row before the strain of the turn is left for good.
std::size_t last_at_turn(const tester::Curve& curve, double strain) {
  std::size_t last = curve.size() - 1;
  while (last > 0 && curve.strain[last] < strain) --last;
  return last;
}

/// Strain where the force has gone, on the line through the last row of some force and the first of none; nothing where
/// it stays.
std::optional<double> strain_at_no_force(const tester::Curve& curve, std::size_t from, double top_pa) {
  std::size_t some = from, none = from;
  while (none < curve.size() && curve.stress_pa[none] > kNoForce * top_pa) ++none;
  if (none == curve.size() || none == from) return std::nullopt;
  for (std::size_t i = from; i < none; ++i)
    if (curve.stress_pa[i] >= kSomeForce * top_pa) some = i;
  const double slope = (curve.strain[some] - curve.strain[none]) / (curve.stress_pa[some] - curve.stress_pa[none]);
  return curve.strain[none] - slope * curve.stress_pa[none];
}

}  // namespace

Result<tester::Loading> pauses_of(const SpecimenRecord& specimen) {
  const auto cell = specimen.other_columns.find(std::string(kLoadingColumn));
  if (specimen.test != tester::TestKind::tensile || cell == specimen.other_columns.end() ||
      trimmed(cell->second).empty())
    return tester::Loading{};
  auto loading = tester::loading_from_string(trimmed(cell->second));
  if (loading && !loading->has_pauses()) return tester::Loading{};
  return loading;
}

tester::Curve first_pull(const tester::Curve& curve) {
  if (curve.empty()) return curve;
  const std::size_t end = std::min(curve.size(), first_at_turn(curve, kAtTurn * turn_strain(curve)) + 1);
  const auto rows = static_cast<std::ptrdiff_t>(end);
  return {{curve.strain.begin(), curve.strain.begin() + rows},
          {curve.stress_pa.begin(), curve.stress_pa.begin() + rows}};
}

PauseReadings read_pauses(const tester::Curve& curve, const tester::Loading& loading) {
  PauseReadings readings;
  if (curve.size() < 2 || loading.turns.size() != 1) return readings;
  const double turn = turn_strain(curve);
  const std::size_t first = first_at_turn(curve, kAtTurn * turn), last = last_at_turn(curve, kAtTurn * turn);
  const double top_pa = *std::max_element(curve.stress_pa.begin() + static_cast<std::ptrdiff_t>(first),
                                          curve.stress_pa.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  if (!(turn > 0.0) || !(top_pa > 0.0)) return readings;
  if (!loading.holds_s.empty() && last > first) readings.held_share = curve.stress_pa[last] / top_pa;
  if (!loading.dwell_s) return readings;
  if (const auto set = strain_at_no_force(curve, last, top_pa)) {
    readings.set_share = *set / turn;
    if (*loading.dwell_s > 0.0) readings.dwelled_share = curve.strain.back() / turn;
  }
  return readings;
}

}  // namespace nacre::measurement
