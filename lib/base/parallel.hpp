#pragma once

#include <functional>

namespace nacre {

/// Number of cores this process may use (its affinity mask, at least 1).
int allowed_cores();

/// Calls body(i) for i in [0, count) on up to `threads` threads (0 = all allowed cores), handing out indices one by
/// one. The first exception thrown by a body is rethrown here after all threads have stopped.
void parallel_for(int count, const std::function<void(int)>& body, int threads = 0);

}  // namespace nacre
