#include "wire/parts.hpp"

#include <set>

namespace nacre::wire {

std::vector<Extension> listed(const material::Extensions& extensions) {
  std::vector<Extension> list;
  for (const auto& [name, values] : extensions) list.push_back({name, values});
  return list;
}

std::string name_twice(const std::vector<Extension>& extensions) {
  std::set<std::string_view> seen;
  for (const Extension& each : extensions)
    if (!seen.insert(each.name).second) return each.name;
  return {};
}

material::Extensions by_name(const std::vector<Extension>& extensions) {
  material::Extensions named;
  for (const Extension& each : extensions) named.emplace(each.name, each.values);
  return named;
}

}  // namespace nacre::wire
