#include "gpu/cuda.hpp"

namespace nacre::gpu {

#ifdef NACRE_HAS_CUDA

/// In cuda_device.cu. Throws DeviceLost.
std::unique_ptr<Device> make_cuda_device(int places);

Result<std::unique_ptr<Device>> cuda_device(int places) {
  try {
    return make_cuda_device(places);
  } catch (const DeviceLost& problem) {
    return fail("no CUDA device can be used: {}", problem.what());
  }
}

#else

Result<std::unique_ptr<Device>> cuda_device(int) { return fail("this nacre was built without CUDA (NACRE_CUDA)"); }

#endif

}  // namespace nacre::gpu
