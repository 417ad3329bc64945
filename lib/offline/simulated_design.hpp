#pragma once
// A design that has been tested, as `nacre simulate` tells it in JSON (docs/FORMATS.md).

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crack/mechanisms.hpp"
#include "tester/expected_toughness.hpp"
#include "tester/modulus.hpp"
#include "tester/specimen_numbers.hpp"
#include "tester/strength_field.hpp"

namespace nacre::offline {

/// Which specimens of every design are broken.
struct SpecimenChoice {
  std::optional<int> count;  ///< nothing: as many as a prediction of T takes, one where all are alike
  int refine = 1;            ///< elements of 1/refine
};

struct SimulateSettings {
  material::ParameterSet parameters;  ///< of unrefined elements
  tester::Fidelity fidelity = tester::Fidelity::full;
  bool modulus = true, toughness = true;  ///< which tests
  SpecimenChoice choice;

  /// Specimens of each design.
  int specimens() const {
    return choice.count.value_or(tester::specimens_differ(parameters) ? tester::kPredictionSpecimens : 1);
  }
  /// Simulations of one design.
  int tests_of_a_design() const { return (modulus ? 1 : 0) + (toughness ? specimens() : 0); }

  /// Whether T is told as a mean over specimens.
  bool tells_mean() const { return specimens() > 1 || parameters.strength_cv > 0.0; }
  /// Whether the JSON names the criterion: always, but where nothing departs from the thesis.
  bool tells_criterion() const { return tells_mean() || parameters.criterion.kind != material::CriterionKind::element; }
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
nlohmann::ordered_json to_json(const SimulatedDesign& simulated, const SimulateSettings& settings);

}  // namespace nacre::offline
