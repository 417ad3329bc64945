#pragma once
// The only place that touches lcm::LCM: what the library gets wrong is dealt with here once.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "runtime/faults.hpp"
#include "runtime/node_core.hpp"
#include "wire/header.hpp"

namespace nacre::runtime {

/// Microseconds since 1970, as this machine's clock says: for people and for names, never for waiting.
std::int64_t now_utime();

/// Microseconds of a clock that nobody sets: for waiting.
std::int64_t steady_us();

/// `udpm://239.255.76.67:PORT?ttl=0&recv_buf_size=2097152`; ttl 1 when the run spans hosts of one network.
std::string bus_url(int port, bool lan = false);

/// The address of this host that multicast leaves from; 127.0.0.1 when it stays here.
Result<std::string> multicast_source(int port);

/// Whether multicast has a way: out of this process, for `lan` also out of this host. The error says which command
/// mends it.
Result<void> check_multicast_route(int port, bool lan = false);

/// Datagrams for this process that the system dropped because a socket's buffer was full.
std::int64_t dropped_by_system();

struct BusOptions {
  std::string url;
  std::string node;
  std::string run_id;
  std::int64_t epoch = 0;  ///< 0: now
  FaultSettings faults;    ///< see faults_from_environment()
  /// Called with a sentence for a person: what was dropped, from whom and why. The same sentence comes again at powers
  /// of two, and so does any beyond a hundred of one kind.
  std::function<void(LogLevel, const std::string&)> report = {};
};

/// What went wrong so far; shown in STATUS.
struct BusCounters {
  std::int64_t received = 0;  ///< accepted messages
  std::int64_t published = 0;
  std::int64_t corrupt = 0;  ///< wrong checksum, broken structure, too large
  std::int64_t foreign = 0;  ///< other run, other type on a channel, unknown channel
  std::int64_t invalid = 0;  ///< sound bytes, values out of range
  std::int64_t lost = 0;     ///< gaps in publishers' sequence numbers
  std::int64_t rejected() const { return corrupt + foreign + invalid; }
};

/// An accepted message: checksum, run, type and values are in order.
struct Received {
  wire::Header header;
  Message message;
  std::string bytes;  ///< as they came, for journals and logs
};

/// One process' connection to the bus of its run. To be used from one thread.
class Bus {
 public:
  /// Opens the bus. The error is a sentence with the remedy (no multicast route, filtered multicast).
  static Result<std::unique_ptr<Bus>> open(BusOptions options);
  ~Bus();

  /// Listens to these channels, or to all for an empty list.
  Result<void> subscribe(const std::vector<std::string>& channels);

  /// Stamps and sends. False when the network refused or the message exceeds 60 kB (reported).
  bool publish(const Message& message);

  /// Sends bytes as they are: for tests that play a broken or foreign program.
  bool publish_raw(const std::string& channel, const std::string& bytes);

  /// Waits up to timeout_ms, hands over everything that has arrived, at most `limit` messages. Returns their number. An
  /// exception of the handler comes out of this call after LCM has been left in order. Readable `wake_fd` (>= 0) ends
  /// the wait.
  int receive(int timeout_ms, const std::function<void(const Received&)>& handler, int wake_fd = -1, int limit = 256);

  /// The same without any check, for recorders: every datagram as it came.
  int receive_raw(int timeout_ms, const std::function<void(Datagram)>& handler, int wake_fd = -1, int limit = 256);

  const BusCounters& counters() const;
  /// Datagrams that have arrived and were not handed over yet.
  int queued() const;
  std::int64_t epoch() const;

 private:
  struct State;
  explicit Bus(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace nacre::runtime
