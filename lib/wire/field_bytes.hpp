#pragma once
// Fields <-> bytes of a message, by the struct's table (base/fields.hpp). LCM writes values one after the other, the
// highest byte first; texts have their length and a closing zero. Which bytes a value takes follows from its type:
//
//   bool 1, int 4, std::int64_t 8, double 8; Fidelity, TestKind and CriterionKind 1; a Pattern 8; texts, Designs and
//   Loadings a text
//
// unit.wire holds every table to the .lcm file of its message.

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/fields.hpp"
#include "base/result.hpp"
#include "material/failure_criterion.hpp"
#include "pattern/design.hpp"
#include "tester/loading.hpp"
#include "tester/names.hpp"

namespace nacre::wire {

template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};
template <class T, std::size_t size>
struct IsList<std::array<T, size>> : std::true_type {};  // as long as the .lcm file says

/// One column of a list of structs: does `Action` to the field number `wanted` of a table.
template <class Action>
struct ColumnWalker {
  int wanted;
  Action& action;
  int seen = 0;
  void operator()(std::string_view name, auto& value, const auto&... check) {
    if (seen++ == wanted) action(name, value, check...);
  }
  void single(std::string_view name, auto& value, const auto&... check) {
    if (seen++ == wanted) action.single_value(name, value, check...);
  }
};

struct NoAction {
  void operator()(auto&&...) {}
  void single_value(auto&&...) {}
};

/// Number of fields in a table of columns.
template <class Element>
int column_count(const auto& table) {
  NoAction nothing;
  ColumnWalker<NoAction> walker{-1, nothing};
  Element element{};
  table(walker, element);
  return walker.seen;
}

/// Appends fields. A text longer than a message may hold is cut, and ends before a zero byte. Arrays that share a count
/// and differ in length throw std::logic_error.
class FieldWriter {
 public:
  explicit FieldWriter(std::string& bytes) : bytes_(bytes) {}

  void operator()(std::string_view name, const auto& value, const auto&...) { put(name, value); }
  void count(std::string_view, const auto& list, const auto&...) { put_count(list.size()); }
  void first(std::string_view, const auto& list, const Range& range) {
    put_count(std::min(list.size(), static_cast<std::size_t>(range.most)));
    is_cut_ = count_ < list.size();
  }
  void single(std::string_view name, const std::vector<double>& values, const auto&...) {
    check_length(name, values.size());
    for (const double value : values) put_single(value);
  }
  template <class Element>
  void columns(const std::vector<Element>& list, const auto& table) {
    check_length("columns", list.size());
    const int columns = column_count<Element>(table);
    for (int column = 0; column < columns; ++column)
      for (std::size_t i = 0; i < count_; ++i) {
        ColumnWalker<FieldWriter> walker{column, *this};
        table(walker, list[i]);
      }
  }
  void maybe(std::string_view, std::string_view, const std::optional<double>& value, const auto&...) {
    put_value(value.has_value());
    put_value(value.value_or(0.0));
  }
  void or_zero(std::string_view, const std::optional<double>& value, const auto&...) { put_value(value.value_or(0.0)); }
  template <class Part>
  void part(std::string_view, std::string_view, const std::optional<Part>& part) {
    static const Part kNone{};
    put_value(part.has_value());
    walk_fields(*this, part ? *part : kNone);
  }
  void bits(std::string_view, const auto&... flags) {
    int bit = 0, number = 0;
    ((number |= (flags ? 1 : 0) << bit++), ...);
    put_integer(number, 1);
  }
  void failure(std::string_view, std::string_view, const std::string& reason) {
    put_value(reason.empty());
    put_value(reason);
  }
  void single_value(std::string_view, double value, const auto&...) { put_single(value); }

