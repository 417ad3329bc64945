#include "wire/schema.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "wire/lcm_types.hpp"

namespace nacre::wire {
namespace {

// ---- Walking over bytes ----

/// Where a walk stands: names and indices from the top, made into "designs[3].modulus_pa" only when asked for.
struct Place {
  const Place* parent = nullptr;
  std::string_view name;
  std::int64_t index = -1;
};

std::string to_text(const Place& place) {
  std::string text = place.parent && !place.parent->name.empty() ? to_text(*place.parent) + "." : std::string();
  text += place.name;
  if (place.index >= 0) text += "[" + std::to_string(place.index) + "]";
  return text;
}

/// Receives what a walk passes; the walk is the same for checking and for printing.
class Visitor {
 public:
  virtual ~Visitor() = default;
  virtual void number(const Place&, double) {}
  virtual void integer(const Place&, std::int64_t) {}
  virtual void truth(const Place&, bool) {}
  virtual void text(const Place&, std::string_view) {}
  virtual void begin_structure(const Place&) {}
  virtual void end_structure() {}
  virtual void begin_array(const Place&) {}
  virtual void end_array() {}
};

class Walk {
 public:
  Walk(std::string_view bytes, Visitor& visitor) : bytes_(bytes), visitor_(visitor) {}

  /// Walks over one structure. The first fault is kept in error().
  bool structure(const Struct& type, const Place& place) {
    visitor_.begin_structure(place);
    std::vector<std::int64_t> integers(type.members.size(), 0);  // lengths of later arrays
    for (std::size_t i = 0; i < type.members.size(); ++i) {
      const Member& member = type.members[i];
      if (member.is_array()) {
        const std::int64_t count = member.fixed_length >= 0 ? member.fixed_length : integers[member.count_member];
        if (!array(member, count, place)) return false;
      } else if (!value(member, Place{&place, member.name}, &integers[i])) {
        return false;
      }
    }
    visitor_.end_structure();
    return true;
  }

  std::size_t position() const { return position_; }
  void skip(std::size_t size) { position_ += size; }
  const std::string& error() const { return error_; }

 private:
  bool fault(const Place& place, const std::string& what) {
    error_ = to_text(place) + ": " + what;
    return false;
  }

  bool array(const Member& member, std::int64_t count, const Place& parent) {
    const Place place{&parent, member.name};
    // Every element takes at least one byte, so a sound count never exceeds what is left.
    if (count < 0 || count > static_cast<std::int64_t>(bytes_.size() - position_)) {
      return fault(place, "length " + std::to_string(count) + " does not fit the message");
    }
    visitor_.begin_array(place);
    for (std::int64_t i = 0; i < count; ++i) {
      if (!value(member, Place{&parent, member.name, i}, nullptr)) return false;
    }
    visitor_.end_array();
    return true;
  }

  bool value(const Member& member, const Place& place, std::int64_t* integer) {
    switch (member.primitive) {
      case Primitive::int8:
        return integer_value(1, place, integer);
      case Primitive::int16:
        return integer_value(2, place, integer);
      case Primitive::int32:
        return integer_value(4, place, integer);
      case Primitive::int64:
        return integer_value(8, place, integer);
      case Primitive::boolean:
        return truth_value(place);
      case Primitive::float32:
        return float_value(4, place);
      case Primitive::float64:
        return float_value(8, place);
      case Primitive::text:
        return text_value(place);
      case Primitive::structure:
        return structure(*member.structure, place);
    }
    return false;
  }

  bool take(std::size_t size, const Place& place, std::uint64_t& value) {
    if (bytes_.size() - position_ < size) return fault(place, "the message ends here");
    value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes_[position_ + i]);
    position_ += size;
    return true;
  }

  bool integer_value(std::size_t size, const Place& place, std::int64_t* out) {
    std::uint64_t raw = 0;
    if (!take(size, place, raw)) return false;
    const int unused_bits = 64 - 8 * size;
    const std::int64_t number = static_cast<std::int64_t>(raw << unused_bits) >> unused_bits;  // sign extension
    if (out) *out = number;
    visitor_.integer(place, number);
    return true;
  }

  bool truth_value(const Place& place) {
    std::uint64_t raw = 0;
    if (!take(1, place, raw)) return false;
    if (raw > 1) return fault(place, "truth value " + std::to_string(raw) + ", expected 0 or 1");
    visitor_.truth(place, raw == 1);
    return true;
  }

