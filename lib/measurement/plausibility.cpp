#include "measurement/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/statistics.hpp"
#include "measurement/limits.hpp"

namespace nacre::measurement {
namespace {

constexpr double kLargeEnough = 0.02;  // of the largest number: below, ratios are noise
constexpr double kHigh = 0.2;          // of the largest number: a hundredfold jump and back is no noise
constexpr std::size_t kPairRows = 12;  // between there and back
constexpr double kPowerOfTen = 0.06;   // of the logarithm: how near a jump is to a power of ten

struct NamedFactor {
  std::string_view unit;
  double factor;
};

/// What a design of this rigid fraction may show. A notched composite lies anywhere between its materials.
struct Usual {
  Limits modulus_pa, peak_pa, failure_strain;
};

Usual usual_of(const UnitEvidence& evidence) {
  constexpr double kPure = 0.01;
  constexpr Usual kRigid{{0.3e9, 6e9}, {2e6, 2e8}, {1e-3, 0.7}}, kSoft{{5e4, 1e7}, {1e4, 1e7}, {0.05, 6.0}},
      kAny{{1e5, 6e9}, {1e4, 2e8}, {1e-3, 4.0}};
  if (evidence.is_homogeneous && evidence.rigid_fraction > 1.0 - kPure) return kRigid;
  if (evidence.is_homogeneous && evidence.rigid_fraction < kPure) return kSoft;
  return kAny;
}

double power_of_ten(double from, double to) {
  const double power = std::log10(std::abs(to / from)), nearest = std::round(power);
  return nearest != 0.0 && std::abs(power - nearest) < kPowerOfTen ? nearest : 0.0;
}

std::string heading_of(const TesterRecord& record, Quantity quantity) {
  return record.column(quantity) ? record.column(quantity)->heading : std::string(to_string(quantity));
}

std::optional<ImportFault> jump_fault(const TesterRecord& record, Quantity quantity, const std::vector<double>& values,
                                      bool once, const std::string& file) {
  const auto at = decimal_jump(values, once);
  if (!at) return std::nullopt;
  return ImportFault{
      file, record.line[*at], heading_of(record, quantity),
      fmt::format("{} jumps from {:.5g} to {:.5g}, by a power of ten from one row to the next: were decimal "
                  "marks lost in a spreadsheet? expected the machine's own export",
                  to_string(quantity), values[*at - 1], values[*at])};
}

bool is_among(const Usual& usual, const UnitEvidence& evidence, double extension, double force) {
  return usual.modulus_pa.hold(evidence.modulus_pa * force / extension) &&
         usual.peak_pa.hold(evidence.peak_pa * force) && usual.failure_strain.hold(evidence.failure_strain * extension);
}

/// The clock is assumed to run in seconds where only then the speed is a testing machine's.
void assume_time(const TesterRecord& record, const UnitEvidence& evidence, AssumedUnits& units) {
  constexpr Limits kMmPerMinute{0.05, 1000.0};
  constexpr double kMinute = 60.0, kMillisecond = 1e-3;
  const double speed = 60.0 * evidence.speed_per_s * units.extension_factor;
  const bool seconds = kMmPerMinute.hold(speed);
  const bool others = kMmPerMinute.hold(speed / kMinute) || kMmPerMinute.hold(speed / kMillisecond);
  const std::string column = heading_of(record, Quantity::time);
  if (seconds && !others) {
    units.said.push_back(
        fmt::format("column `{}` has no unit that is read; s is assumed: only then the speed, {:.3g} "
                    "mm/min, is a testing machine's",
                    column, speed));
    return;
  }
  units.time_factor = 0.0;
  units.said.push_back(
      fmt::format("column `{}` has no unit that is read, and its numbers do not tell it; the clock is "
                  "not used: expected the column `unit` in the sheet (s, ms, min)",
                  column));
}

}  // namespace

bool lacks_unit(const TesterRecord& record, Quantity quantity) {
  return record.column(quantity) && record.column(quantity)->unit.empty();
}

std::optional<std::size_t> decimal_jump(const std::vector<double>& values, bool once) {
  if (values.size() < 3) return std::nullopt;
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  std::optional<std::size_t> up, pair;
  double usual_step = 0.0, most_step = 0.0;  // mean step and the largest but the jumps
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double from = values[i - 1], to = values[i];
    const bool large = std::max(std::abs(from), std::abs(to)) > kLargeEnough * largest;
    const double power = large && from * to > 0.0 ? power_of_ten(from, to) : 0.0;
    const double step = std::abs(to - from);
    const bool sudden = i > 3 && step > 10.0 * std::max(most_step, usual_step);
    if (power != 0.0 && up && power * power_of_ten(values[*up - 1], values[*up]) < 0.0) return up;
    if (std::abs(power) > 1.0 && std::max(std::abs(from), std::abs(to)) > kHigh * largest) {
      if (pair && i - *pair <= kPairRows && power * power_of_ten(values[*pair - 1], values[*pair]) < 0.0) return pair;
      pair = i;
    }
    if (power != 0.0 && sudden) {
      if (once && power > 0.0 && std::abs(from) > kLargeEnough * largest) return i;
      up = i;
      continue;
    }
    most_step = std::max(most_step, step);
    usual_step += (step - usual_step) / static_cast<double>(i);
  }
  return std::nullopt;
}

