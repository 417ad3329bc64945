#pragma once
// The sockets; server.cpp alone includes the HTTP library.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dashboard/guard.hpp"

namespace nacre::dashboard {

inline constexpr int kUsualPort = 8765;

struct ServerSettings {
  std::string host = "127.0.0.1";
  std::optional<int> port;  ///< 0: any free one; nothing: kUsualPort, or a free one where it is taken
  std::string token;        ///< see AccessRules
  std::vector<std::string> further_hosts = {};  ///< names that a tunnel or a proxy keeps, with or without a port
};

/// Serves what `respond` says, called from any number of threads, until `stop` returns true (called ten times a
/// second). `ready` gets the port. Bodies have at most 4 MiB, files 64 MiB; a request of which nothing comes for five
/// seconds is cut off. Throws InputError when it cannot listen there.
void serve(const std::function<Response(const Request&)>& respond, const ServerSettings& settings,
           const std::function<void(int port)>& ready, const std::function<bool()>& stop);

}  // namespace nacre::dashboard