  bool float_value(std::size_t size, const Place& place) {
    std::uint64_t raw = 0;
    if (!take(size, place, raw)) return false;
    const double number = size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)))
                                    : std::bit_cast<double>(raw);
    if (!std::isfinite(number)) return fault(place, "a number that is not finite");
    visitor_.number(place, number);
    return true;
  }

  bool text_value(const Place& place) {
    std::uint64_t length = 0;  // with the closing zero
    if (!take(4, place, length)) return false;
    if (length < 1 || length > kMaximumText + 1 || length > bytes_.size() - position_) {
      return fault(place, "text length " + std::to_string(length) + " does not fit");
    }
    const std::string_view text = bytes_.substr(position_, length);
    if (text.find('\0') != length - 1) return fault(place, "a text that does not end with its only zero byte");
    position_ += length;
    visitor_.text(place, text.substr(0, length - 1));
    return true;
  }

  std::string_view bytes_;
  Visitor& visitor_;
  std::size_t position_ = 0;
  std::string error_;
};

Result<void> walk(std::string_view type, std::string_view payload, Visitor& visitor) {
  const auto found = message_types().find(type);
  if (found == message_types().end()) return fail("there is no message type {}", type);
  if (payload.size() > kMaximumPayload) return fail("{}: {} bytes, at most {}", type, payload.size(), kMaximumPayload);
  if (payload.size() < 8) return fail("{}: {} bytes are too short", type, payload.size());
  Walk steps(payload, visitor);
  steps.skip(8);
  if (!steps.structure(found->second, Place{})) return fail("{}: {}", type, steps.error());
  if (steps.position() != payload.size()) {
    return fail("{}: {} bytes behind the end", type, payload.size() - steps.position());
  }
  return {};
}

// ---- Visitors ----

/// Builds the JSON value of what it is shown.
class JsonBuilder : public Visitor {
 public:
  nlohmann::ordered_json result;
  void number(const Place& place, double value) override { put(place, value); }
  void integer(const Place& place, std::int64_t value) override { put(place, value); }
  void truth(const Place& place, bool value) override { put(place, value); }
  void text(const Place& place, std::string_view value) override { put(place, value); }
  void begin_structure(const Place& place) override { open(place, nlohmann::ordered_json::object()); }
  void end_structure() override { close(); }
  void begin_array(const Place& place) override { open(place, nlohmann::ordered_json::array()); }
  void end_array() override { close(); }

 private:
  void put(const Place& place, nlohmann::ordered_json value) {
    if (stack_.empty()) {
      result = std::move(value);
    } else if (stack_.back().is_array()) {
      stack_.back().push_back(std::move(value));
    } else {
      stack_.back()[std::string(place.name)] = std::move(value);
    }
  }
  void open(const Place& place, nlohmann::ordered_json empty) {
    names_.push_back(std::string(place.name));
    stack_.push_back(std::move(empty));
  }
  void close() {
    nlohmann::ordered_json done = std::move(stack_.back());
    const std::string name = std::move(names_.back());
    stack_.pop_back();
    names_.pop_back();
    put(Place{nullptr, name}, std::move(done));
  }
  std::vector<nlohmann::ordered_json> stack_;
  std::vector<std::string> names_;
};

/// Lists every value with its place.
class ValueLister : public Visitor {
 public:
  std::vector<std::pair<std::string, std::string>> values;
  void number(const Place& place, double value) override { add(place, fmt::format("{}", value)); }
  void integer(const Place& place, std::int64_t value) override { add(place, fmt::format("{}", value)); }
  void truth(const Place& place, bool value) override { add(place, value ? "true" : "false"); }
  void text(const Place& place, std::string_view value) override { add(place, fmt::format("\"{}\"", value)); }

 private:
  void add(const Place& place, std::string value) { values.emplace_back(to_text(place), std::move(value)); }
};

}  // namespace

Result<void> check_structure(std::string_view type, std::string_view payload) {
  Visitor nothing;
  return walk(type, payload, nothing);
}

Result<nlohmann::ordered_json> to_json(std::string_view type, std::string_view payload) {
  JsonBuilder builder;
  if (const Result<void> sound = walk(type, payload, builder); !sound) return tl::unexpected(sound.error());
  return std::move(builder.result);
}

std::optional<std::string> first_difference(std::string_view type, std::string_view expected, std::string_view actual) {
  if (expected == actual) return std::nullopt;
  ValueLister a, b;
  if (const Result<void> sound = walk(type, expected, a); !sound) return "expected: " + sound.error().message;
  if (const Result<void> sound = walk(type, actual, b); !sound) return "actual: " + sound.error().message;
  const std::size_t common = std::min(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (a.values[i].first != b.values[i].first)
      return fmt::format("{} against {}", a.values[i].first, b.values[i].first);
    if (a.values[i].second != b.values[i].second) {
      return fmt::format("{}: {} against {}", a.values[i].first, a.values[i].second, b.values[i].second);
    }
  }
  return fmt::format("{} values against {}", a.values.size(), b.values.size());
}

}  // namespace nacre::wire
