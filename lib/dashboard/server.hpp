#pragma once
// The socket side: the only file that knows the HTTP library is server.cpp.

#include <functional>
#include <string>

#include "dashboard/dashboard.hpp"
#include "dashboard/guard.hpp"

namespace nacre::dashboard {

struct ServerSettings {
  std::string host = "127.0.0.1";
  int port = 8765;    ///< 0: any free one
  std::string token;  ///< see AccessRules
};

/// Serves until `stop` returns true (asked ten times a second). `ready` is told the port. Bodies are at most 4 MiB,
/// requests slower than five seconds are cut off. Throws InputError when the port cannot be had.
void serve(Dashboard& dashboard, const ServerSettings& settings, const std::function<void(int port)>& ready,
           const std::function<bool()>& stop);

}  // namespace nacre::dashboard
