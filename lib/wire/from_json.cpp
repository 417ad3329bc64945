#include "wire/from_json.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "base/big_endian.hpp"
#include "wire/channels.hpp"
#include "wire/lcm_types.hpp"

namespace nacre::wire {
namespace {

using Json = nlohmann::ordered_json;

/// Appends values as LCM does: big-endian, texts with their length and a closing zero.
class Encoder {
 public:
  std::string bytes;

  Result<void> structure(const Struct& type, const Json& value, const std::string& place) {
    if (!value.is_object()) return wrong(place, "an object");
    if (value.size() != type.members.size()) return wrong(place, fmt::format("{} members", type.members.size()));
    for (const Member& member : type.members) {
      const std::string inside = place.empty() ? member.name : place + "." + member.name;
      const auto found = value.find(member.name);
      if (found == value.end()) return fail("{}: missing", inside);
      const Result<void> added = member.is_array() ? array(member, length_of(member, type, value), *found, inside)
                                                   : single(member, *found, inside);
      if (!added) return added;
    }
    return {};
  }

  void integer(std::uint64_t value, int size) { append_big_endian(bytes, value, size); }

 private:
  static Result<void> wrong(const std::string& place, const std::string& expected) {
    return fail("{}: expected {}", place.empty() ? "message" : place, expected);
  }

  static std::int64_t length_of(const Member& member, const Struct& type, const Json& value) {
    if (member.fixed_length >= 0) return member.fixed_length;
    const Json& count = value.at(type.members[member.count_member].name);
    return count.is_number_integer() ? count.get<std::int64_t>() : -1;
  }

  Result<void> array(const Member& member, std::int64_t length, const Json& value, const std::string& place) {
    if (!value.is_array() || static_cast<std::int64_t>(value.size()) != length) {
      return wrong(place, fmt::format("an array of {}", length));
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (auto added = single(member, value[i], fmt::format("{}[{}]", place, i)); !added) return added;
    }
    return {};
  }

  Result<void> single(const Member& member, const Json& value, const std::string& place) {
    switch (member.primitive) {
      case Primitive::int8:
        return whole_number<std::int8_t>(value, place);
      case Primitive::int16:
        return whole_number<std::int16_t>(value, place);
      case Primitive::int32:
        return whole_number<std::int32_t>(value, place);
      case Primitive::int64:
        return whole_number<std::int64_t>(value, place);
      case Primitive::boolean:
        if (!value.is_boolean()) return wrong(place, "true or false");
        integer(value.get<bool>() ? 1 : 0, 1);
        return {};
      case Primitive::float32:
        if (!value.is_number()) return wrong(place, "a number");
        integer(std::bit_cast<std::uint32_t>(value.get<float>()), 4);
        return {};
      case Primitive::float64:
        if (!value.is_number()) return wrong(place, "a number");
        integer(std::bit_cast<std::uint64_t>(value.get<double>()), 8);
        return {};
      case Primitive::text:
        return text(value, place);
      case Primitive::structure:
        return structure(*member.structure, value, place);
    }
    return {};
  }

  template <class T>
  Result<void> whole_number(const Json& value, const std::string& place) {
    constexpr std::int64_t kLeast = std::numeric_limits<T>::min(), kMost = std::numeric_limits<T>::max();
    if (!value.is_number_integer() || (value.is_number_unsigned() && value.get<std::uint64_t>() > kMost) ||
        value.get<std::int64_t>() < kLeast || value.get<std::int64_t>() > kMost) {
      return wrong(place, fmt::format("a whole number from {} to {}", kLeast, kMost));
    }
    integer(static_cast<std::uint64_t>(value.get<std::int64_t>()), sizeof(T));
    return {};
  }

  Result<void> text(const Json& value, const std::string& place) {
    if (!value.is_string()) return wrong(place, "a text");
    const std::string& content = value.get_ref<const std::string&>();
    if (content.find('\0') != std::string::npos) return wrong(place, "a text without a zero byte");
    integer(content.size() + 1, 4);
    bytes += content;
    bytes.push_back('\0');
    return {};
  }
};

}  // namespace

Result<std::string> from_json(std::string_view type, const Json& message) {
  const auto known = std::find_if(channels().begin(), channels().end(), [&](const auto& c) { return c.type == type; });
  if (known == channels().end()) return fail("no channel carries the type {}", type);
  Encoder encoder;
  encoder.integer(static_cast<std::uint64_t>(known->fingerprint), 8);
  if (const auto added = encoder.structure(message_types().find(type)->second, message, ""); !added) {
    return fail("{}: {}", type, added.error().message);
  }
  return std::move(encoder.bytes);
}

}  // namespace nacre::wire
