#include "game/starting_point.hpp"

namespace nacre::game {

material::StartingModel starting_model(const Scenario& scenario) {
  return material::starting_model(scenario.model_file, scenario.ranges_file);
}

}  // namespace nacre::game
