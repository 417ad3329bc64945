#pragma once
// The accelerator of this machine, if nacre was built for one and one is there.

#include <memory>

#include "base/result.hpp"
#include "gpu/device.hpp"

namespace nacre::gpu {

/// Error, as a sentence: built without CUDA, no device, or one that cannot be used.
Result<std::unique_ptr<Device>> cuda_device(int places);

}  // namespace nacre::gpu
