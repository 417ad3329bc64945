#pragma once
// The device's steps on this processor: every pass over all of its threads before the next one, as a device's barriers
// have it.

#include <memory>

#include "gpu/device.hpp"

namespace nacre::gpu {

/// Element by element in the order of a device: slow, for tests.
std::unique_ptr<Device> emulated_device(int places);

}  // namespace nacre::gpu
