#include "dashboard/http.hpp"

namespace nacre::dashboard {

std::string Request::header(const std::string& lower_case_name) const {
  const auto found = headers.find(lower_case_name);
  return found == headers.end() ? "" : found->second;
}

Response json_response(const nlohmann::ordered_json& document, int status) {
  return {.status = status,
          .body = document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
          .headers = {}};
}

Response error_response(int status, const std::string& message) { return json_response({{"error", message}}, status); }

}  // namespace nacre::dashboard
