#pragma once

namespace nacre::runtime {

/// What a node says while it waits for a debugger; the process number follows.
inline constexpr const char* kWaitsForDebugger = "waits for a debugger: gdb -p ";

/// Says on standard output that this process waits, and returns once a debugger has attached to it. Whatever the
/// system's rule (Yama), a debugger of the same user may. Signals end the process as ever.
void wait_for_debugger();

}  // namespace nacre::runtime
