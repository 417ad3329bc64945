#include "diagnosis/test_drift.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/statistics.hpp"
#include "measurement/conditions.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/summary.hpp"
#include "measurement/surroundings.hpp"

namespace nacre::diagnosis {
namespace {

using measurement::SpecimenRecord;

struct Point {
  double order = 0.0, log_modulus = 0.0;
};
/// By design, batch and conditions.
using Cells = std::map<std::string, std::vector<Point>>;

std::optional<double> order_of(const SpecimenRecord& specimen) {
  const auto found = specimen.other_columns.find(std::string(measurement::kTestOrderColumn));
  if (found == specimen.other_columns.end()) return std::nullopt;
  const Result<double> number = number_from_text(trimmed(found->second));
  return number ? std::optional(*number) : std::nullopt;
}

std::map<std::string, Cells> cells_of_machines(const std::vector<SpecimenRecord>& specimens) {
  std::map<std::string, Cells> machines;
  for (const SpecimenRecord& s : measurement::at_nominal_conditions(specimens)) {
    const auto order = order_of(s);
    const auto modulus = measurement::modulus_of(s);
    if (!s.valid || s.test != tester::TestKind::modulus || !order || !modulus || *modulus <= 0.0) continue;
    const measurement::Surroundings surroundings = measurement::surroundings_of(s);
    const std::string cell =
        fmt::format("{}\n{}\n{} {} {}\n{}", s.design.name(), s.batch, s.conditions.orientation_deg,
                    s.conditions.strain_rate_per_s, s.conditions.thickness_mm, nominal_surroundings(surroundings));
    machines[surroundings.machine][cell].push_back({*order, std::log(*modulus)});
  }
  return machines;
}

std::optional<TestDrift> drift_of(const Cells& cells) {
  double xx = 0.0, xy = 0.0, yy = 0.0, first = INFINITY, last = -INFINITY;
  int tests = 0;
  for (const auto& [name, points] : cells) {
    Point mean;
    for (const Point& p : points) {
      mean.order += p.order / static_cast<double>(points.size());
      mean.log_modulus += p.log_modulus / static_cast<double>(points.size());
      first = std::min(first, p.order), last = std::max(last, p.order);
    }
    for (const Point& p : points) {
      const double x = p.order - mean.order, y = p.log_modulus - mean.log_modulus;
      xx += x * x, xy += x * y, yy += y * y;
    }
    tests += static_cast<int>(points.size());
  }
  const int freedom = tests - static_cast<int>(cells.size()) - 1;
  if (!(xx > 0.0) || freedom < 1) return std::nullopt;
  constexpr double kLeastSd = 1e-6, kOutside = 0.10;
  const double slope = xy / xx, sd = std::max(kLeastSd, std::sqrt(std::max(0.0, yy - xy * slope) / freedom)),
               error = sd / std::sqrt(xx), half = student_quantile(kOutside, freedom) * error, span = last - first;
  return TestDrift{.machine = "",
                   .tests = tests,
                   .ratio = std::exp(slope * span),
                   .low = std::exp((slope - half) * span),
                   .high = std::exp((slope + half) * span),
                   .chance = student_beyond(slope / error, freedom)};
}

}  // namespace

std::vector<TestDrift> test_drifts(const std::vector<SpecimenRecord>& specimens) {
  std::vector<TestDrift> drifts;
  for (const auto& [machine, cells] : cells_of_machines(specimens)) {
    std::optional<TestDrift> drift = drift_of(cells);
    if (!drift) continue;
    drift->machine = machine;
    drifts.push_back(*std::move(drift));
  }
  for (TestDrift& drift : drifts) drift.chance = std::min(1.0, drift.chance * static_cast<double>(drifts.size()));
  return drifts;
}

std::string in_words(const std::vector<TestDrift>& drifts) {
  constexpr double kSure = 0.01;
  std::string words;
  for (const TestDrift& drift : drifts) {
    if (drift.chance >= kSure) continue;
    words += fmt::format(
        " Caution: where all else is equal, moduli{} drift with the order of the tests: the last of {} is {:.3g} times "
        "the first (90 % interval {:.3g} to {:.3g}). No model here knows that; it adds to the scatter, and what was "
        "tested early or late looks otherwise.",
        drift.machine.empty() ? "" : fmt::format(" of the machine \"{}\"", drift.machine), drift.tests, drift.ratio,
        drift.low, drift.high);
  }
  return words;
}

}  // namespace nacre::diagnosis
