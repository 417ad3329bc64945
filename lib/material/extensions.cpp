#include "material/extensions.hpp"

#include <array>

namespace nacre::material {
namespace {

constexpr std::array kInterfaceAnisotropy = {EffectParameter{
    "(x - y)/(x + y) of the interface's stiffness and strength, x and y being the printer's axes", "1", -0.8, 0.8}};
constexpr std::array kDropletMixing = {
    EffectParameter{"side of the square over which material fractions are averaged", "pixels", 0.0, 4.0}};
constexpr std::array kMachineCompliance = {
    EffectParameter{"strain per nominal stress of the load train", "1/Pa", 0.0, 2e-9}};

// In the order in which they are reported. An effect stands here once all its code does: material-side ones in
// tester::assemble (and in the solvers where a law changes), measurement-side ones in measurement::observe_*.
constexpr std::array kLibrary = {
    Effect{.name = "interface_anisotropy",
           .family = "interface",
           .side = EffectSide::material,
           .parameters = kInterfaceAnisotropy,
           .acts_on_modulus = true,
           .acts_on_toughness = true,
           .explanation =
               "Interfaces between x-neighbours and between y-neighbours differ in stiffness and strength; shows in "
               "rotated twins and in runs along against across the load."},
    Effect{.name = "droplet_mixing",
           .family = "geometry",
           .side = EffectSide::material,
           .parameters = kDropletMixing,
           .acts_on_modulus = true,
           .acts_on_toughness = true,
           .explanation =
               "Droplets of the two materials mix over some pixels before they cure; depends on run length, not on "
               "the rigid fraction."},
    Effect{.name = "machine_compliance",
           .family = "measurement",
           .side = EffectSide::measurement,
           .parameters = kMachineCompliance,
           .acts_on_modulus = true,
           .acts_on_toughness = true,
           .explanation =
               "A spring in series with the specimen: the error grows with stiffness, in loading and unloading alike."},
};

}  // namespace

std::span<const Effect> effect_library() { return kLibrary; }

const Effect* find_effect(std::string_view name) {
  for (const Effect& effect : kLibrary)
    if (effect.name == name) return &effect;
  return nullptr;
}

double extension_value(const Extensions& extensions, std::string_view name, int index) {
  const auto found = extensions.find(name);
  if (found == extensions.end() || index >= static_cast<int>(found->second.size())) return 0.0;
  return found->second[static_cast<std::size_t>(index)];
}

}  // namespace nacre::material
