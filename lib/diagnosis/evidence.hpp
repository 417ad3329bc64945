#pragma once
// The evidence of a decision: data with base model and base + one effect (and pairs, when needed) fitted jointly, and
// the chances of what was found. Chi squared r' C^-1 r with the covariance C of scatter, discretisation floor and
// emulator.

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/bootstrap.hpp"
#include "diagnosis/data.hpp"

namespace nacre::diagnosis {

/// A model at some of its coordinates.
struct ModelPoint {
  std::vector<std::string> effects;
  Eigen::VectorXd u;
};

/// Everything that a decision rests on. The observations have their discretisation error, shared directions included.
struct Evidence : Data {
  DiagnosisSettings settings;
  Anchor base = {};
  std::vector<FittedModel> singles = {};        ///< one per effect
  std::vector<ModelPoint> discretisation = {};  ///< models whose change on a refined mesh gives the shared directions
  std::vector<std::vector<std::string>> factors = {};   ///< least sets whose free levels make the base fit
  std::shared_ptr<const Evidence> without_levels = {};  ///< base alone; nothing: the observations have no free levels
  DrawStatistics base_statistics = {};
  std::vector<DrawStatistics> base_draws = {};
  double p_misfit = 1.0;                   ///< chance of a misfit as large as the base's when it is true
  std::vector<double> p_family_wise = {};  ///< per effect: chance that the best of all lowers chi squared as much
  std::vector<double> p_fit = {};  ///< per effect: chance of a misfit as large when base + effect is true; 1 where no
                                   ///< name is in question, 0 too far behind the best to be tested
  std::vector<FittedModel> pairs = {};  ///< on the best effects, where no single one fits
  std::vector<double> p_pair_fit = {};  ///< per pair
};

/// Fits base and single effects and bootstraps the base. With a floor that has a common direction the fits are done
/// first with independent layouts and again with the directions along which a refined mesh moves these models. Where
/// the base misfits along a factor that no effect knows, all is done again with free levels of it. Where an effect
/// improves the fit beyond chance, the misfit of each is tested; where none fits, pairs are built on the best.
Evidence gather_evidence(const Data& data, const DiagnosisSettings& settings);

/// The base as it is, before any factor got free levels.
const Evidence& plain(const Evidence& evidence);

/// The effect of the least chi squared; at least one.
std::size_t best_single(const Evidence& evidence);

/// Whether some effect improves the fit beyond chance: a name is in question.
bool is_noticed(const Evidence& evidence);

/// Whether a model may explain the data: its residuals are noise by this level, and its effects are not at a bound.
bool is_usable(const FittedModel& fit, double p_fit, double level);

}  // namespace nacre::diagnosis
