#pragma once
// Tables of fields. A struct lists every field once, in a static member
//
//   static void fields(auto& field, auto& m) {
//     field("round", m.round, Range{0, 100'000});
//     field.count("n_designs", m.designs, Range{0, 1000});
//     field("designs", m.designs);
//   }
//
// and whatever walks over the table makes the rest: bytes of a message and back with checks (wire/field_bytes.hpp),
// JSON and types of the page (dashboard/page_fields.hpp). `m` is const where fields are only read. A struct that
// cannot hold its table has a FieldsOf beside its message. A member `std::string contradiction() const` says in a
// sentence which fields do not go together, and nothing where all do.
//
// Calls of a table, in the order of the message:
//   field(name, value, check)          a value, a struct with a table, or an array
//   field.count(name, list, range)     how many elements the next arrays have
//   field.first(name, list, range)     the same where a message keeps the first of them only
//   field.columns(list, table)         a list of structs as an array per column
//   field.single(name, list, check)    an array of numbers in single precision
//   field.maybe(has, name, value, check)   an optional number behind its truth value
//   field.or_zero(name, value, check)      an optional number that is 0 when there is none
//   field.part(has, name, part)            an optional struct behind its truth value, its fields among the parent's
//   field.bits(name, flags...)             truth values as one number, the first its lowest bit
//   field.failure(ok, name, reason)        why something failed, behind the truth value that it did not

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/names.hpp"
#include "base/result.hpp"

namespace nacre {

/// What a member template is asked with; nothing is ever done with it.
struct FieldProbe {};

template <class T>
struct FieldsOf {};

template <class T>
concept HasOwnFields = requires(FieldProbe& probe, T& value) {
  T::fields(probe, value);
};

template <class T>
concept HasGivenFields = requires(FieldProbe& probe, T& value) {
  FieldsOf<T>::fields(probe, value);
};

template <class T>
concept HasFields = HasOwnFields<T> || HasGivenFields<T>;

/// Walks over the table of `value`.
template <class Walker, class T>
void walk_fields(Walker& walker, T& value) {
  using Struct = std::remove_const_t<T>;
  if constexpr (HasOwnFields<Struct>) {
    Struct::fields(walker, value);
  } else {
    FieldsOf<Struct>::fields(walker, value);
  }
}

// Checks say what is wrong with a value and what was expected; an empty text: nothing. An array's checks every element.

/// No limits.
struct Any {
  std::string operator()(const auto&) const { return {}; }
};

/// A closed range.
struct Range {
  double least;
  double most;
  std::string operator()(double value) const {
    if (value >= least && value <= most) return {};
    return fmt::format("{} is outside [{}, {}]", value, least, most);
  }
};

/// Of what is counted: more is a broken program.
inline constexpr Range kCounted{0.0, 1e9};

/// One of some words.
struct OneOf {
  std::span<const std::string_view> words;
  std::string operator()(std::string_view word) const {
    if (std::ranges::find(words, word) != words.end()) return {};
    std::string expected;
    for (const std::string_view each : words)
      expected += fmt::format("{}{}", expected.empty() ? "" : each == words.back() ? " or " : ", ", each);
    return fmt::format("\"{}\", expected {}", word, expected);
  }
};

/// A text that fits on a label and a line.
struct Name {
  std::size_t longest = 200;  ///< bytes
  std::string operator()(std::string_view name) const {
    if (name.empty() || name.size() > longest)
      return fmt::format("a text of 1 to {} bytes was expected, not {}", longest, name.size());
    return std::ranges::any_of(name, is_control) ? "holds a control character" : "";
  }
};

/// Which fields of a value do not go together; empty where all do.
template <class T>
std::string contradiction_in(const T& value) {
  if constexpr (requires { value.contradiction(); }) {
    return value.contradiction();
  } else if constexpr (requires { FieldsOf<T>::contradiction(value); }) {
    return FieldsOf<T>::contradiction(value);
  } else {
    return {};
  }
}

}  // namespace nacre
