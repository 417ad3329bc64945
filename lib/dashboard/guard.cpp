#include "dashboard/guard.hpp"

#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "base/names.hpp"
#include "base/result.hpp"
#include "dashboard/upload.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::size_t kLongestPath = 512;

/// Takes as long for every text of one length.
bool same_secret(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  return difference == 0;
}

/// Value of a cookie in a Cookie header; empty when it is not there.
std::string cookie(const std::string& header, const std::string& name) {
  std::size_t begin = 0;
  while (begin < header.size()) {
    const std::size_t end = std::min(header.find(';', begin), header.size());
    const std::size_t first = header.find_first_not_of(' ', begin);
    if (first < end && header.compare(first, name.size(), name) == 0 && first + name.size() < end &&
        header[first + name.size()] == '=')
      return header.substr(first + name.size() + 1, end - first - name.size() - 1);
    begin = end + 1;
  }
  return "";
}

/// An IP address with or without port: no foreign name can look like one.
bool is_address(const std::string& host) {
  const bool brackets = !host.empty() && host.front() == '[';
  return !host.empty() &&
         host.find_first_not_of(brackets ? "0123456789abcdefABCDEF.:[]" : "0123456789.:") == std::string::npos;
}

/// The name in a Host header: without port, and without the dot at the end of a whole name.
std::string without_port(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != std::string::npos && colon + 1 < host.size() &&
                        host.find_first_not_of("0123456789", colon + 1) == std::string::npos;
  std::string name = has_port ? host.substr(0, colon) : host;
  if (name.ends_with('.')) name.pop_back();
  return name;
}

bool is_named(const AccessRules& rules, const std::string& host) {
  // Names have no case; browsers send lower case.
  const std::string name = lower_case(without_port(host));
  if (name == "localhost" || name == "127.0.0.1" || name == "[::1]") return true;
  for (const std::string& known : rules.hosts) {
    if (lower_case(known) == lower_case(host) || lower_case(known) == name) return true;
  }
  return !rules.token.empty() && is_address(host);
}

/// Lets a browser in that followed the link with the token: the token leaves the address bar and stays in a cookie.
std::optional<Response> welcome(const AccessRules& rules, const Request& request) {
  const auto given = request.query.find("token");
  if (request.method != "GET" || request.path != "/" || given == request.query.end() ||
      !same_secret(given->second, rules.token))
    return std::nullopt;
  return Response{.status = 303,
                  .type = "text/plain; charset=utf-8",
                  .body = "",
                  .headers = {{"Location", "/"},
                              {"Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", rules.cookie_name,
                                                         rules.token)}}};
}

bool knows_token(const AccessRules& rules, const Request& request) {
  if (rules.token.empty()) return true;
  return same_secret(request.header("authorization"), "Bearer " + rules.token) ||
         same_secret(cookie(request.header("cookie"), rules.cookie_name), rules.token);
}

/// A length as announced; the largest number where it is none.
std::size_t number_from(const std::string& text) {
  std::size_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc{} && end == text.data() + text.size() ? number : std::string::npos;
}

std::optional<Response> refused_post(const Request& request) {
  if (request.header("x-nacre") != "1") return error_response(403, "expected the header X-Nacre: 1");
  const std::string origin = request.header("origin"), site = request.header("sec-fetch-site");
  if (!origin.empty() && origin != "http://" + request.header("host"))
    return error_response(403, "this request comes from another page");
  if (!site.empty() && site != "same-origin" && site != "none")
    return error_response(403, "this request comes from another page");
  const bool holds_files = request.path.ends_with(kImportPath);
  const std::string type = holds_files ? "multipart/form-data" : "application/json";
  if (!request.header("content-type").starts_with(type) || !request.header("content-encoding").empty())
    return error_response(415, fmt::format("expected {}, not compressed", type));
  const std::string length = request.header("content-length");
  if (length.empty() || !request.header("transfer-encoding").empty())
    return error_response(411, "expected a Content-Length");
  const std::size_t most = holds_files ? kMostUploadBytes : kMostBodyBytes;
  if (number_from(length) > most)
    return error_response(413, fmt::format("too large, expected at most {} MB", most >> 20));
  return std::nullopt;
}

/// The machine's name; empty when it has none.
std::string own_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// As written in a URL: IPv6 in brackets.
std::string in_address(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

}  // namespace

std::string page_link(const std::string& host, int port, const std::string& token) {
  const bool everywhere = host == "0.0.0.0" || host == "::";
  const std::string name = everywhere && !own_name().empty() ? own_name() : in_address(host);
  return fmt::format("http://{}:{}/{}", name, port, token.empty() ? "" : "?token=" + token);
}

std::vector<std::string> host_names(const std::string& host, int port) {
  std::vector<std::string> names = {"localhost", "127.0.0.1", "[::1]", in_address(host)};
  if (const std::string own = own_name(); !own.empty()) names.push_back(own);
  std::vector<std::string> with_port;
  for (const std::string& name : names) {
    with_port.push_back(fmt::format("{}:{}", name, port));
    if (port == 80) with_port.push_back(name);
  }
  return with_port;
}

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw InputError("no token: the system gives no random numbers");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

std::optional<Response> refused(const AccessRules& rules, const Request& request) {
  if (request.path.size() > kLongestPath) return error_response(414, "the path is too long");
  if (!is_named(rules, request.header("host")))
    return error_response(
        421,
        "this server has no such name: open the address that nacre dashboard printed, or start it with "
        "--allow-host and the name that the browser uses");
  if (!rules.token.empty()) {
    if (auto answer = welcome(rules, request)) return answer;
    if (!knows_token(rules, request))
      return Response{.status = 401,
                      .type = "text/plain; charset=utf-8",
                      .body = "This dashboard asks for a token: open the link that nacre dashboard printed.\n",
                      .headers = {{"WWW-Authenticate", "Bearer"}}};
  }
  if (request.method == "POST") return refused_post(request);
  if (request.method != "GET" && request.method != "HEAD") return error_response(405, "expected GET or POST");
  return std::nullopt;
}

}  // namespace nacre::dashboard
