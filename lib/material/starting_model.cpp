#include "material/starting_model.hpp"

#include "material/criterion_strengths.hpp"
#include "material/parameter_file.hpp"

namespace nacre::material {

StartingModel starting_model(const ParameterReader& read, const std::filesystem::path& ranges) {
  StartingModel model{.parameters = default_parameters(read(default_parameters()).criterion), .ranges = {}};
  model.ranges = ranges_for(model.parameters.criterion);
  if (!ranges.empty()) model.ranges = read_ranges(ranges, model.ranges);
  model.parameters = read(brought_inside(model.parameters, model.ranges));
  return model;
}

StartingModel starting_model(const std::filesystem::path& parameters, const std::filesystem::path& ranges) {
  const auto read = [&](const ParameterSet& start) {
    return parameters.empty() ? start : read_parameters(parameters, start);
  };
  return starting_model(ParameterReader(read), ranges);
}

}  // namespace nacre::material
