#include "runtime/bus.hpp"

#include <arpa/inet.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <exception>
#include <filesystem>
#include <utility>

#include <lcm/lcm-cpp.hpp>

#include "runtime/sequence.hpp"
#include "wire/channels.hpp"
#include "wire/schema.hpp"

namespace nacre::runtime {
namespace {

constexpr const char* kMulticastGroup = "239.255.76.67";
constexpr const char* kSelfTestChannel = "LCM_SELF_TEST";  // published by the library itself
constexpr std::size_t kMostSentences = 100;                // told apart per kind of problem

/// Channel names are regular expressions to LCM.
std::string escaped(const std::string& channel) {
  std::string pattern;
  for (const char c : channel) {
    if (std::strchr(".^$*+?()[]{}|\\", c)) pattern.push_back('\\');
    pattern.push_back(c);
  }
  return pattern;
}

}  // namespace

std::int64_t now_utime() {
  static const ClockFault fault(faults_from_environment());
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count() + fault.offset_us(steady_us());
}

std::int64_t steady_us() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since_start).count();
}

std::string bus_url(int port, bool lan) {
  return fmt::format("udpm://{}:{}?ttl={}&recv_buf_size=2097152", kMulticastGroup, port, lan ? 1 : 0);
}

Result<std::string> multicast_source(int port) {
  const int socket_fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket_fd < 0) return fail("no UDP socket: {}", std::strerror(errno));
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, kMulticastGroup, &group.sin_addr);
  const int status = ::connect(socket_fd, reinterpret_cast<const sockaddr*>(&group), sizeof group);
  const int reason = errno;
  sockaddr_in own{};
  socklen_t length = sizeof own;
  ::getsockname(socket_fd, reinterpret_cast<sockaddr*>(&own), &length);
  ::close(socket_fd);
  if (own.sin_addr.s_addr == htonl(INADDR_ANY)) own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);  // a route to lo
  char text[INET_ADDRSTRLEN] = {};
  if (status == 0) return std::string(inet_ntop(AF_INET, &own.sin_addr, text, sizeof text));
  return fail("no route for multicast to {} ({}): run `ip link set lo up; ip route add 224.0.0.0/4 dev lo` as root",
              kMulticastGroup, std::strerror(reason));
}

Result<void> check_multicast_route(int port, bool lan) {
  const Result<std::string> source = multicast_source(port);
  if (!source) return tl::unexpected(source.error());
  if (!lan || !source->starts_with("127.")) return {};
  return fail(
      "multicast to {} stays on this machine, and the run spans hosts: run "
      "`ip route replace 224.0.0.0/4 dev INTERFACE` as root, INTERFACE the one to the other machines",
      kMulticastGroup);
}

std::int64_t dropped_by_system() {
  // LCM does not show its sockets, so all of this process' datagram sockets are asked.
  std::int64_t dropped = 0;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", unreadable)) {
    const int fd = std::atoi(entry.path().filename().c_str());
    int type = 0;
    socklen_t length = sizeof type;
    if (::getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &length) != 0 || type != SOCK_DGRAM) continue;
    std::uint32_t memory[SK_MEMINFO_VARS] = {};
    length = sizeof memory;
    if (::getsockopt(fd, SOL_SOCKET, SO_MEMINFO, memory, &length) == 0) dropped += memory[SK_MEMINFO_DROPS];
  }
  return dropped;
}

/// LCM's callbacks only queue; everything else happens outside lcm's handle(), which an exception would leave unusable.
struct Bus::State {
  BusOptions options;
  std::unique_ptr<lcm::LCM> lcm;
  FaultInjector faults;
  BusCounters counters;
  std::map<std::string, std::int64_t> next_seq;                              ///< own, per channel
  std::map<std::string, std::map<std::string, std::int64_t>> report_counts;  ///< per kind of problem and sentence
  SequenceCounter sequences;
  std::deque<Datagram> waiting;

  explicit State(BusOptions all) : options(std::move(all)), faults(options.faults, options.node) {
    if (options.epoch == 0) options.epoch = now_utime();
  }

