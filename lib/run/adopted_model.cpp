#include "run/adopted_model.hpp"

#include <fmt/format.h>

#include "game/model.hpp"

namespace nacre::run {

material::Extensions extensions_of(const RoundRecord& round) {
  return round.model ? round.model->parameters.extensions : material::Extensions{};
}

std::vector<optimize::Performance> line_as_measured(const RoundRecord& round) {
  if (!round.model) return {};
  std::vector<optimize::Performance> line = round.model->benchmark;
  for (optimize::Performance& point : line) point = game::through_machine(point, round.model->parameters);
  return line;
}

std::map<std::string, double> named_parameters(const material::ParameterSet& parameters) {
  std::map<std::string, double> named;
  const auto theta = to_vector(parameters.modulus);
  for (std::size_t i = 0; i < theta.size(); ++i)
    named[fmt::format("modulus.{}", material::modulus_parameter_names()[i])] = theta[i];
  const auto eta = to_vector(parameters.toughness);
  for (std::size_t i = 0; i < eta.size(); ++i)
    named[fmt::format("toughness.{}", material::toughness_parameter_names()[i])] = eta[i];
  for (const auto& [name, values] : parameters.extensions)
    for (std::size_t i = 0; i < values.size(); ++i)
      named[fmt::format("extension.{}{}", name, values.size() > 1 ? fmt::format(".{}", i) : "")] = values[i];
  return named;
}

}  // namespace nacre::run
