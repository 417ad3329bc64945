#pragma once

#include <memory>
#include <vector>

#include "sysid/fit.hpp"

namespace nacre::sysid {

/// Several fits side by side, each asked for its own batch; the best trial of all counts.
std::unique_ptr<ParameterFit> make_parallel_fit(std::vector<std::unique_ptr<ParameterFit>> fits);

}  // namespace nacre::sysid
