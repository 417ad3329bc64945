#pragma once
// What the page gets: rows with a table of fields (base/fields.hpp), which gives their JSON (wire/field_json.hpp) and
// their types in TypeScript: an interface each.

#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "fabricate/price.hpp"
#include "game/design_states.hpp"
#include "game/round_growth.hpp"
#include "sysid/errors.hpp"
#include "wire/convert.hpp"
#include "wire/field_json.hpp"

namespace nacre::dashboard {

using wire::Json;

// Structs of lower modules that the page is sent as they are.
constexpr std::string_view page_name(const sysid::PredictionErrors*) { return "Errors"; }
constexpr std::string_view page_name(const wire::RoundSummary*) { return "Summary"; }
constexpr std::string_view page_name(const wire::ProposedDesign*) { return "Proposed"; }
constexpr std::string_view page_name(const wire::DiagnosedGain*) { return "Gain"; }
constexpr std::string_view page_name(const game::DesignState*) { return "DesignState"; }
constexpr std::string_view page_name(const fabricate::Price*) { return "Price"; }
constexpr std::string_view page_name(const game::Growth*) { return "Growth"; }
constexpr std::string_view page_name(const wire::HiddenCause*) { return "HiddenCause"; }

/// The interface of a struct.
template <class T>
constexpr std::string_view page_name_of() {
  if constexpr (requires { T::kPageName; }) {
    return T::kPageName;
  } else {
    return page_name(static_cast<const T*>(nullptr));
  }
}

/// What a row refers to before it is given anything.
template <class T>
const T& nothing() {
  static const T value{};
  return value;
}

/// A row of `Row{element}` per element.
template <class Row, class List>
std::vector<Row> rows_of(const List& list) {
  std::vector<Row> rows;
  for (const auto& element : list) rows.push_back(Row{&element});
  return rows;
}

/// Writes interfaces, each once and behind those that it needs.
class PageTypes {
 public:
  /// What a value of type T is called; adds the interfaces that it needs.
  template <class T>
  std::string type_of() {
    if constexpr (wire::IsOptional<T>::value) {
      return type_of<typename T::value_type>() + " | null";
    } else if constexpr (std::is_same_v<T, bool>) {
      return "boolean";
    } else if constexpr (std::is_arithmetic_v<T>) {
      return "number";
    } else if constexpr (std::is_convertible_v<T, std::string_view> || wire::HasText<T>) {
      return "string";
    } else if constexpr (HasFields<T>) {
      return type_of_struct<T>();
    } else if constexpr (std::is_same_v<T, std::array<double, 2>>) {
      return "[number, number]";
    } else if constexpr (wire::IsSequence<T>) {
      const std::string element = type_of<typename T::value_type>();
      return (element.find('|') == std::string::npos ? element : "(" + element + ")") + "[]";
    } else {
      return "Record<string, " + type_of<typename T::mapped_type>() + ">";
    }
  }
  const std::string& text() const { return text_; }

 private:
  /// Collects the members of one struct.
  struct Members {
    PageTypes& types;
    std::string text;
    template <class T>
    void operator()(std::string_view name, const T&, const auto&...) {
      add(name, types.type_of<std::remove_cvref_t<T>>());
    }
    /// Words that a text is chosen from.
    template <class T>
    void operator()(std::string_view name, const T&, const OneOf& choice) {
      std::string words;
      for (const std::string_view word : choice.words)
        words += fmt::format("{}\"{}\"", words.empty() ? "" : " | ", word);
      add(name, words);
    }
    void count(auto&&...) {}
    void first(auto&&...) {}
    void single(std::string_view name, const auto& list, const auto&...) { (*this)(name, list); }
    void maybe(std::string_view, std::string_view name, const auto& value, const auto&...) { (*this)(name, value); }
    void or_zero(std::string_view name, const auto& value, const auto&...) { (*this)(name, value); }
    void part(std::string_view, std::string_view name, const auto& part) { (*this)(name, part); }
    void failure(std::string_view, std::string_view name, const std::string& reason) { (*this)(name, reason); }
    void add(std::string_view name, const std::string& type) { text += fmt::format("  {}: {};\n", name, type); }
  };

  template <class T>
  std::string type_of_struct() {
    const std::string name(page_name_of<T>());
    if (!known_.contains(name)) {
      Members members{*this, {}};
      walk_fields(members, nothing<T>());
      known_.insert(name);
      text_ += fmt::format("\nexport interface {} {{\n{}}}\n", name, members.text);
    }
    return name + (wire::kMayHoldNothing<T> ? " | null" : "");
  }

  std::string text_;
  std::set<std::string> known_;
};

/// web/src/page_types.ts.
std::string page_types();

}  // namespace nacre::dashboard
