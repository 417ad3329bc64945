#pragma once
// Requests and responses as values: routes are functions of them and know nothing of sockets.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace nacre::dashboard {

struct Request {
  std::string method;
  std::string path;                            ///< decoded, without query
  std::map<std::string, std::string> query;    ///< decoded; of a name that occurs twice, the first
  std::map<std::string, std::string> headers;  ///< names in lower case; of a name that occurs twice, the first
  std::string body;

  /// The header's value; empty when absent.
  std::string header(const std::string& lower_case_name) const;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
};

/// Numbers that are not finite become null, bytes that are not UTF-8 a replacement sign.
Response json_response(const nlohmann::ordered_json& document, int status = 200);

/// `{"error": message}`
Response error_response(int status, const std::string& message);

}  // namespace nacre::dashboard
