#include "wire/field_bytes.hpp"

#include <bit>

#include "base/big_endian.hpp"
#include "nacre/fidelity_t.hpp"
#include "nacre/parameter_set_t.hpp"
#include "nacre/test_kind_t.hpp"
#include "wire/schema.hpp"

namespace nacre::wire {

// The numbers in messages are those of the .lcm files.
using material::CriterionKind, tester::Fidelity, tester::TestKind;
static_assert(static_cast<int>(Fidelity::tiny) == fidelity_t::TINY);
static_assert(static_cast<int>(Fidelity::preview) == fidelity_t::PREVIEW);
static_assert(static_cast<int>(Fidelity::full) == fidelity_t::FULL);
static_assert(static_cast<int>(Fidelity::fine) == fidelity_t::FINE);
static_assert(static_cast<int>(TestKind::modulus) == test_kind_t::MODULUS);
static_assert(static_cast<int>(TestKind::toughness) == test_kind_t::TOUGHNESS);
static_assert(static_cast<int>(TestKind::tensile) == test_kind_t::TENSILE);
static_assert(static_cast<int>(CriterionKind::element) == parameter_set_t::ELEMENT);
static_assert(static_cast<int>(CriterionKind::neighbourhood) == parameter_set_t::NEIGHBOURHOOD);
static_assert(static_cast<int>(CriterionKind::crack_band) == parameter_set_t::CRACK_BAND);

void FieldWriter::put_integer(std::int64_t value, int size) {
  append_big_endian(bytes_, static_cast<std::uint64_t>(value), size);
}

void FieldWriter::put_value(double value) { append_big_endian(bytes_, std::bit_cast<std::uint64_t>(value), 8); }

void FieldWriter::put_single(double value) {
  append_big_endian(bytes_, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
}

void FieldWriter::put_value(const std::string& value) {
  const std::string_view kept = std::string_view(value).substr(0, std::min(value.find('\0'), kMaximumText));
  append_big_endian(bytes_, kept.size() + 1, 4);
  bytes_.append(kept);
  bytes_.push_back('\0');
}

void FieldWriter::put_count(std::size_t count) {
  put_integer(count, 4);
  count_ = count;
  is_cut_ = false;
}

void FieldWriter::check_length(std::string_view name, std::size_t length) const {
  if (length != count_ && !(is_cut_ && length > count_))
    throw std::logic_error(fmt::format("{}: arrays of different length, {} and {}", name, length, count_));
}

std::string FieldReader::get_integer(std::int64_t& value, int size) {
  if (bytes_.size() < static_cast<std::size_t>(size)) return ": the message ends here";
  const int unused_bits = 64 - 8 * size;
  const std::uint64_t raw = read_big_endian(bytes_.substr(0, static_cast<std::size_t>(size)));
  value = static_cast<std::int64_t>(raw << unused_bits) >> unused_bits;  // sign extension
  bytes_.remove_prefix(static_cast<std::size_t>(size));
  return {};
}

std::string FieldReader::get_value(bool& value) {
  std::int64_t number = 0;
  std::string fault = get_integer(number, 1);
  value = number != 0;
  return fault;
}

std::string FieldReader::get_value(int& value) {
  std::int64_t number = 0;
  std::string fault = get_integer(number, 4);
  value = number;
  return fault;
}

std::string FieldReader::get_value(std::int64_t& value) { return get_integer(value, 8); }

std::string FieldReader::get_value(double& value) {
  std::int64_t raw = 0;
  std::string fault = get_integer(raw, 8);
  value = std::bit_cast<double>(raw);
  return fault;
}

std::string FieldReader::get_single_value(double& value) {
  std::int64_t raw = 0;
  std::string fault = get_integer(raw, 4);
  value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
  return fault;
}

std::string FieldReader::get_value(std::string& value) {
  std::int64_t length = 0;  // with the closing zero
  if (std::string fault = get_integer(length, 4); !fault.empty()) return fault;
  if (length < 1 || static_cast<std::size_t>(length) > bytes_.size())
    return fmt::format(": text length {} does not fit", length);
  value.assign(bytes_.substr(0, static_cast<std::size_t>(length) - 1));
  bytes_.remove_prefix(static_cast<std::size_t>(length));
  return {};
}

namespace {

/// Takes over a value that was made of what the bytes hold.
template <class T>
std::string take(Result<T> made, T& value) {
  if (!made) return ": " + made.error().message;
  value = *std::move(made);
  return {};
}

}  // namespace

std::string FieldReader::get_value(tester::Fidelity& value) {
  std::int64_t code = 0;
  if (std::string fault = get_integer(code, 1); !fault.empty()) return fault;
  return take(fidelity_of_code(code), value);
}

std::string FieldReader::get_value(tester::TestKind& value) {
  std::int64_t code = 0;
  if (std::string fault = get_integer(code, 1); !fault.empty()) return fault;
  return take(test_kind_of_code(code), value);
}

std::string FieldReader::get_value(material::CriterionKind& value) {
  std::int64_t code = 0;
  if (std::string fault = get_integer(code, 1); !fault.empty()) return fault;
  return take(criterion_of_code(code), value);
}

std::string FieldReader::get_value(pattern::Pattern& value) {
  std::int64_t bits = 0;
  if (std::string fault = get_integer(bits, 8); !fault.empty()) return fault;
  if (bits < 0 || (bits >> pattern::kFreePixels) != 0) return fmt::format(": {:x} has more than 55 bits", bits);
  value = pattern::Pattern(static_cast<std::uint64_t>(bits));
  return {};
}

std::string FieldReader::get_value(pattern::Design& value) {
  std::string name;
  if (std::string fault = get_value(name); !fault.empty()) return fault;
  return take(pattern::design_from_name(name), value);
}

std::string FieldReader::get_value(tester::Loading& value) {
  std::string text;
  if (std::string fault = get_value(text); !fault.empty()) return fault;
  return take(tester::loading_from_string(text), value);
}

Result<tester::Fidelity> fidelity_of_code(std::int64_t code) {
  if (code < 0 || code > fidelity_t::FINE) return fail("there is no {}", code);
  return static_cast<tester::Fidelity>(code);
}

Result<tester::TestKind> test_kind_of_code(std::int64_t code) {
  if (code < 0 || code > test_kind_t::TENSILE) return fail("there is no {}", code);
  return static_cast<tester::TestKind>(code);
}

Result<material::CriterionKind> criterion_of_code(std::int64_t code) {
  if (code < 0 || code > parameter_set_t::CRACK_BAND) return fail("there is no {}", code);
  return static_cast<material::CriterionKind>(code);
}

}  // namespace nacre::wire
