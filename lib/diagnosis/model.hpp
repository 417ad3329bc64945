#pragma once

#include <Eigen/Dense>
#include <mutex>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "diagnosis/observations.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {

/// The free base parameters of the modulus side: e_tb, e_vw, e_if, nu_tb, nu_vw, nu_if (gamma has no effect on a static test).
inline constexpr int kBaseCount = 6;

/// One parameter of one effect.
struct EffectCoordinate {
  const material::Effect* effect = nullptr;
  int parameter = 0;
};

/// Coordinates of a fit: the base parameters in the unit cube of their ranges widened three-fold (moduli in log scale), then one
/// coordinate per effect parameter, scaled by the largest size that the library allows.
class CoordinateMap {
 public:
  explicit CoordinateMap(std::span<const std::string> effects);
  int size() const { return kBaseCount + static_cast<int>(extension_.size()); }
  const std::vector<std::string>& effects() const { return effects_; }
  double lower(int i) const;
  double upper(int i) const;
  /// Physical value of coordinate i at u.
  double value(int i, double u) const;
  double scale(int extension_index) const;
  material::ParameterSet parameters(const Eigen::VectorXd& u) const;
  /// Base coordinates of `parameters`, moved into the ranges; extension coordinates 0.
  Eigen::VectorXd coordinates(const material::ModulusParameters& parameters) const;

 private:
  std::vector<std::string> effects_;
  std::vector<EffectCoordinate> extension_;
};

/// The modulus tester as a function of parameters over fixed specimens, measurement side included. Thread-safe; remembers what it
/// computed.
class ModulusModel {
 public:
  ModulusModel(std::vector<Observation> groups, tester::Fidelity fidelity) : groups_(std::move(groups)), fidelity_(fidelity) {}
  const std::vector<Observation>& groups() const { return groups_; }
  /// Predicted log E, groups x parameter sets; all cores. Throws std::runtime_error when a simulation is impossible.
  Eigen::MatrixXd predict(std::span<const material::ParameterSet> sets) const;
  Eigen::VectorXd predict(const material::ParameterSet& set) const { return predict(std::span(&set, 1)); }
  /// log E on elements of size h/2 less log E on the tester's elements, per group; measurement side included, not remembered.
  Eigen::VectorXd mesh_change(const material::ParameterSet& set) const;

 private:
  double log_modulus(const Observation& group, const material::ParameterSet& set) const;
  std::vector<Observation> groups_;
  tester::Fidelity fidelity_;
  mutable std::mutex mutex_;
  mutable std::unordered_map<std::string, double> known_;
};

}  // namespace nacre::diagnosis
