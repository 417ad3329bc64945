#pragma once
// What every calibration speaks: ask for evaluations, hear their predictions, so that the simulations may run on the
// farm or in this process. Deterministic in its settings and in what it was told.

#include <memory>
#include <vector>

#include "measurement/summary.hpp"
#include "sysid/prediction.hpp"
#include "sysid/wanted_evaluation.hpp"

namespace nacre::sysid {

struct Calibrated;
struct CalibrationSettings;

/// A calibration in progress.
class CalibrationProtocol {
 public:
  virtual ~CalibrationProtocol() = default;
  /// Evaluations wanted next; empty when finished. The same until tell() has received them all.
  virtual const std::vector<WantedEvaluation>& wanted() const = 0;
  /// Predictions of wanted()[index], one per item of it, in order, before measurement-side extensions.
  virtual void tell(std::size_t index, const std::vector<Prediction>& predictions) = 0;
  bool finished() const { return wanted().empty(); }
  virtual double progress() const = 0;  ///< 0..1
  virtual const Calibrated& result() const = 0;
};

/// Of designs, or of base materials one by one, as settings.target says.
std::unique_ptr<CalibrationProtocol> begin_calibration(std::vector<measurement::Replicates> measured,
                                                       const CalibrationSettings& settings);

}  // namespace nacre::sysid
