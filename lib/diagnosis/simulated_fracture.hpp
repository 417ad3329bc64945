#pragma once
// A fracture test that could be added to a set, as a model breaks it.

#include <Eigen/Dense>

#include "diagnosis/coordinates.hpp"
#include "diagnosis/features.hpp"
#include "diagnosis/possible_tests.hpp"

namespace nacre::diagnosis {

/// How the fracture tests of a prediction are simulated.
struct FractureSimulation {
  tester::Fidelity fidelity = tester::Fidelity::full;
  CurveReading reading = {};
  int specimens = 1;  ///< that every model breaks alike: one crack would differ from model to model by chance
};

/// Means over the specimens, of the features that all show. None where one of them cannot be simulated.
FeatureValues mean_fracture_features(const PossibleTest& test, const material::ParameterSet& set,
                                     const FractureSimulation& simulation);

/// How they change; 0 where a feature is not shown.
struct FractureSlopes {
  Eigen::MatrixXd by_coordinate;  ///< features x coordinates, per unit
  Eigen::MatrixXd own_constants;  ///< features x sysid::kSearchedEta: by so much more of a constant, log units
};

/// By one-sided differences at `u`: a simulation for each coordinate that acts on fracture. For homogeneous specimens,
/// which break in a second. Where one of their constants is larger by `constant_sd` in log units: own_constants.
FractureSlopes fracture_slopes(const PossibleTest& test, const CoordinateMap& map, const Eigen::VectorXd& u,
                               double constant_sd, const FractureSimulation& simulation);

}  // namespace nacre::diagnosis
