#pragma once
// Reading a request's parameters and writing its response: what the routes of a run share.

#include <charconv>
#include <string>

#include "dashboard/http.hpp"
#include "dashboard/page_fields.hpp"

namespace nacre::dashboard {

/// Why a request is refused: a status, and a sentence for the person.
struct Refusal {
  int status;
  std::string message;
};

inline std::string parameter(const Request& request, const char* name) {
  const auto found = request.query.find(name);
  if (found == request.query.end()) throw Refusal{400, fmt::format("the parameter {} is missing", name)};
  return found->second;
}

/// A whole number from 0 to a million; errors call it `name`.
inline int number(const std::string& text, const char* name) {
  int value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size() || value < 0 || value > 1'000'000)
    throw Refusal{400, fmt::format("{}: `{}`, expected a whole number from 0 to 1000000", name, text)};
  return value;
}

template <class T>
T or_refuse(Result<T> result) {
  if (!result) throw Refusal{400, result.error().message};
  return std::move(*result);
}

Response row_response(const auto& row) { return json_response(wire::json_of(row)); }

inline Response binary(std::string bytes) {
  return {.type = "application/octet-stream", .body = std::move(bytes), .headers = {}};
}

}  // namespace nacre::dashboard
