#pragma once
// What the report derives from a run's record before it is drawn: measured patterns, trivial baselines, improvement
// over homogeneous mixtures. Pa throughout.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pattern/layout.hpp"
#include "run/adopted_model.hpp"
#include "run/measured_patterns.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

using run::extensions_of;
using run::gamut_of;
using run::is_over;
using run::measured_patterns;
using run::MeasuredPattern;
using run::newest_closed_round;
using run::newest_round;
using run::predicted;

/// The homogeneous line that the newest model carries, as recorded by the testing machine.
std::vector<optimize::Performance> newest_line(const run::RunRecord& run);

/// Mean relative errors of predictions that know nothing of structure.
struct Baselines {
  int count = 0;
  std::optional<double> constant_toughness;  ///< one T for all: the one that makes its mean relative error least
  double toughness_pa = 0.0;                 ///< that T
  std::optional<double>
      linear_modulus;  ///< E linear in the rigid fraction, each design left out in turn; three designs at least
};

/// Designs as three columns of equal length.
Baselines baselines(std::span<const double> rigid_fraction, std::span<const double> modulus_pa,
                    std::span<const double> toughness_pa);
Baselines baselines(std::span<const MeasuredPattern> patterns);

/// How many times better a design is than the homogeneous line `line` (its measured points by increasing rigid
/// fraction, joined by straight lines in E and T); nothing where the line has no point at the design's E (or T). Where
/// the line passes several times, its best point counts.
struct Improvement {
  std::optional<double> modulus;    ///< E over that of the line at the same T
  std::optional<double> toughness;  ///< T over that of the line at the same E
};
Improvement improvement_over(std::span<const optimize::Performance> line, const optimize::Performance& design);

/// A measured design and its gain over homogeneous mixtures.
struct ComparedDesign {
  MeasuredPattern measured;
  Improvement gain;
};

/// At most about `most` points: all of the Pareto front, and every k-th of the others.
std::vector<optimize::Performance> thinned(std::span<const optimize::Performance> points, std::size_t most);

/// The measured values of a design named in a message; nullptr when not measured.
const MeasuredPattern* find_measured(std::span<const MeasuredPattern> patterns, std::string_view design);

}  // namespace nacre::report