std::optional<ImportFault> implausible_record(const TesterRecord& record, const std::string& file) {
  const bool has_extension = !record.extension_mm.empty();
  const auto& extension = has_extension ? record.extension_mm : record.strain;
  const auto& force = record.force_n.empty() ? record.stress_pa : record.force_n;
  const Quantity abscissa = has_extension ? Quantity::extension : Quantity::strain;
  const Quantity ordinate = record.force_n.empty() ? Quantity::stress : Quantity::force;
  if (range_of(force) == 0.0)
    return ImportFault{file, record.line.front(), heading_of(record, ordinate),
                       fmt::format("the {} does not move, expected another column, named in the sheet as {}_column",
                                   to_string(ordinate), to_string(ordinate))};
  if (range_of(extension) == 0.0)
    return ImportFault{file, record.line.front(), heading_of(record, abscissa),
                       fmt::format("the {} does not move, expected another column, named in the sheet as {}_column",
                                   to_string(abscissa), to_string(abscissa))};
  if (auto fault = jump_fault(record, abscissa, extension, true, file)) return fault;
  if (auto fault = jump_fault(record, ordinate, force, true, file)) return fault;
  const auto peak = static_cast<std::size_t>(std::max_element(force.begin(), force.end()) - force.begin());
  const double least = *std::min_element(force.begin(), force.end());
  constexpr double kLoaded = 0.05;  // of the peak: before, the grips may have moved either way
  std::size_t begin = peak;
  while (begin > 0 && force[begin - 1] > kLoaded * force[peak]) --begin;
  const std::vector<double> loading(extension.begin() + static_cast<std::ptrdiff_t>(begin),
                                    extension.begin() + static_cast<std::ptrdiff_t>(peak) + 1);
  const double moved = loading.back() - loading.front();
  if (force[peak] > 0.0 && -least < force[peak] && loading.size() > 2 && moved < -0.5 * range_of(loading)) {
    return ImportFault{
        file, record.line[peak], heading_of(record, abscissa),
        fmt::format("the {} falls from {:.5g} to {:.5g} while the force rises: the position counts "
                    "downwards; expected a column that grows in tension, named in the sheet as {}_column{}",
                    to_string(abscissa), loading.front(), loading.back(), to_string(abscissa),
                    has_extension ? ", or the same with a minus sign before its name (`-Position (mm)`)" : "")};
  }
  return std::nullopt;
}

