#pragma once
// What goes to a task of a cluster and what comes back, as files.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::simulator_farm {

/// Test requests of one task: specs of Computes of the kind "simulate".
struct Batch {
  std::filesystem::path films;  ///< folder for films
  std::vector<std::string> specs;
};

/// What a task adds to the farm's cache for one test request.
struct BatchRecord {
  std::string key;  ///< simulation_key
  store::CachedSimulation response;
  std::optional<std::vector<tester::Break>> breaks;
  double seconds = 0.0;  ///< of the task's time
  bool operator==(const BatchRecord&) const = default;
};

/// Bytes of a batch file, closed by a checksum; they carry the version of the kernel that is to simulate.
std::string write_batch(const Batch& batch);
/// The error: damaged, or meant for another version of the kernel.
Result<Batch> read_batch(std::string_view bytes);

/// The batch's name: the hash of its bytes. A batch that is given out twice is the same batch.
std::string batch_name(std::string_view bytes);

/// Bytes of the result of the batch of that name, closed by a checksum. Curves keep the precision of the cache (float).
std::string write_batch_result(std::string_view batch, const std::vector<BatchRecord>& records);
/// The error: damaged, the result of another batch, or by another version of the kernel.
Result<std::vector<BatchRecord>> read_batch_result(std::string_view bytes, std::string_view batch);

}  // namespace nacre::simulator_farm