 private:
  template <class T>
  void put(std::string_view name, const T& value) {
    if constexpr (IsList<T>::value) {
      constexpr bool kIsCounted = requires { value.capacity(); };
      if (kIsCounted) check_length(name, value.size());
      for (std::size_t i = 0; i < (kIsCounted ? count_ : value.size()); ++i) put(name, value[i]);
    } else if constexpr (HasFields<T>) {
      const std::size_t count = std::exchange(count_, 0);
      const bool is_cut = std::exchange(is_cut_, false);
      walk_fields(*this, value);
      count_ = count;
      is_cut_ = is_cut;
    } else {
      put_value(value);
    }
  }

  void put_value(bool value) { put_integer(value ? 1 : 0, 1); }
  void put_value(int value) { put_integer(value, 4); }
  void put_value(std::int64_t value) { put_integer(value, 8); }
  void put_value(tester::Fidelity value) { put_integer(static_cast<int>(value), 1); }
  void put_value(tester::TestKind value) { put_integer(static_cast<int>(value), 1); }
  void put_value(material::CriterionKind value) { put_integer(static_cast<int>(value), 1); }
  void put_value(const pattern::Pattern& value) { put_integer(value.bits(), 8); }
  void put_value(double value);
  void put_value(const std::string& value);
  void put_value(const pattern::Design& value) { put_value(value.name()); }
  void put_value(const tester::Loading& value) { put_value(tester::to_string(value)); }
  void put_single(double value);
  void put_integer(std::int64_t value, int size);
  void put_count(std::size_t count);
  void check_length(std::string_view name, std::size_t length) const;

  std::string& bytes_;
  std::size_t count_ = 0;  ///< of the next arrays
  bool is_cut_ = false;    ///< they may be longer
};

/// Takes fields from bytes and checks them; stops at the first fault, which names the field.
class FieldReader {
 public:
  explicit FieldReader(std::string_view bytes) : bytes_(bytes) {}

  /// A struct with all that its table and its contradiction() ask for; ends at the first fault, which it returns: ":
  /// what is wrong" of the struct as a whole, or ".member: what is wrong".
  template <class T>
  std::string get_struct(T& value) {
    const std::size_t count = std::exchange(count_, 0);
    walk_fields(*this, value);
    if (fault_.empty() && checks_) {
      const std::string why = contradiction_in(value);
      if (!why.empty()) fault_ = ": " + why;
    }
    count_ = count;
    return std::exchange(fault_, {});
  }

