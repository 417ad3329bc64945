#pragma once
// Small checks that the conversions share; each error names the member and what was expected.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "base/names.hpp"
#include "base/result.hpp"
#include "measurement/limits.hpp"
#include "pattern/design.hpp"

namespace nacre::wire {

inline Result<void> expect_range(std::string_view member, double value, double minimum, double maximum) {
  if (value >= minimum && value <= maximum) return {};
  return fail("{}: {} is outside [{}, {}]", member, value, minimum, maximum);
}

inline Result<void> expect_range(std::string_view member, double value, const measurement::Limits& limits) {
  return expect_range(member, value, limits.least, limits.most);
}

inline Result<void> expect_finite(std::string_view member, double value) {
  if (std::isfinite(value)) return {};
  return fail("{}: {} is no number", member, value);
}

/// An index into `count` things; `count` may be anything that a message holds.
inline Result<void> expect_index(std::string_view member, int index, int count) {
  if (index >= 0 && index < count) return {};
  return fail("{}: {} is no index into {}", member, index, count);
}

/// Moduli, toughnesses and stresses beyond these are no material's; a value out of range is a broken program, not a
/// finding.
inline constexpr double kLargestPressurePa = measurement::kStressPa.most;
inline constexpr double kLargestStrain = measurement::kStrain.most;
inline constexpr int kLargestRound = 100'000;
inline constexpr std::int64_t kLargestCount = 1'000'000'000;

inline Result<void> expect_pressure(std::string_view member, double value_pa) {
  return expect_range(member, value_pa, 0.0, kLargestPressurePa);
}

inline Result<void> expect_round(int round, int minimum = 0) {
  return expect_range("round", round, minimum, kLargestRound);
}

inline Result<void> expect_name(std::string_view member, std::string_view name) {
  if (name.empty() || name.size() > measurement::kLongestName)
    return fail("{}: a text of 1 to {} bytes was expected, not {}", member, measurement::kLongestName, name.size());
  if (std::ranges::any_of(name, is_control)) return fail("{}: holds a control character", member);
  return {};
}

inline Result<void> expect_count(std::string_view member, std::size_t count, std::size_t maximum) {
  if (count <= maximum) return {};
  return fail("{}: {} elements, at most {}", member, count, maximum);
}

/// The error with the name of its message type in front.
inline tl::unexpected<Error> in_type(std::string_view type, const Error& error) {
  return fail("{}: {}", type, error.message);
}

/// A 55-bit pattern.
inline Result<pattern::Pattern> pattern_from_bits(std::int64_t bits) {
  if (bits < 0 || (bits >> pattern::kFreePixels) != 0) return fail("pattern: {:x} has more than 55 bits", bits);
  return pattern::Pattern(static_cast<std::uint64_t>(bits));
}

/// The first failed check of a list.
template <class... Checks>
Result<void> all_of(const Checks&... checks) {
  Result<void> first;
  ((first = first && !checks ? Result<void>(tl::unexpected(checks.error())) : first), ...);
  return first;
}

}  // namespace nacre::wire
