#pragma once
// Ask and tell for NLopt, which calls its objective back: a search is run anew each time on the values known so far,
// until it wants a point without one.

#include <functional>
#include <optional>

#include <nlopt.hpp>

#include "optimize/batch_optimizer.hpp"

namespace nacre::optimize {

/// One run of an NLopt algorithm over the unit cube.
struct LocalSearch {
  nlopt::algorithm algorithm = nlopt::LN_BOBYQA;
  Point start;
  double step = 0.2;            ///< initial step in every coordinate
  double smallest_step = 0.01;  ///< the search ends when its steps fall below this
  int maximum_evaluations = 1000;
  std::uint64_t seed = 1;  ///< of NLopt's random numbers, for the algorithms that draw any
};

/// Value of a point, if it has one.
using KnownValues = std::function<std::optional<double>(const Point&)>;

/// The first point that the search wants and `known` has no value for; nothing when it ends on known values alone.
/// Depends on its arguments only. Safe to call from several threads (they take turns: NLopt's random numbers are
/// global).
std::optional<Point> next_unknown(const LocalSearch& search, const KnownValues& known);

}  // namespace nacre::optimize
