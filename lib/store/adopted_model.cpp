#include "store/adopted_model.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "game/model.hpp"

namespace nacre::store {

material::Extensions extensions_of(const RoundRecord& round) {
  constexpr std::string_view kPrefix = "extension.";
  material::Extensions extensions;
  for (const auto& [key, value] : round.parameters) {
    if (!key.starts_with(kPrefix)) continue;
    std::string name = key.substr(kPrefix.size());
    std::size_t index = 0;
    if (const auto dot = name.rfind('.'); dot != std::string::npos) {
      std::from_chars(name.data() + dot + 1, name.data() + name.size(), index);
      name.resize(dot);
    }
    const material::Effect* effect = material::find_effect(name);
    if (effect == nullptr || index >= effect->parameters.size()) continue;
    std::vector<double>& values = extensions[name];
    values.resize(std::max(values.size(), index + 1));
    values[index] = value;
  }
  return extensions;
}

std::vector<optimize::Performance> line_as_measured(const RoundRecord& round) {
  material::ParameterSet model;
  model.extensions = extensions_of(round);
  std::vector<optimize::Performance> line = round.benchmark;
  for (optimize::Performance& point : line) point = game::through_machine(point, model);
  return line;
}

}  // namespace nacre::store
