#include "game/equilibrium.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace nacre::game {
namespace {

constexpr double kGapErrors = 2.0;          // (b): the gap is noise when within this many standard errors
constexpr double kGapRelativeChange = 0.1;  // (b): or when it has stopped moving

struct RoundCriteria {
  bool quiet = false;
  std::string number;  // which comparison decided
};

RoundCriteria judge_round(const RoundFigures& before, const RoundFigures& now) {
  if (before.measured_hypervolume <= 0.0) {
    return {false, fmt::format("round {} is the first with a measured hypervolume", now.round)};
  }
  const double growth = now.measured_hypervolume - before.measured_hypervolume;
  if (growth > 0.0 && growth >= now.hypervolume_error) {
    return {false,
            fmt::format("the measured hypervolume grew by {:.4g} GPa MPa in round {}, not less than its standard error "
                        "of {:.4g}",
                        growth, now.round, now.hypervolume_error)};
  }
  const double limit = kGapErrors * now.hypervolume_error;
  if (std::abs(now.signed_gap) <= limit) {
    return {true, fmt::format("the gap of {:.4g} GPa MPa in round {} lies within twice the standard error of {:.4g}",
                              now.signed_gap, now.round, now.hypervolume_error)};
  }
  const double change = std::abs(now.signed_gap - before.signed_gap);
  const double allowed = kGapRelativeChange * std::abs(before.signed_gap);
  const double percent = before.signed_gap == 0.0 ? 100.0 : 100.0 * change / std::abs(before.signed_gap);
  if (change < allowed) {
    return {true, fmt::format("the gap of {:.4g} GPa MPa in round {} changed by {:.2g} %, less than 10 %",
                              now.signed_gap, now.round, percent)};
  }
  return {false,
          fmt::format("the gap of {:.4g} GPa MPa in round {} exceeds twice the standard error of {:.4g} and changed by "
                      "{:.2g} %",
                      now.signed_gap, now.round, now.hypervolume_error, percent)};
}

}  // namespace

EquilibriumCheck judge_equilibrium(std::span<const RoundFigures> history) {
  if (history.size() < 2) return {false, "nothing has been measured yet"};
  const auto newest = history.last(2);
  const RoundCriteria now = judge_round(newest[0], newest[1]);
  if (!now.quiet) return {false, now.number};
  if (history.size() < 3) return {false, now.number + "; a second such round is needed"};
  const auto previous = history.last(3);
  const RoundCriteria earlier = judge_round(previous[0], previous[1]);
  if (!earlier.quiet) return {false, now.number + "; a second such round is needed, but " + earlier.number};
  return {true, now.number + ", as before: " + earlier.number};
}

}  // namespace nacre::game
