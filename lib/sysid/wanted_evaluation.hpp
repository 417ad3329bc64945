#pragma once
// One parameter set that a calibration wants simulated.

#include <string>
#include <vector>

#include "material/parameters.hpp"
#include "tester/specimen_numbers.hpp"

namespace nacre::sysid {

/// The tests named, of all `items`, with these parameters.
struct WantedEvaluation {
  std::string id;  ///< unique within the calibration
  material::ParameterSet parameters;
  bool modulus = false;
  bool toughness = false;
  std::vector<std::size_t> items;  ///< indices into the measured designs
  /// T is the mean over so many specimens from that number on, where specimens differ.
  int first_specimen = tester::kSearchSpecimen;
  int specimens = 1;
  int refinement =
      1;  ///< of the elements of fracture tests (tester::Discretisation); other than 1 in this process only
};

/// An evaluation whose T is that of a prediction: the mean over specimens that nothing was chosen by.
inline WantedEvaluation as_prediction(WantedEvaluation evaluation) {
  evaluation.first_specimen = tester::kFirstPredictionSpecimen;
  evaluation.specimens = tester::kPredictionSpecimens;
  return evaluation;
}

}  // namespace nacre::sysid
