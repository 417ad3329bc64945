#include "diagnosis/shared_discretisation.hpp"

namespace nacre::diagnosis {

Eigen::MatrixXd shared_directions(const Evidence& evidence, const FeatureModel& model) {
  Eigen::MatrixXd directions(model.size(), static_cast<Eigen::Index>(evidence.discretisation.size()));
  for (std::size_t k = 0; k < evidence.discretisation.size(); ++k) {
    const ModelPoint& point = evidence.discretisation[k];
    directions.col(static_cast<Eigen::Index>(k)) =
        evidence.settings.floor.mesh_amplitude * model.mesh_change(model.map(point.effects), point.u);
    if (k > 0) directions.col(static_cast<Eigen::Index>(k)) -= directions.col(0);
  }
  return directions;
}

Observations with_discretisation_at(const Evidence& evidence, const CoordinateMap& map, const Eigen::VectorXd& u) {
  Observations observations = evidence.observations;
  if (observations.has_shared_discretisation())
    observations.discretisation_shared = evidence.settings.floor.mesh_amplitude * evidence.model.mesh_change(map, u);
  return observations;
}

ProfileFit fit_with_own_discretisation(const Evidence& evidence, const std::vector<std::string>& effects,
                                       const Eigen::VectorXd& start, const std::vector<int>& held, double hopeless) {
  const auto fitted_from = [&](const Eigen::VectorXd& u) {
    const Observations observations = with_discretisation_at(evidence, evidence.model.map(effects), u);
    ProfileFit at{fit_model(evidence.model, observations, evidence.settings.procedure.fit, effects, u, held)};
    const Eigen::LLT<Eigen::MatrixXd> factor(observations.covariance());
    at.deviance = at.fit.chi2 + 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    return at;
  };
  ProfileFit first = fitted_from(start);
  if (!evidence.observations.has_shared_discretisation() || first.deviance > hopeless) return first;
  return fitted_from(first.fit.u);
}

}  // namespace nacre::diagnosis
