#include "game/starting_point.hpp"

#include "material/parameter_file.hpp"

namespace nacre::game {

material::ParameterRanges ranges_of(const Scenario& scenario) {
  return scenario.ranges_file.empty() ? material::thesis_ranges() : material::read_ranges(scenario.ranges_file);
}

material::ParameterSet starting_model(const Scenario& scenario) {
  const material::ParameterSet inside = material::brought_inside(material::default_parameters(), ranges_of(scenario));
  return scenario.model_file.empty() ? inside : material::read_parameters(scenario.model_file, inside);
}

}  // namespace nacre::game
