#pragma once
// Who may send requests: checked before a request's body is read.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/http.hpp"

namespace nacre::dashboard {

inline constexpr std::size_t kMostBodyBytes = 4u << 20;  ///< of JSON; of files kMostUploadBytes (upload.hpp)

struct AccessRules {
  /// The server's names in a Host header, with its port; one without a port passes with any. Any other name belongs to
  /// a foreign page whose name was made to point here (DNS rebinding). `localhost`, `127.0.0.1` and `[::1]` pass with
  /// any port, as a tunnel has its own; an address (digits, dots, colons, brackets) passes when a token is required.
  std::vector<std::string> hosts;
  std::string token;        ///< empty: anybody who reaches the port may look
  std::string cookie_name;  ///< under which a browser keeps the token
};

/// The names in Host headers of a server that listens to `host`.
std::vector<std::string> host_names(const std::string& host, int port);

/// The link that a browser opens, `http://HOST:PORT/`, with the token. A server that listens to every address has the
/// name of its machine.
std::string page_link(const std::string& host, int port, const std::string& token);

/// 128 random bits of the system, in hex.
std::string random_token();

/// The response to a request that is refused; nothing when it is let in. Of a body only its announced size is known:
/// - Host is one of the server's names, else 421;
/// - with a token: a cookie or `Authorization: Bearer` holds it, else 401. `GET /?token=...` gets the cookie and a
/// redirection;
/// - GET, HEAD and POST, else 405;
/// - a POST is JSON, or files at kImportPath, of a stated length, not compressed, and carries `X-Nacre: 1`, which a
/// form or an image of a foreign page cannot send; where
///   the browser says where it comes from (Origin, Sec-Fetch-Site), that is this page. Else 403, 411, 413 or 415.
std::optional<Response> refused(const AccessRules& rules, const Request& request);

}  // namespace nacre::dashboard