  static void take(const lcm::ReceiveBuffer* buffer, const std::string& channel, State* state) {
    if (channel != kSelfTestChannel) state->on_datagram(buffer, channel);
  }

  void on_datagram(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    Datagram datagram{channel, std::string(static_cast<const char*>(buffer->data), buffer->data_size)};
    if (!options.faults.any()) {
      waiting.push_back(std::move(datagram));
      return;
    }
    for (Datagram& arriving : faults.pass(std::move(datagram))) waiting.push_back(std::move(arriving));
  }

  /// Each sentence once, then when its count is a power of two: whoever sends something else that is wrong hears of it.
  /// Where a kind of problem has more sentences than anybody reads, the rest are counted together: a flood fills no
  /// log.
  void report(const std::string& kind, const std::string& sentence) {
    std::map<std::string, std::int64_t>& counts = report_counts[kind];
    const bool is_told_apart = counts.contains(sentence) || counts.size() < kMostSentences;
    const std::int64_t count = ++counts[is_told_apart ? sentence : ""];
    if (!options.report || !std::has_single_bit(static_cast<std::uint64_t>(count))) return;
    const char* what = is_told_apart ? "times" : "others like it";
    options.report(LogLevel::warning, count == 1 ? sentence : fmt::format("{} ({} {} so far)", sentence, count, what));
  }

  /// The message, or nothing after counting why not.
  std::optional<Received> accept(Datagram datagram) {
    if (datagram.bytes.size() > wire::kMaximumPayload) {
      ++counters.corrupt;
      report("oversized", fmt::format("a message of {} bytes on {} dropped: at most {} are allowed",
                                      datagram.bytes.size(), datagram.channel, wire::kMaximumPayload));
      return std::nullopt;
    }
    const wire::Channel* channel = wire::find_channel(datagram.channel);
    if (!channel) {
      ++counters.foreign;
      report("channel", fmt::format("a message on the unknown channel {} dropped", datagram.channel));
      return std::nullopt;
    }
    if (wire::fingerprint_of(datagram.bytes) != channel->fingerprint) {
      ++counters.foreign;
      report("type " + datagram.channel,
             fmt::format("a message on {} dropped: it is no {} (damaged, or another version)", datagram.channel,
                         channel->type));
      return std::nullopt;
    }
    Result<wire::Blanked> blanked = wire::blank_header(datagram.channel, datagram.bytes);
    if (!blanked) {
      ++counters.corrupt;
      report("corrupt " + datagram.channel,
             fmt::format("a message on {} dropped: {}", datagram.channel, blanked.error().message));
      return std::nullopt;
    }
    // Whatever is dropped below has arrived: it is not lost.
    sequences.count(datagram.channel, blanked->header);
    counters.lost = sequences.lost();
    if (blanked->header.run_id != options.run_id) {
      ++counters.foreign;
      report("run " + datagram.channel,
             fmt::format("a message on {} of run \"{}\" from {} dropped: this is run \"{}\"", datagram.channel,
                         blanked->header.run_id, blanked->header.node, options.run_id));
      return std::nullopt;
    }
    if (const Result<void> sound = channel->validate(blanked->payload); !sound) {
      ++counters.invalid;
      report("invalid " + datagram.channel, fmt::format("a message on {} from {} dropped: {}", datagram.channel,
                                                        blanked->header.node, sound.error().message));
      return std::nullopt;
    }
    ++counters.received;
    return Received{std::move(blanked->header),
                    {std::move(datagram.channel), std::move(blanked->payload)},
                    std::move(datagram.bytes)};
  }

  /// Waits until LCM or the wake-up descriptor has something.
  void wait(int timeout_ms, int wake_fd) {
    pollfd descriptors[2] = {{lcm->getFileno(), POLLIN, 0}, {wake_fd, POLLIN, 0}};
    ::poll(descriptors, wake_fd >= 0 ? 2 : 1, timeout_ms);
  }
};

Bus::Bus(std::unique_ptr<State> state) : state_(std::move(state)) {}
Bus::~Bus() = default;

