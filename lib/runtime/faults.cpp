#include "runtime/faults.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <utility>

#include "runtime/bus.hpp"

namespace nacre::runtime {
namespace {

double share(std::string_view key, std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0.0 && value <= 1.0)) {
    throw InputError::format("NACRE_FAULTS: {}=\"{}\": expected a share from 0 to 1", key, text);
  }
  return value;
}

double seconds(std::string_view key, std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0.0 && value <= 1e8)) {
    throw InputError::format("NACRE_FAULTS: {}=\"{}\": expected seconds from 0 to 1e8", key, text);
  }
  return value;
}

std::uint64_t seed_of(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw InputError::format("NACRE_FAULTS: seed=\"{}\": expected a non-negative integer", text);
  }
  return value;
}

void set(FaultSettings& settings, std::string_view key, std::string_view value) {
  if (key == "seed") {
    settings.seed = seed_of(value);
  } else if (key == "drop") {
    settings.drop = share(key, value);
  } else if (key == "duplicate") {
    settings.duplicate = share(key, value);
  } else if (key == "reorder") {
    settings.reorder = share(key, value);
  } else if (key == "corrupt") {
    settings.corrupt = share(key, value);
  } else if (key == "clock") {
    settings.clock_s = seconds(key, value);
  } else {
    throw InputError::format(
        "NACRE_FAULTS: unknown key \"{}\", expected seed, drop, duplicate, reorder, corrupt or clock", key);
  }
}

}  // namespace

FaultSettings parse_faults(std::string_view text) {
  FaultSettings settings;
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), item.size() + 1));
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) throw InputError::format("NACRE_FAULTS: \"{}\": expected key=value", item);
    set(settings, item.substr(0, equals), item.substr(equals + 1));
  }
  return settings;
}

FaultSettings faults_from_environment() {
  const char* text = std::getenv("NACRE_FAULTS");
  return text ? parse_faults(text) : FaultSettings{};
}

ClockFault::ClockFault(const FaultSettings& settings) : settings_(settings), start_us_(steady_us()) {}

std::int64_t ClockFault::offset_us(std::int64_t steady_us) const {
  if (settings_.clock_s == 0.0) return 0;
  constexpr std::int64_t kPeriodUs = 2'000'000;
  const std::int64_t period = (steady_us - start_us_) / kPeriodUs;
  RandomStream random(settings_.seed, fmt::format("clock/{}/{}", program_invocation_short_name, period));
  return static_cast<std::int64_t>(1e6 * random.uniform(-settings_.clock_s, settings_.clock_s));
}

FaultInjector::FaultInjector(const FaultSettings& settings, std::string_view node)
    : settings_(settings), random_(settings.seed, "faults/" + std::string(node)) {}

std::vector<Datagram> FaultInjector::pass(Datagram datagram) {
  // Five draws per datagram whatever happens, so that the same datagrams always meet the same faults.
  const double drop = random_.uniform(), duplicate = random_.uniform(), reorder = random_.uniform(),
               corrupt = random_.uniform();
  const std::uint64_t where = random_.bits();
  if (drop < settings_.drop) return {};
  if (corrupt < settings_.corrupt && !datagram.bytes.empty()) {
    char& byte = datagram.bytes[where % datagram.bytes.size()];
    byte = static_cast<char>(byte ^ (1 << (where >> 32) % 8));
  }
  if (reorder < settings_.reorder && !held_) {
    held_ = std::move(datagram);
    return {};
  }
  std::vector<Datagram> arriving;
  if (duplicate < settings_.duplicate) arriving.push_back(datagram);
  arriving.push_back(std::move(datagram));
  if (held_) arriving.push_back(*std::exchange(held_, std::nullopt));
  return arriving;
}

std::optional<Datagram> FaultInjector::release() { return std::exchange(held_, std::nullopt); }

}  // namespace nacre::runtime
