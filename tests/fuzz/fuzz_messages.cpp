// Datagrams: header, structure, values of every message type, and their way to JSON and back.

#include "fuzz.hpp"
#include "wire/channels.hpp"
#include "wire/from_json.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nacre;
  if (size < 1) return 0;
  // The checksum would keep the fuzzer from everything behind it: the payload is taken without header, too.
  const auto& all = wire::channels();
  const wire::Channel& channel = *(all.begin() + data[0] % std::distance(all.begin(), all.end()));
  const std::string bytes(fuzz::text_of(data + 1, size - 1));
  if (const auto blanked = wire::blank_header(channel.name, bytes)) (void)channel.validate(blanked->payload);
  const bool is_valid = channel.validate(bytes).has_value();
  const auto json = wire::to_json(channel.type, bytes);
  if (!json) {
    fuzz::expect(!is_valid);
    return 0;
  }
  const auto again = wire::from_json(channel.type, *json);
  // Texts that are not UTF-8 have no JSON; whatever does come back must be accepted as before.
  if (again && is_valid && wire::fingerprint_of(bytes) == channel.fingerprint) {
    fuzz::expect(channel.validate(*again).has_value());
  }
  if (is_valid) {
    const wire::Header header{1, "fuzz", 2, 3, "run"};
    const auto stamped = wire::blank_header(channel.name, wire::stamp_header(channel.name, bytes, header));
    fuzz::expect(stamped.has_value() && stamped->header.node == "fuzz");
  }
  return 0;
}