Result<std::unique_ptr<Bus>> Bus::open(BusOptions options) {
  const std::string url = options.url;
  if (url.starts_with("udpm:")) {
    // lcm_create's own failure path prints freed memory, so the route is tried first.
    if (const Result<void> route = check_multicast_route(7667); !route) return tl::unexpected(route.error());
  }
  auto state = std::make_unique<State>(std::move(options));
  state->lcm = std::make_unique<lcm::LCM>(url);
  if (!state->lcm->good()) return fail("the bus {} cannot be opened: LCM refused the address", url);
  return std::unique_ptr<Bus>(new Bus(std::move(state)));
}

Result<void> Bus::subscribe(const std::vector<std::string>& channels) {
  // Before the first subscription: this starts LCM's receive thread and its self-test. A subscription that fails
  // because of it comes back as an object around a null pointer, which the next call on it would follow.
  if (state_->lcm->getFileno() < 0) {
    // What the library has left of itself then cannot even be destroyed: kept, not lost.
    static std::atomic<const lcm::LCM*> broken;
    broken = state_->lcm.release();
    return fail("cannot listen on {}: multicast does not come back to this host (filtered by a firewall?)",
                state_->options.url);
  }
  std::vector<std::string> patterns;
  for (const std::string& channel : channels) patterns.push_back(escaped(channel));
  if (patterns.empty()) patterns.push_back(".*");
  for (const std::string& pattern : patterns) {
    // Not subscribe(&State::on_datagram): g++ 12 miscompiles LCM's call through a member pointer under
    // -fsanitize=undefined.
    lcm::Subscription* subscription = state_->lcm->subscribeFunction(pattern, State::take, state_.get());
    if (!subscription) return fail("cannot listen on {}: LCM refuses the channel {}", state_->options.url, pattern);
    subscription->setQueueCapacity(0);  // unlimited: the default of 30 drops silently
  }
  return {};
}

bool Bus::publish(const Message& message) {
  const wire::Header header{now_utime(), state_->options.node, state_->options.epoch,
                            state_->next_seq[message.channel] + 1, state_->options.run_id};
  const std::string bytes = wire::stamp_header(message.channel, message.payload, header);
  if (bytes.size() > wire::kMaximumPayload) {
    state_->report("too long " + message.channel,
                   fmt::format("a message of {} bytes on {} not sent: at most {} are allowed", bytes.size(),
                               message.channel, wire::kMaximumPayload));
    return false;
  }
  ++state_->next_seq[message.channel];
  return publish_raw(message.channel, bytes);
}

bool Bus::publish_raw(const std::string& channel, const std::string& bytes) {
  if (state_->lcm->publish(channel, bytes.data(), static_cast<unsigned>(bytes.size())) != 0) {
    state_->report("refused", fmt::format("the network refuses messages on {}: {}", channel, std::strerror(errno)));
    return false;
  }
  ++state_->counters.published;
  return true;
}

int Bus::receive(int timeout_ms, const std::function<void(const Received&)>& handler, int wake_fd, int limit) {
  return receive_raw(
      timeout_ms,
      [&](Datagram datagram) {
        if (const auto received = state_->accept(std::move(datagram))) handler(*received);
      },
      wake_fd, limit);
}

int Bus::receive_raw(int timeout_ms, const std::function<void(Datagram)>& handler, int wake_fd, int limit) {
  if (state_->waiting.empty()) state_->wait(timeout_ms, wake_fd);
  for (int i = 0; i < limit && state_->lcm->handleTimeout(0) > 0; ++i) {
  }
  if (state_->waiting.empty()) {
    if (auto late = state_->faults.release()) state_->waiting.push_back(std::move(*late));
  }
  int handled = 0;
  for (; !state_->waiting.empty() && handled < limit; ++handled) {
    Datagram datagram = std::move(state_->waiting.front());
    state_->waiting.pop_front();
    handler(std::move(datagram));
  }
  return handled;
}

const BusCounters& Bus::counters() const { return state_->counters; }
int Bus::queued() const { return state_->waiting.size(); }
std::int64_t Bus::epoch() const { return state_->options.epoch; }

}  // namespace nacre::runtime
