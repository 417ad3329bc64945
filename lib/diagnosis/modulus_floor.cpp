#include "diagnosis/modulus_floor.hpp"

#include <optional>

#include "base/toml_file.hpp"

namespace nacre::diagnosis {

ModulusFloor modulus_floor_from(std::string_view toml, std::string_view source, tester::Fidelity fidelity) {
  const toml::table table = read_toml(toml, source);
  const auto section = table[tester::to_string(fidelity)];
  const auto number = [&](const char* key, double largest, std::optional<double> otherwise) {
    const auto value = section[key] ? section[key].value<double>() : otherwise;
    if (!value || !(*value >= 0.0) || *value > largest)
      throw InputError::format("{}: expected [{}] {}, a number between 0 and {}", source, tester::to_string(fidelity),
                               key, largest);
    return *value;
  };
  ModulusFloor floor;
  floor.log_modulus_sd = number("log_modulus_sd", 1.0, std::nullopt);
  floor.mesh_amplitude = number("mesh_amplitude", 10.0, 0.0);
  floor.mesh_remainder_sd = number("mesh_remainder_sd", 1.0, floor.log_modulus_sd);
  return floor;
}

ModulusFloor read_modulus_floor(const std::filesystem::path& file, tester::Fidelity fidelity) {
  return modulus_floor_from(read_file(file), file.string(), fidelity);
}

}  // namespace nacre::diagnosis
