#pragma once

#include <string>
#include <vector>

namespace nacre::gpu_study {

struct Options {
  std::string fidelity = "full";
  bool emulated = false;
  int most_places = 2000;
  std::string table;
  int count = 200;                                        ///< patterns of the agreement
  std::vector<int> batches = {1, 5, 20, 100, 500, 2000};  ///< of the throughput
  double strain_limit = 0.1;                              ///< of the throughput
};

/// Device against processor's kernel, pattern by pattern, compared with the same kernel with its parameters perturbed
/// by a millionth: curves up to the first failure, initial slope, toughness. Writes `table`, prints a summary.
void run_agreement(const Options& options);

/// Seconds a specimen and element-steps a second against the size of the batch. Writes `table`.
void run_throughput(const Options& options);

}  // namespace nacre::gpu_study
