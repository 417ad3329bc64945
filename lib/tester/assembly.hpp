#pragma once
// From a design to the finite-element grid (thesis 2.3.1, Figure 2-5C): element (2i, 2j) is the centre of pixel (i, j),
// counted from the bottom-left; an element with an odd index lies between pixels.

#include <vector>

#include "fem/grid.hpp"
#include "material/mixture.hpp"
#include "material/parameters.hpp"
#include "pattern/design.hpp"
#include "tester/printed_unit.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// Which tester the grid is for: `modulus` takes theta and thresholds of infinity, `toughness` takes eta.
enum class AssemblyTarget { modulus, toughness };

/// The grid of a specimen of units_x x units_y units, every element split into refinement x refinement (same physical
/// geometry, thresholds times refinement so that the fracture energy is shared), with all material-side extensions that
/// act on the assignment of properties. No notch. columns = 40 * units_x * refinement, rows likewise; the pulling
/// direction is the grid's y; orientation 90 is the same specimen, outline and layout, printed lying along the
/// printer's x. The parameters must be usable (material::parameter_fault empty) and the orientation 0 or 90.
fem::Grid assemble(const pattern::Design& design, const material::ParameterSet& parameters,
                   const TestConditions& conditions, AssemblyTarget target, int units_x, int units_y,
                   int refinement = 1);

/// What the modulus tester makes of one unit of a layout: the same numbers as in assemble().
struct UnitOfModulus {
  std::vector<material::Constants> kinds;  ///< of elements, each once
  std::vector<int> kind_of;                ///< of every element of the unit, row by row
};
UnitOfModulus unit_of_modulus(const pattern::Layout& layout, const material::ParameterSet& parameters,
                              const TestConditions& conditions, int refinement);

/// A square part of an endless specimen of a layout at usual conditions: count x count elements from element (first,
/// first) of a unit on, first >= -kElementsPerUnit; elastic constants and thresholds alone. Same numbers as in
/// assemble().
fem::Grid assemble_elastic_part(const pattern::Layout& layout, const material::ParameterSet& parameters,
                                AssemblyTarget target, int first, int count);

/// Constants of a homogeneous coupon in an elastic test, with the extensions that act on them: at its strain rate, by
/// the law of blends.
material::Constants elastic_coupon_constants(const material::ModulusParameters& theta, const pattern::Mixture& mixture,
                                             const material::Extensions& extensions, const TestConditions& conditions);
/// The same where a strain has been held for `time_s` after a step.
material::Constants held_coupon_constants(const material::ModulusParameters& theta, const pattern::Mixture& mixture,
                                          const material::Extensions& extensions, const TestConditions& conditions,
                                          double time_s);

}  // namespace nacre::tester
