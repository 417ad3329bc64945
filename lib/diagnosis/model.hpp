#pragma once
// The forward model f(u): features of every row as a function of the coordinates of a fit.

#include <Eigen/Dense>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "diagnosis/coordinates.hpp"
#include "diagnosis/fracture_surface.hpp"
#include "diagnosis/observations.hpp"
#include "measurement/observe.hpp"
#include "tester/modulus_probe.hpp"

namespace nacre::diagnosis {

/// The testers as a function of coordinates over the rows of a data set, measurement side included: moduli of layouts
/// by the static tester itself, coupons by the material point, fracture tests by the emulator. A value: copies share
/// the moduli that they remember. Thread-safe.
class FeatureModel {
 public:
  /// Of the observations it keeps groups and rows; without a surface fracture rows are predicted as 0.
  FeatureModel(Observations observations, Basis basis, tester::Fidelity fidelity,
               std::shared_ptr<const FractureSurface> surface = nullptr);
  /// The same with a surface that has learnt more, or with other ranges.
  FeatureModel with_surface(std::shared_ptr<const FractureSurface> surface) const;
  FeatureModel with_basis(Basis basis) const;
  const Basis& basis() const { return basis_; }
  const FractureSurface* surface() const { return surface_.get(); }
  int size() const { return observations_.size(); }  ///< rows
  CoordinateMap map(std::span<const std::string> effects) const { return CoordinateMap(basis_, effects); }
  CoordinateMap base_map() const { return CoordinateMap(basis_, {}); }
  /// Predicted features, rows x coordinate vectors; all cores. Throws std::runtime_error when a simulation is
  /// impossible.
  Eigen::MatrixXd predict(const CoordinateMap& map, std::span<const Eigen::VectorXd> u) const;
  Eigen::VectorXd predict(const CoordinateMap& map, const Eigen::VectorXd& u) const {
    return predict(map, std::span(&u, 1));
  }
  /// Columns d row / d coordinate at u by one-sided differences of size `step` that stay inside the bounds;
  /// `predicted`: the rows at u. Moduli of layouts need one solution each for all coordinates (tester::ModulusProbe).
  Eigen::MatrixXd slopes(const CoordinateMap& map, const Eigen::VectorXd& u, const Eigen::VectorXd& predicted,
                         double step) const;
  /// log E(h/2) - log E(h): refined mesh less the tester's, measurement side included; 0 in rows that are no modulus of
  /// a layout.
  Eigen::VectorXd mesh_change(const CoordinateMap& map, const Eigen::VectorXd& u) const;
  /// The curve of a coupon through the machine, along the strains that were measured. Throws std::runtime_error.
  tester::Curve coupon_curve(const Observation& group, const material::ParameterSet& set) const;

 private:
  /// What the pauses of a coupon show through the machine.
  measurement::PauseReadings pauses_of(const Observation& group, const material::ParameterSet& set) const;
  measurement::PrintContext print_context(const Observation& group) const;
  tester::Simulation simulation_of(const Observation& group, const material::ParameterSet& set) const;
  /// E before the testing machine, remembered.
  double modulus(std::size_t group, const material::ParameterSet& set) const;
  /// The same of a layout on elements of half the size.
  double refined_modulus(std::size_t group, const material::ParameterSet& set) const;
  /// The probe of a layout there: that of the last solution of some group where it is the same.
  std::shared_ptr<const tester::ModulusProbe> probe(std::size_t group, const material::ParameterSet& set) const;
  /// What is known under a key, or else computed; several threads may compute it at once.
  double remembered(const std::string& key, const std::function<double()>& compute) const;
  void put_group(std::size_t group, const material::ParameterSet& set, Eigen::Ref<Eigen::VectorXd> rows) const;
  void put_modulus(std::size_t group, double modulus_pa, const material::ParameterSet& set,
                   Eigen::Ref<Eigen::VectorXd> rows) const;
  /// Whether a pulled coupon shows the same with both.
  bool shows_the_same(const Observation& group, const material::ParameterSet& a, const material::ParameterSet& b) const;
  /// Coordinates whose rows are known.
  struct KnownRows {
    const Eigen::VectorXd& u;
    const Eigen::VectorXd& rows;
  };
  /// All rows at `u` but those of moduli of layouts. Coupons that show there what they show at `near` are not pulled.
  void predict_others(const CoordinateMap& map, std::span<const Eigen::VectorXd> u, Eigen::Ref<Eigen::MatrixXd> y,
                      const KnownRows* near = nullptr) const;
  void put_history(const material::ParameterSet& set, Eigen::Ref<Eigen::VectorXd> rows) const;
  void put_constants(const material::ModulusParameters& of_layouts, const material::ModulusParameters& of_coupons,
                     Eigen::Ref<Eigen::VectorXd> rows) const;

  struct LastProbe {
    std::string key;
    std::shared_ptr<const tester::ModulusProbe> probe;
  };
  struct Memory {
    std::mutex mutex;
    std::unordered_map<std::string, double> known;  ///< moduli before the machine but for tester::rate_factor(), by
                                                    ///< tester::elastic_key()
    std::vector<LastProbe> last;                    ///< per group
  };

  Observations observations_;
  Basis basis_;
  tester::Fidelity fidelity_;
  std::shared_ptr<const FractureSurface> surface_;
  std::vector<std::vector<int>> rows_of_group_;
  std::shared_ptr<Memory> memory_;
};

/// The curve of a homogeneous coupon as the machine records it, at the strains that it records (or is to run through).
/// The error: why the coupon cannot be pulled so.
Result<tester::Curve> coupon_through_machine(const tester::Simulation& coupon, const std::vector<double>& shown_strain,
                                             const measurement::PrintContext& context = {});

/// Blocks of base constants that these observations need, in `ranges`, stretched over what specimens of other materials
/// measured (other_materials.hpp); constants that are not searched from `start`.
Basis basis_for(const Observations& observations, const material::ParameterSet& start,
                const material::ParameterRanges& ranges, const ConstantRules& rules);

}  // namespace nacre::diagnosis
