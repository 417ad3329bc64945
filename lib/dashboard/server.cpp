#include "dashboard/server.hpp"

#include <netdb.h>
#include <poll.h>

#include <cerrno>
#include <cstring>
#include <semaphore>
#include <thread>

#include <httplib.h>

#include "base/names.hpp"
#include "base/result.hpp"
#include "dashboard/upload.hpp"
#include "runtime/bus.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::size_t kThreads = 24;  // a browser keeps six connections a tab, and a connection keeps a thread
constexpr int kTimeout_s = 5, kIdle_s = 2, kLook_ms = 100;
constexpr std::size_t kRequestsPerConnection = 1000;
constexpr int kUploads = 2;  // at a time: each may hold kMostUploadBytes
constexpr std::int64_t kLongestUpload_us = 120'000'000;

Request request_of(const httplib::Request& from) {
  Request request{.method = from.method, .path = from.path, .query = {}, .headers = {}, .body = from.body};
  for (const auto& [name, value] : from.params) request.query.emplace(name, value);
  for (const auto& [name, value] : from.headers) request.headers.emplace(lower_case(name), value);
  return request;
}

void send(const Response& from, httplib::Response& to) {
  to.status = from.status;
  to.set_header("X-Content-Type-Options", "nosniff");
  to.set_header("Referrer-Policy", "no-referrer");
  to.set_header("X-Frame-Options", "DENY");
  to.set_header("Cross-Origin-Resource-Policy", "same-origin");
  to.set_header("Cache-Control", "no-store");
  bool has_policy = false;
  for (const auto& [name, value] : from.headers) {
    to.set_header(name, value);
    has_policy = has_policy || name == "Content-Security-Policy";
  }
  if (!has_policy)
    to.set_header("Content-Security-Policy",
                  "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: "
                  "blob:; connect-src 'self'; font-src "
                  "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  if (!from.stream) return to.set_content(from.body, from.type);
  to.set_chunked_content_provider(from.type, [stream = from.stream](std::size_t, httplib::DataSink& sink) {
    try {
      stream([&](std::string_view bytes) { return sink.write(bytes.data(), bytes.size()); });
    } catch (const InputError&) {
      return false;  // cut off: the browser says that the file is not whole
    }
    sink.done();
    return true;
  });
}

using Uploads = std::counting_semaphore<kUploads>;

/// One upload that was let in.
struct UploadSlot {
  Uploads& uploads;
  ~UploadSlot() { uploads.release(); }
};

/// The files of a request; nothing where they cannot be read, are too many or come too slowly.
std::optional<std::vector<Part>> parts_of(const httplib::ContentReader& reader) {
  const std::int64_t deadline_us = runtime::steady_us() + kLongestUpload_us;
  std::vector<Part> parts;
  const bool is_whole = reader(
      [&](const httplib::MultipartFormData& head) {
        parts.push_back({head.name, head.filename, ""});
        return parts.size() <= kMostParts;
      },
      [&](const char* bytes, std::size_t count) {
        if (!parts.empty()) parts.back().content.append(bytes, count);
        return !parts.empty() && runtime::steady_us() < deadline_us;
      });
  return is_whole ? std::optional(std::move(parts)) : std::nullopt;
}

/// Why nothing can listen there; `reason` is the system's last error.
std::string why_not_listening(const std::string& host, int reason) {
  addrinfo* addresses = nullptr;
  if (const int unknown = ::getaddrinfo(host.c_str(), nullptr, nullptr, &addresses); unknown != 0)
    return fmt::format("is no address: {}", ::gai_strerror(unknown));
  ::freeaddrinfo(addresses);
  if (reason == EADDRINUSE) return "is taken: is another dashboard there? (--port 0 takes any free port)";
  if (reason == EADDRNOTAVAIL) return "is no address of this machine, expected one of its own, or 0.0.0.0 for all";
  return fmt::format("cannot be listened to: {}", std::strerror(reason));
}

/// The port that the server has; throws InputError when it gets none.
int bound_port(httplib::Server& server, const ServerSettings& settings) {
  const int wanted = settings.port.value_or(kUsualPort);
  errno = 0;
  if (wanted != 0 && server.bind_to_port(settings.host, wanted)) return wanted;
  if (wanted == 0 || (!settings.port && errno == EADDRINUSE)) {
    if (const int port = server.bind_to_any_port(settings.host); port > 0) return port;
  }
  throw InputError::format("{}:{}: {}", settings.host, wanted, why_not_listening(settings.host, errno));
}

}  // namespace

void serve(const std::function<Response(const Request&)>& respond, const ServerSettings& settings,
           const std::function<void(int port)>& ready, const std::function<bool()>& stop) {
  httplib::Server server;
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  server.set_payload_max_length(kMostUploadBytes);  // of others the guard allows less
  server.set_read_timeout(kTimeout_s);
  server.set_write_timeout(kTimeout_s);
  server.set_keep_alive_timeout(kIdle_s);
  server.set_keep_alive_max_count(kRequestsPerConnection);
  server.set_tcp_nodelay(true);
  // Not SO_REUSEPORT, the library's default: a second dashboard would get half of the first one's requests.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  const int port = bound_port(server, settings);
  AccessRules rules{
      .hosts = host_names(settings.host, port), .token = settings.token, .cookie_name = fmt::format("nacre_{}", port)};

  rules.hosts.insert(rules.hosts.end(), settings.further_hosts.begin(), settings.further_hosts.end());

  // Before the body is read.
  server.set_pre_routing_handler([&](const httplib::Request& from, httplib::Response& to) {
    const auto refusal = refused(rules, request_of(from));
    if (!refusal) return httplib::Server::HandlerResponse::Unhandled;
    send(*refusal, to);
    return httplib::Server::HandlerResponse::Handled;
  });
  const auto handle = [&](const httplib::Request& from, httplib::Response& to) { send(respond(request_of(from)), to); };
  // The library's own refusals, such as a body that is too large, get a sentence as well.
  server.set_error_handler([](const httplib::Request&, httplib::Response& to) {
    if (!to.body.empty()) return;
    send(error_response(to.status, to.status == 413 ? "too large" : "the request cannot be read"), to);
  });
  Uploads uploads(kUploads);
  const auto take_files = [&](const httplib::Request& from, httplib::Response& to,
                              const httplib::ContentReader& reader) {
    if (!uploads.try_acquire()) return send(error_response(503, "other files are being read: try again soon"), to);
    const UploadSlot slot{uploads};
    Request request = request_of(from);
    auto parts = parts_of(reader);
    request.parts = parts ? std::move(*parts) : std::vector<Part>{};
    send(parts ? respond(request) : error_response(400, "the files cannot be read, or are too many"), to);
  };
  server.Post(fmt::format(".*{}", kImportPath), take_files);
  server.Get(".*", handle);
  server.Post(".*", handle);

  ready(port);
  std::thread listening([&] { server.listen_after_bind(); });
  while (!stop()) ::poll(nullptr, 0, kLook_ms);
  server.stop();
  listening.join();
}

}  // namespace nacre::dashboard