  /// The struct cannot be made of its fields.
  void refuse(const std::string& why) {
    if (fault_.empty()) fault_ = ": " + why;
  }
  template <class T, class Check = Any>
  void operator()(std::string_view name, T& value, const Check& check = {}) {
    if (fault_.empty()) keep_fault(name, get(value, check));
  }
  template <class List>
  void count(std::string_view name, const List&, const Range& range = kCounted) {
    int number = 0;
    (*this)(name, number, range);
    if (!fault_.empty()) return;
    if (number < 0 || static_cast<std::size_t>(number) > bytes_.size())
      fault_ = fmt::format(".{}: length {} does not fit the message", name, number);
    else
      count_ = number;
  }
  void first(std::string_view name, const auto& list, const Range& range) { count(name, list, range); }
  template <class Check = Any>
  void single(std::string_view name, std::vector<double>& values, const Check& check = {}) {
    values.resize(fault_.empty() ? count_ : 0);
    for (std::size_t i = 0; i < values.size() && fault_.empty(); ++i) {
      const std::string fault = get_single(values[i], check);
      if (!fault.empty()) keep_fault(name, fmt::format("[{}]{}", i, fault));
    }
  }
  template <class Element>
  void columns(std::vector<Element>& list, const auto& table) {
    list.resize(fault_.empty() ? count_ : 0);
    const int columns = column_count<Element>(table);
    for (int column = 0; column < columns; ++column)
      for (std::size_t i = 0; i < list.size() && fault_.empty(); ++i) {
        ColumnWalker<FieldReader> walker{column, *this};
        table(walker, list[i]);
        if (!fault_.empty()) fault_.insert(fault_.find(':'), fmt::format("[{}]", i));
      }
  }
  template <class Check = Any>
  void maybe(std::string_view has, std::string_view name, std::optional<double>& value, const Check& check = {}) {
    bool is_there = false;
    double number = 0.0;
    (*this)(has, is_there);
    (*this)(name, number, check);
    value = is_there ? std::optional<double>(number) : std::nullopt;
  }
  template <class Check = Any>
  void or_zero(std::string_view name, std::optional<double>& value, const Check& check = {}) {
    double number = 0.0;
    (*this)(name, number, check);
    value = number > 0.0 ? std::optional<double>(number) : std::nullopt;
  }
  template <class Part>
  void part(std::string_view has, std::string_view, std::optional<Part>& part) {
    bool is_there = false;
    (*this)(has, is_there);
    const bool checks = std::exchange(checks_, checks_ && is_there);  // what is not there need not be sound
    walk_fields(*this, part.emplace());
    checks_ = checks;
    if (!is_there) part.reset();
  }
  template <class... Flags>
  void bits(std::string_view name, Flags&... flags) {
    constexpr int kMost = (1 << sizeof...(Flags)) - 1;
    std::int64_t number = 0;
    if (!fault_.empty()) return;
    keep_fault(name, get_integer(number, 1));
    if (fault_.empty() && (number < 0 || number > kMost))
      keep_fault(name, fmt::format(": {} is outside [0, {}]", number, kMost));
    int bit = 0;
    ((flags = (number >> bit++ & 1) != 0), ...);
  }
  void failure(std::string_view ok, std::string_view name, std::string& reason) {
    bool is_sound = false;
    (*this)(ok, is_sound);
    (*this)(name, reason);
    if (fault_.empty() && is_sound != reason.empty())
      fault_ = fmt::format(": {} and {} contradict each other", ok, name);
  }
  template <class Check = Any>
  void single_value(std::string_view name, double& value, const Check& check = {}) {
    if (fault_.empty()) keep_fault(name, get_single(value, check));
  }

 private:
  template <class T, class Check>
  std::string get(T& value, const Check& check) {
    if constexpr (IsList<T>::value) {
      if constexpr (requires { value.resize(count_); }) value.resize(count_);
      for (std::size_t i = 0; i < value.size(); ++i)
        if (std::string fault = get(value[i], check); !fault.empty()) return fmt::format("[{}]{}", i, fault);
      return {};
    } else if constexpr (HasFields<T>) {
      return get_struct(value);
    } else {
      std::string fault = get_value(value);
      if (!fault.empty() || !checks_) return fault;
      fault = check(value);
      return fault.empty() ? fault : ": " + fault;
    }
  }

  std::string get_value(bool& value);
  std::string get_value(int& value);
  std::string get_value(std::int64_t& value);
  std::string get_value(double& value);
  std::string get_value(std::string& value);
  std::string get_value(tester::Fidelity& value);
  std::string get_value(tester::TestKind& value);
  std::string get_value(material::CriterionKind& value);
  std::string get_value(pattern::Pattern& value);
  std::string get_value(pattern::Design& value);
  std::string get_value(tester::Loading& value);
  std::string get_single_value(double& value);
  std::string get_integer(std::int64_t& value, int size);
  std::string get_single(double& value, const auto& check) {
    std::string fault = get_single_value(value);
    if (!fault.empty() || !checks_) return fault;
    fault = check(value);
    return fault.empty() ? fault : ": " + fault;
  }
  void keep_fault(std::string_view name, std::string fault) {
    if (!fault.empty()) fault_ = fmt::format(".{}{}", name, fault);
  }

  std::string_view bytes_;  ///< what is left
  std::string fault_;       ///< as get_struct() returns it; empty while all is sound
  std::size_t count_ = 0;   ///< of the next arrays
  bool checks_ = true;
};

/// Enumerations are numbers on the wire.
Result<tester::Fidelity> fidelity_of_code(std::int64_t code);
Result<tester::TestKind> test_kind_of_code(std::int64_t code);
Result<material::CriterionKind> criterion_of_code(std::int64_t code);

}  // namespace nacre::wire
