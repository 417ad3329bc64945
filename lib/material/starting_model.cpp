#include "material/starting_model.hpp"

#include "material/criterion_strengths.hpp"
#include "material/parameter_file.hpp"

namespace nacre::material {

StartingModel starting_model(const std::filesystem::path& parameters, const std::filesystem::path& ranges) {
  StartingModel model{.parameters = default_parameters(), .ranges = {}};
  if (!parameters.empty())
    model.parameters = default_parameters(read_parameters(parameters, model.parameters).criterion);
  model.ranges = ranges_for(model.parameters.criterion);
  if (!ranges.empty()) model.ranges = read_ranges(ranges, model.ranges);
  model.parameters = brought_inside(model.parameters, model.ranges);
  if (!parameters.empty()) model.parameters = read_parameters(parameters, model.parameters);
  return model;
}

}  // namespace nacre::material
