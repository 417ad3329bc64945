#pragma once
// Least squares of log E over the six elastic constants: the residual that a calibrated tester cannot fit.

#include <functional>
#include <vector>

#include "material/parameters.hpp"

namespace nacre::discretisation_floor {

/// log E of every design at these parameters.
using LogModuli = std::function<std::vector<double>(const material::ModulusParameters&)>;

struct ModulusRefit {
  material::ModulusParameters parameters;
  std::vector<double> residual;  ///< target - prediction at `parameters`
  int free_parameters = 0;       ///< that the designs determine
};

/// Gauss-Newton on log E over the six constants of a static tester (E in log, nu as it is, held inside [0.01,
/// 0.499]), from `start`; steps that do not lower the sum of squares are halved.
ModulusRefit refit_moduli(const std::vector<double>& target_log_e, const material::ModulusParameters& start,
                          const LogModuli& predict);

/// Derivatives of log E by the six constants at `parameters`, one column each (rows: designs).
std::vector<std::vector<double>> sensitivities(const material::ModulusParameters& parameters, const LogModuli& predict,
                                               const std::vector<double>& at_parameters);

}  // namespace nacre::discretisation_floor