namespace {

/// Row at which the force falls from well above zero to zero at once and is borne again later: nothing that breaks
/// does.
std::optional<std::size_t> zeroed_at(const std::vector<double>& stress_pa, double peak_pa) {
  constexpr double kZero = 0.02, kLoaded = 0.1, kBorneAgain = 0.2;  // of the peak
  for (std::size_t i = 1; i < stress_pa.size(); ++i) {
    if (stress_pa[i - 1] < kLoaded * peak_pa || std::abs(stress_pa[i]) > kZero * peak_pa) continue;
    if (*std::max_element(stress_pa.begin() + static_cast<std::ptrdiff_t>(i), stress_pa.end()) > kBorneAgain * peak_pa)
      return i;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> doubts_of_course(const std::vector<double>& stress_pa) {
  constexpr double kNegative = 0.02, kShareAtLimit = 0.05;  // of the peak; of the rows
  constexpr std::ptrdiff_t kRowsAtLimit = 10;
  std::vector<std::string> doubts;
  const auto peak = std::max_element(stress_pa.begin(), stress_pa.end());
  if (peak == stress_pa.end() || !(*peak > 0.0)) return doubts;
  const double least = *std::min_element(stress_pa.begin(), peak + 1);
  if (-least > kNegative * *peak)
    doubts.push_back(
        fmt::format("the force falls to {:.0f} % of its peak before it: was it not set to zero, or did signs "
                    "get lost?",
                    100.0 * least / *peak));
  if (const auto row = zeroed_at(stress_pa, *peak))
    doubts.push_back(
        fmt::format("the force falls from {:.0f} % of its peak to zero at once and rises again: was it set to zero "
                    "during the pull, or do two tests stand in one record?",
                    100.0 * stress_pa[*row - 1] / *peak));
  const auto left = std::find_if(peak, stress_pa.end(), [&](double value) { return value != *peak; });
  if (left - peak >= kRowsAtLimit &&
      static_cast<double>(left - peak) > kShareAtLimit * static_cast<double>(stress_pa.size()))
    doubts.push_back(
        fmt::format("the force stays at its largest value for {} rows: is the load cell at its limit?", left - peak));
  return doubts;
}

tl::expected<AssumedUnits, std::string> assumed_units(const TesterRecord& record, const UnitEvidence& evidence) {
  constexpr std::array kLengths = {NamedFactor{"mm", 1.0}, NamedFactor{"m", 1e3}, NamedFactor{"in", 25.4},
                                   NamedFactor{"um", 1e-3}};
  constexpr std::array kForces = {NamedFactor{"N", 1.0}, NamedFactor{"kN", 1e3}, NamedFactor{"kgf", 9.80665},
                                  NamedFactor{"lbf", 4.4482216152605}};
  AssumedUnits units;
  const bool no_length = lacks_unit(record, Quantity::extension), no_force = lacks_unit(record, Quantity::force);
  const Usual usual = usual_of(evidence);
  std::vector<std::string> fitting;
  for (const NamedFactor& length : kLengths) {
    for (const NamedFactor& force : kForces) {
      if ((!no_length && length.unit != "mm") || (!no_force && force.unit != "N")) continue;
      const bool imperial = length.unit == "in", pounds = force.unit == "lbf";
      if (no_length && no_force && imperial != pounds) continue;  // nobody mixes them
      if (!is_among(usual, evidence, length.factor, force.factor)) continue;
      fitting.push_back(no_length && no_force ? fmt::format("{} and {}", length.unit, force.unit)
                                              : std::string(no_length ? length.unit : force.unit));
      units.extension_factor = length.factor;
      units.force_factor = force.factor;
    }
  }
  if (no_length || no_force) {
    const std::string columns =
        no_length && no_force
            ? fmt::format("columns `{}` and `{}` have", heading_of(record, Quantity::extension),
                          heading_of(record, Quantity::force))
            : fmt::format("column `{}` has", heading_of(record, no_length ? Quantity::extension : Quantity::force));
    if (fitting.size() != 1)
      return tl::unexpected(
          fmt::format("{} no unit that is read, and {} of the usual ones would make a plausible test; "
                      "expected the unit in the heading, or the column `unit` in the sheet (as `mm N`)",
                      columns, fitting.empty() ? "none" : "several"));
    units.said.push_back(
        fmt::format("{} no unit that is read; {} is assumed: with no other usual one the modulus and the "
                    "strength are those of the material",
                    columns, fitting.front()));
  }
  if (lacks_unit(record, Quantity::time)) assume_time(record, evidence, units);
  return units;
}

}  // namespace nacre::measurement
