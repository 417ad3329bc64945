#pragma once
// Evaluations requested from the farm, and their responses put together again.

#include <map>
#include <string>
#include <vector>

#include "sysid/calibration.hpp"
#include "sysid/prediction.hpp"
#include "sysid/wanted_evaluation.hpp"
#include "wire/convert.hpp"

namespace nacre::runtime {

/// Evaluations that are requested at once.
struct FarmBatch {
  std::string requester;  ///< name of the node
  std::string label;      ///< of request ids, before the evaluation's own: batches that share it hold other evaluations
  std::vector<sysid::WantedEvaluation> wanted;
  std::vector<measurement::Replicates> measured;  ///< the designs that `wanted` means, with their test conditions
  tester::Fidelity fidelity = tester::Fidelity::full;
  int curve_points = 64;  ///< of toughness tests: enough for the curve term of Eq. 2.8
};

/// One batch of evaluations at the farm. Responses may come in any order and any number of times; what predictions()
/// holds does not depend on it.
class FarmRequests {
 public:
  /// SIMULATE requests for the batch: items of one evaluation that share test conditions go together, at most 64 a
  /// request. Request ids are `REQUESTER/LABEL/EVALUATION/PART#HASH` (wire::with_content_id).
  std::vector<wire::SimulateRequest> ask(const FarmBatch& batch);

  /// Takes a SIMULATED. Returns whether the batch is complete with it.
  bool take(wire::SimulateResult part);

  /// Of each evaluation of the batch, one prediction per item; empty where the simulation failed.
  const std::vector<std::vector<sysid::Prediction>>& predictions() const { return predictions_; }

 private:
  struct Place {
    std::size_t evaluation = 0;
    std::vector<std::size_t> items;  // positions within the evaluation
    bool modulus = false;
    bool toughness = false;
  };
  std::map<std::string, Place> open_;  // by request id
  wire::ResponseCollector collector_;
  std::vector<std::vector<sysid::Prediction>> predictions_;
};

}  // namespace nacre::runtime
