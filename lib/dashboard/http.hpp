#pragma once
// Requests and responses as values: routes are functions of them and know nothing of sockets.

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace nacre::dashboard {

/// Where files are handed in; all other bodies are JSON.
inline constexpr std::string_view kImportPath = "/api/import";

/// A part of a multipart body.
struct Part {
  std::string name;
  std::string file_name;  ///< empty: it is no file
  std::string content;
};

struct Request {
  std::string method;
  std::string path;                            ///< decoded, without query
  std::map<std::string, std::string> query;    ///< decoded; of a name that occurs twice, the first
  std::map<std::string, std::string> headers;  ///< names in lower case; of a name that occurs twice, the first
  std::string body;
  std::vector<Part> parts = {};  ///< in place of a body

  /// The header's value; empty when absent.
  std::string header(const std::string& lower_case_name) const;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  /// In place of a body: hands its bytes to `send` as they come, until that returns false. May throw InputError, which
  /// cuts the response off.
  std::function<void(const std::function<bool(std::string_view)>& send)> stream = {};
};

/// Numbers that are not finite become null, bytes that are not UTF-8 a replacement sign.
Response json_response(const nlohmann::ordered_json& document, int status = 200);

/// `{"error": message}`
Response error_response(int status, const std::string& message);

}  // namespace nacre::dashboard
