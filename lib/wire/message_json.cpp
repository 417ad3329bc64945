#include "wire/message_json.hpp"

namespace nacre::wire {

Json without_nulls(const Json& value) {
  if (!value.is_structured()) return value;
  Json result = value.is_array() ? Json::array() : Json::object();
  for (const auto& [name, element] : value.items()) {
    if (value.is_array()) {
      result.push_back(without_nulls(element));
    } else if (!element.is_null()) {
      result[name] = without_nulls(element);
    }
  }
  return result;
}

}  // namespace nacre::wire
