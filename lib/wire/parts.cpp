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

material::ParameterSet parameter_set(const material::ModulusVector& modulus, const material::ToughnessVector& toughness,
                                     const std::vector<Extension>& extensions) {
  material::ParameterSet set{material::modulus_from_vector(modulus), material::toughness_from_vector(toughness), {}};
  for (const Extension& each : extensions) set.extensions.emplace(each.name, each.values);
  return set;
}

}  // namespace nacre::wire
