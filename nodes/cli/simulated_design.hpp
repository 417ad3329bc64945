#pragma once
// A design that `nacre simulate` has tested, for people and as JSON (docs/FORMATS.md).

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crack/mechanisms.hpp"
#include "tester/expected_toughness.hpp"
#include "tester/modulus.hpp"

namespace nacre::cli {

/// Which specimens of every design are broken.
struct SpecimenChoice {
  int count = 1;
  int refine = 1;  ///< elements of 1/refine
  material::FailureCriterion criterion;
  double strength_cv = 0.0;

  /// Whether T is told as a mean over specimens.
  bool tells_mean() const { return count > 1 || strength_cv > 0.0; }
  /// Whether the JSON names the criterion: always, but where nothing departs from the thesis.
  bool tells_criterion() const { return tells_mean() || criterion.kind != material::CriterionKind::element; }
};

/// A design and the results of its tests.
struct SimulatedDesign {
  std::string argument;
  pattern::Design design;
  std::optional<Result<tester::ModulusResult>> modulus;
  std::vector<Result<tester::ToughnessResult>> pulled;  ///< toughness test of each specimen
  std::optional<tester::ExpectedToughness> toughness;   ///< once every specimen has broken
  std::optional<crack::CrackRecord> crack;              ///< of specimen 0
  crack::Mechanisms mechanisms;
  std::vector<double> kernel_s;  ///< processor time of each toughness test

  /// Why there is no number; empty when every test that was run succeeded.
  std::string failure() const;
};

nlohmann::ordered_json to_json(const SimulatedDesign& simulated, const SpecimenChoice& choice);

/// One line a design, below a heading.
void print_table(const std::vector<SimulatedDesign>& designs, const SpecimenChoice& choice);

}  // namespace nacre::cli
