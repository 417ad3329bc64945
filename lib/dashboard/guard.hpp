#pragma once
// Who may ask: judged before a request's body is read.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/http.hpp"

namespace nacre::dashboard {

struct AccessRules {
  /// Names that this server goes by in a Host header, with its port. Another name is a page of somebody else whose name
  /// was made to point here (DNS rebinding). An address (digits, dots, colons, brackets) passes when a token is asked
  /// for.
  std::vector<std::string> hosts;
  std::string token;        ///< empty: whoever reaches the port may look
  std::string cookie_name;  ///< under which a browser keeps the token
};

/// The names of a server that listens to `host`, in Host headers.
std::vector<std::string> host_names(const std::string& host, int port);

/// What a browser opens, `http://HOST:PORT/`, and the token that it brings. A server that listens to every address goes
/// by the name of its machine.
std::string page_link(const std::string& host, int port, const std::string& token);

/// 128 random bits of the system, in hex.
std::string random_token();

/// The answer to a request that is not let in; nothing when it is. Of a body only its announced size is known:
/// - Host is one of the server's names, else 421;
/// - with a token: a cookie or `Authorization: Bearer` holds it, else 401. `GET /?token=...` is answered with the
/// cookie and a redirection;
/// - GET, HEAD and POST, else 405;
/// - a POST is JSON of a stated length, not compressed, and carries `X-Nacre: 1`, which a form or an image of a foreign
/// page cannot send; where
///   the browser says where it comes from (Origin, Sec-Fetch-Site), that is this page. Else 403, 411 or 415.
std::optional<Response> refused(const AccessRules& rules, const Request& request);

}  // namespace nacre::dashboard
