#pragma once
// Residual networks on the quarter of a pattern (Figure 2-10), and predictors made of them. The networks live in a
// library of their own that is loaded when the first one is made, so that no other program needs libtorch.

#include <cstdint>
#include <memory>
#include <vector>

#include "surrogate/patch_process.hpp"
#include "surrogate/predictor.hpp"
#include "thesis/constants.hpp"

namespace nacre::surrogate {

/// Architecture and training of one network; the defaults are those of 2.3.3 for toughness.
struct NetworkSettings {
  int channels = 16;                                       ///< [open]
  int residual_blocks = thesis::kToughnessResidualBlocks;  ///< two 3 x 3 convolutions each; 2 for the modulus
  double dropout = 0.2;  ///< before the fully connected layer [open: its rate]; 0 for the modulus
  double weight_decay = thesis::kToughnessWeightDecay;  ///< 1e-6 for the modulus
  double learning_rate = thesis::kLearningRate;
  int epochs = thesis::kToughnessEpochs;  ///< 100 for the modulus
  int batch = thesis::kTrainingBatch;     ///< at most
  std::uint64_t seed = 1;
};

/// Inputs in a row-major array of count x 100 values (0 soft, 1 rigid; the quarter's rows from the top).
class Network {
 public:
  virtual ~Network() = default;
  /// `epochs` passes of Adam over the samples, single-threaded, all randomness from the settings' seed and the number
  /// of passes so far. Targets should be standardised.
  virtual void train(const std::vector<float>& quarters, const std::vector<float>& targets, int epochs) = 0;
  virtual std::vector<float> evaluate(const std::vector<float>& quarters) = 0;
  /// An equal network with the same weights, to be trained further.
  virtual std::unique_ptr<Network> clone() const = 0;
};

/// Whether this build has networks (CMake found libtorch).
bool networks_available();

/// Throws InputError when this build has no networks.
std::unique_ptr<Network> make_network(const NetworkSettings& settings);

struct EnsembleSettings {
  NetworkSettings network;
  int members = 1;            ///< networks that differ by their seeds; their disagreement is the uncertainty
  bool warm_start = false;    ///< see fit_ensemble()
  double warm_epochs = 0.15;  ///< share of the epochs that a warm start goes on for
};

/// An ensemble fitted to the samples. With a warm start the members are trained in full on the first `settled` samples
/// and go on from there with all of them for a share of the epochs; the former are remembered, so that while `settled`
/// stays, only the latter costs. A function of its arguments all the same. Throws InputError when this build has no
/// networks.
std::unique_ptr<Predictor> fit_ensemble(const Samples& samples, std::size_t settled, const EnsembleSettings& settings);

}  // namespace nacre::surrogate
