#pragma once
// The interface to what computes the steps of a batch of specimens: an accelerator, or this processor in its place
// (emulated_device.hpp). For host code and for CUDA's compiler, which cannot compile fmt: nothing here includes
// base/result.hpp.

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/specimen_image.hpp"

namespace nacre::gpu {

/// Forces on the grips in every step of a chunk, in the state's unit, tension positive.
struct Reactions {
  float bottom[kChunkSteps] = {}, top[kChunkSteps] = {};
};

/// State of a place of the batch after a chunk.
struct PlaceReport {
  Reactions reactions;
  std::int32_t inverted = -1;  ///< an element that failed with J <= 0 or not a number; -1: none
};

/// Places for specimens, all of which make the same number of steps at a time. Not thread-safe. Throws DeviceLost when
/// the device can no longer be used.
class Device {
 public:
  virtual ~Device() = default;
  virtual std::string name() const = 0;
  /// Memory that specimens may take, bytes.
  virtual std::size_t free_bytes() const = 0;
  /// Puts a specimen into a free place, 0 to places - 1; it begins with the next chunk.
  virtual void load(int place, const SpecimenImage& image) = 0;
  /// Frees a place.
  virtual void unload(int place) = 0;
  /// Starts kChunkSteps steps of every specimen; may return before they are done.
  virtual void advance() = 0;
  /// The places after the last chunk; waits for it.
  virtual std::vector<PlaceReport> reports() = 0;
  /// Steps, counted from 0, in which the elements of a place failed, -1 for intact ones; by element of the grid.
  virtual std::vector<std::int32_t> failed_at(int place) = 0;
};

struct DeviceLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace nacre::gpu
