#pragma once
// Values and tables of fields (base/fields.hpp) as JSON. Designs, patterns, kinds of test, fidelities and loadings are
// their texts; what is absent is null, and so is a struct whose FieldsOf has a holds_nothing() that says so. SI units.

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/fields.hpp"
#include "material/failure_criterion.hpp"
#include "pattern/design.hpp"
#include "tester/loading.hpp"
#include "tester/names.hpp"

namespace nacre::wire {

using Json = nlohmann::ordered_json;

inline std::string text_of(const pattern::Design& design) { return design.name(); }
inline std::string text_of(const pattern::Pattern& pattern) { return pattern.key(); }
inline std::string text_of(const tester::Loading& loading) { return tester::to_string(loading); }
inline std::string text_of(tester::Fidelity fidelity) { return std::string(tester::to_string(fidelity)); }
inline std::string text_of(tester::TestKind kind) { return std::string(tester::to_string(kind)); }
inline std::string text_of(material::CriterionKind kind) { return std::string(material::to_string(kind)); }

template <class T>
concept HasText = requires(const T& value) {
  text_of(value);
};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

/// Arrays and vectors of whatever json_of() takes, texts not among them.
template <class T>
concept IsSequence =
    !std::is_convertible_v<T, std::string_view> && !std::is_same_v<T, Json> && requires(const T& list) {
  list.begin();
  list.size();
  requires !requires { typename T::mapped_type; };
};

/// A struct of which a value may say that there is nothing in it.
template <class T>
concept kMayHoldNothing = requires(const T& value) {
  FieldsOf<T>::holds_nothing(value);
};

template <class T>
Json json_of(const T& value);

/// Adds fields to an object.
class FieldJson {
 public:
  explicit FieldJson(Json& object) : object_(object) {}

  void operator()(std::string_view name, const auto& value, const auto&...) {
    object_[std::string(name)] = json_of(value);
  }
  void count(auto&&...) {}
  void first(auto&&...) {}
  void single(std::string_view name, const auto& list, const auto&...) { (*this)(name, list); }
  /// An array per column.
  template <class Element>
  void columns(const std::vector<Element>& list, const auto& table) {
    Column column{object_};
    table(column, static_cast<const Element&>(Element{}));
    for (const Element& element : list) {
      column.is_beginning = false;
      table(column, element);
    }
  }
  /// The number that stands in the message.
  void bits(std::string_view name, const auto&... flags) {
    int bit = 0, number = 0;
    ((number |= (flags ? 1 : 0) << bit++), ...);
    object_[std::string(name)] = number;
  }
  void maybe(std::string_view, std::string_view name, const auto& value, const auto&...) { (*this)(name, value); }
  void or_zero(std::string_view name, const auto& value, const auto&...) { (*this)(name, value); }
  void part(std::string_view, std::string_view name, const auto& part) { (*this)(name, part); }
  void failure(std::string_view, std::string_view name, const std::string& reason) { (*this)(name, reason); }

 private:
  /// Begins arrays, then appends to them.
  struct Column {
    Json& object;
    bool is_beginning = true;
    void operator()(std::string_view name, const auto& value, const auto&...) {
      Json& array = object[std::string(name)];
      if (is_beginning) {
        array = Json::array();
      } else {
        array.push_back(json_of(value));
      }
    }
    void single(std::string_view name, const auto& value, const auto&...) { (*this)(name, value); }
  };

  Json& object_;
};

template <class T>
Json json_of(const T& value) {
  if constexpr (IsOptional<T>::value) {
    return value ? json_of(*value) : Json(nullptr);
  } else if constexpr (HasText<T>) {
    return text_of(value);
  } else if constexpr (HasFields<T>) {
    if constexpr (kMayHoldNothing<T>) {
      if (FieldsOf<T>::holds_nothing(value)) return nullptr;
    }
    Json object = Json::object();
    FieldJson fields(object);
    walk_fields(fields, value);
    return object;
  } else if constexpr (IsSequence<T>) {
    Json array = Json::array();
    for (const auto& element : value) array.push_back(json_of(element));
    return array;
  } else if constexpr (requires { typename T::mapped_type; } && !std::is_same_v<T, Json>) {
    Json object = Json::object();
    for (const auto& [name, element] : value) object[std::string(name)] = json_of(element);
    return object;
  } else {
    return value;
  }
}

}  // namespace nacre::wire
