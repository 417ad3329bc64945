#pragma once
// Messages as JSON, with a JSON Schema that says of every member what it is, both by the message's table of fields
// (base/fields.hpp). For readers that know nothing of nacre: a member that may be absent is left out, never null, since
// viewers know one type per member.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "wire/convert.hpp"
#include "wire/field_json.hpp"
#include "wire/header.hpp"

namespace nacre {

template <>
struct FieldsOf<wire::Header> {
  static void fields(auto& field, auto& m) {
    field("utime", m.utime);
    field("node", m.node);
    field("epoch", m.epoch);
    field("seq", m.seq);
    field("run_id", m.run_id);
  }
};

}  // namespace nacre

namespace nacre::wire {

/// The value without members that are null, at any depth.
Json without_nulls(const Json& value);

// What a check says in a schema; most say nothing there.
void add_check(Json&, const auto&...) {}
inline void add_check(Json& schema, const Range& range) {
  const bool is_whole = schema["type"] == "integer";
  schema["minimum"] = is_whole ? Json(static_cast<std::int64_t>(range.least)) : Json(range.least);
  schema["maximum"] = is_whole ? Json(static_cast<std::int64_t>(range.most)) : Json(range.most);
}
inline void add_check(Json& schema, const OneOf& choice) {
  schema["enum"] = std::vector<std::string>(choice.words.begin(), choice.words.end());
}

template <class T>
Json schema_of_struct();

/// The schema of values of type T; the check is that of every element of an array.
template <class T>
Json schema_of(const auto&... check) {
  if constexpr (IsOptional<T>::value) {
    return schema_of<typename T::value_type>(check...);
  } else if constexpr (HasFields<T>) {
    return schema_of_struct<T>();
  } else if constexpr (IsSequence<T>) {
    Json array = Json::object();
    array["type"] = "array";
    array["items"] = schema_of<typename T::value_type>(check...);
    if constexpr (requires { std::tuple_size<T>::value; })
      array["minItems"] = array["maxItems"] = std::tuple_size<T>::value;
    return array;
  } else {
    constexpr bool kIsText = HasText<T> || std::is_convertible_v<T, std::string_view>;
    Json value = Json::object();
    value["type"] = std::is_same_v<T, bool> ? "boolean"
                    : kIsText               ? "string"
                    : std::is_integral_v<T> ? "integer"
                                            : "number";
    add_check(value, check...);
    return value;
  }
}

/// Collects the members of one struct, as FieldJson does.
class MemberSchemas {
 public:
  Json properties = Json::object();
  Json required = Json::array();

  template <class T>
  void operator()(std::string_view name, const T&, const auto&... check) {
    constexpr bool kMayBeAbsent = IsOptional<T>::value || kMayHoldNothing<T>;
    add(name, schema_of<std::remove_cvref_t<T>>(check...), !kMayBeAbsent);
  }
  void count(auto&&...) {}
  void first(auto&&...) {}
  void single(std::string_view name, const auto& list, const auto&... check) { (*this)(name, list, check...); }
  template <class Element>
  void columns(const std::vector<Element>&, const auto& table) {
    Columns columns{*this};
    table(columns, static_cast<const Element&>(Element{}));
  }
  void bits(std::string_view name, const auto&...) { add(name, schema_of<int>(), true); }
  void maybe(std::string_view, std::string_view name, const auto&... value) { (*this)(name, value...); }
  void or_zero(std::string_view name, const auto&... value) { (*this)(name, value...); }
  void part(std::string_view, std::string_view name, const auto& part) { (*this)(name, part); }
  void failure(std::string_view, std::string_view name, const std::string& reason) { (*this)(name, reason); }

 private:
  struct Columns {
    MemberSchemas& members;
    template <class T>
    void operator()(std::string_view name, const T&, const auto&... check) {
      members.add(name, schema_of<std::vector<T>>(check...), true);
    }
    void single(std::string_view name, const auto& value, const auto&... check) { (*this)(name, value, check...); }
  };

  void add(std::string_view name, Json schema, bool is_required) {
    properties[std::string(name)] = std::move(schema);
    if (is_required) required.push_back(name);
  }
};

template <class T>
Json schema_of_struct() {
  MemberSchemas members;
  const T nothing{};
  walk_fields(members, nothing);
  return {{"type", "object"}, {"properties", members.properties}, {"required", members.required}};
}

/// The schema of a whole message. The header is not required: what a node says stands in its journal without one.
template <class Message>
Json schema_of_message() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", Message::Wire::getTypeName()}};
  Json fields = schema_of_struct<Message>();
  Json properties = Json::object();
  properties["header"] = schema_of_struct<Header>();
  properties.update(fields["properties"]);
  fields["properties"] = std::move(properties);
  schema.update(fields);
  return schema;
}

/// A message's fields, without header; the error is that of read().
template <class Message>
Result<Json> json_of_message(std::string_view payload) {
  const Result<Message> message = read<Message>(payload);
  if (!message) return tl::unexpected(message.error());
  return without_nulls(json_of(*message));
}

}  // namespace nacre::wire
