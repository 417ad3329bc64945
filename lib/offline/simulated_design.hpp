#pragma once
// A design that has been tested, as `nacre simulate` tells it in JSON (docs/FORMATS.md).

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crack/mechanisms.hpp"
#include "tester/expected_toughness.hpp"
#include "tester/modulus.hpp"

namespace nacre::offline {

/// Which specimens of every design are broken, and what of the model is told with them.
struct SpecimenChoice {
  int count = 1;
  int refine = 1;  ///< elements of 1/refine
  material::FailureCriterion criterion = {};
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

/// A mean over specimens of a number that each has.
double mean_of(const tester::ExpectedToughness& toughness, double tester::ToughnessResult::*number);
/// Time steps of all specimens.
std::int64_t steps_of(const tester::ExpectedToughness& toughness);
/// Separation, unless a specimen's test ended otherwise: the first such reason.
tester::EndReason end_of(const tester::ExpectedToughness& toughness);

/// The crack of a specimen and its mechanisms; elements and their order as lists.
nlohmann::ordered_json to_json(const crack::CrackRecord& crack, const crack::Mechanisms& mechanisms);
nlohmann::ordered_json to_json(const SimulatedDesign& simulated, const SpecimenChoice& choice);

}  // namespace nacre::offline
