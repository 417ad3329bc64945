#include "tester/assembly.hpp"

#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>

#include "material/blend_law.hpp"
#include "material/confinement.hpp"
#include "material/extended_law.hpp"
#include "material/extensions.hpp"
#include "material/rate_laws.hpp"
#include "tester/printed_unit.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {
namespace {

fem::Phase nearest_phase(double rigid_fraction) {
  return rigid_fraction < 0.25 ? fem::Phase::soft : rigid_fraction <= 0.75 ? fem::Phase::interface : fem::Phase::rigid;
}

void set_element(fem::Grid& grid, std::size_t e, const material::Constants& constants, fem::Phase phase,
                 int refinement) {
  grid.phase[e] = phase;
  grid.young_pa[e] = constants.young_pa;
  grid.poisson[e] = constants.poisson;
  grid.threshold_j_per_m3[e] = constants.threshold_j_per_m3 * refinement;
}

fem::Grid empty_grid(int columns, int rows, int refinement) {
  fem::Grid grid{.columns = columns,
                 .rows = rows,
                 .element_size_m = thesis::kElementSize / refinement,
                 .phase = {},
                 .young_pa = {},
                 .poisson = {},
                 .threshold_j_per_m3 = {}};
  const auto count = static_cast<std::size_t>(grid.element_count());
  grid.phase.resize(count);
  grid.young_pa.resize(count);
  grid.poisson.resize(count);
  grid.threshold_j_per_m3.resize(count);
  return grid;
}

/// Factor on stiffness and strength of a cell's interface under `interface_anisotropy` (grid axes): the geometric mean
/// where the cell holds several.
double anisotropy_factor(double share_x, double share_y, double anisotropy) {
  if (share_x == 1.0) return 1.0 + anisotropy;
  if (share_y == 1.0) return 1.0 - anisotropy;
  if (share_x == 0.0 && share_y == 0.0) return 1.0;
  return std::exp(share_x * std::log1p(anisotropy) + share_y * std::log1p(-anisotropy));
}

/// Mixed material is assigned in cells of half an element at most: across a steep gradient the law of mixtures bends so
/// much that one value at an element's mean fraction is off by a factor. (h against h/2, 12 patterns, 0.6 pixels: 17 +-
/// 7 % in E before, -0.6 +- 1.5 % now.)
int cells_per_side(double blur_pixels, int refinement) { return blur_pixels > 0.0 && refinement == 1 ? 2 : 1; }

/// Boundaries that were moved by parts of an element are resolved in cells of a quarter of it.
constexpr int kOverprintCells = 4;

/// Geometric mean of stiffness and strength over the cells of an element, as the law of mixtures is geometric itself;
/// mean of nu.
material::Constants mean_constants(const material::Phases& phases, std::span<const double> rigid_fractions) {
  if (rigid_fractions.size() == 1) return material::mixture(phases, rigid_fractions.front());
  material::Constants mean{.young_pa = 0.0, .poisson = 0.0, .threshold_j_per_m3 = 0.0};
  const double share = 1.0 / static_cast<double>(rigid_fractions.size());
  for (const double fraction : rigid_fractions) {
    const material::Constants cell = material::mixture(phases, fraction);
    mean.young_pa += share * std::log(cell.young_pa);
    mean.poisson += share * cell.poisson;
    mean.threshold_j_per_m3 += share * std::log(cell.threshold_j_per_m3);
  }
  mean.young_pa = std::exp(mean.young_pa);
  mean.threshold_j_per_m3 = std::exp(mean.threshold_j_per_m3);
  return mean;
}

/// The composition of one unit: `parts` x `parts` cells per element, their rigid fractions in `fraction`, row by row of
/// the whole unit.
struct Composition {
  PrintedUnit unit;
  std::vector<double> fraction;
  int parts = 1;
};

Composition composition(const pattern::Layout& layout, double blur_pixels, double overprint_pixels, int refinement) {
  Composition result;
  int split = 1;  // of the unit's cells
  if (overprint_pixels == 0.0) {
    result.unit = printed_unit(layout);
    result.parts = cells_per_side(blur_pixels, refinement);
    split = refinement * result.parts;
  } else {
    result.parts = (kOverprintCells + refinement - 1) / refinement;
    result.unit = overprinted_unit(layout, overprint_pixels, refinement * result.parts);
  }
  result.fraction = blurred_fractions(result.unit, blur_pixels, split);
  return result;
}

/// What one element is made of.
struct Element {
  std::vector<double> rigid_fractions;  ///< of its cells
  double mean_fraction = 0.0;
  double share_x = 0.0, share_y = 0.0;  ///< interface between x- and y-neighbours

  friend bool operator==(const Element&, const Element&) = default;
};

struct HashOfElement {
  std::size_t operator()(const Element& element) const {
    std::size_t hash = 0;
    const auto add = [&](double value) { hash = hash * 31 + std::hash<double>()(value); };
    for (const double fraction : element.rigid_fractions) add(fraction);
    add(element.share_x);
    add(element.share_y);
    return hash;
  }
};

Element element_at(const Composition& made, int refinement, int row, int column) {
  const int parts = made.parts, side = kElementsPerUnit * refinement * parts;
  Element element;
  element.rigid_fractions.reserve(parts * parts);
  for (int part = 0; part < parts * parts; ++part) {
    const int part_row = row * parts + part / parts, part_column = column * parts + part % parts;
    const double fraction = made.fraction[part_row * side + part_column];
    const int parts_per_cell = side / made.unit.side();
    const std::size_t cell = made.unit.index(part_row / parts_per_cell, part_column / parts_per_cell);
    element.rigid_fractions.push_back(fraction);
    element.mean_fraction += fraction / (parts * parts);
    element.share_x += made.unit.joins_x[cell] / (parts * parts);
    element.share_y += made.unit.joins_y[cell] / (parts * parts);
  }
  return element;
}

/// The elements of one unit: few of them differ, unless inks mix, and what they mean is worked out once for each.
struct LaidDown {
  std::vector<Element> elements;  ///< each once
  std::vector<int> element_of;    ///< of each place, row by row
};

LaidDown lay_down(const Composition& made, int refinement) {
  const int side = kElementsPerUnit * refinement;
  std::unordered_map<Element, int, HashOfElement> known;
  LaidDown unit;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const auto [entry, is_new] =
          known.try_emplace(element_at(made, refinement, row, column), static_cast<int>(known.size()));
      if (is_new) unit.elements.push_back(entry->first);
      unit.element_of.push_back(entry->second);
    }
  return unit;
}

/// The unit of a layout. The last one of a thread is kept: slopes need the same unit with other constants, and growth
/// or blur costs as much as a solution.
const LaidDown& laid_down(const pattern::Layout& layout, const material::Extensions& extensions, int refinement) {
  struct Last {
    pattern::Layout layout;
    double blur_pixels = 0.0, overprint_pixels = 0.0;
    int refinement = 0;
    LaidDown made;
  };
  thread_local std::optional<Last> last;
  const double blur_pixels = material::extension_value(extensions, "droplet_mixing");
  const double overprint_pixels = material::extension_value(extensions, "rigid_overprint");
  if (!last || last->refinement != refinement || last->blur_pixels != blur_pixels ||
      last->overprint_pixels != overprint_pixels || last->layout != layout)
    last = Last{layout, blur_pixels, overprint_pixels, refinement,
                lay_down(composition(layout, blur_pixels, overprint_pixels, refinement), refinement)};
  return last->made;
}

/// Sets the extensions of the law of element `e`, of that rigid fraction. An array is allocated by the first element
/// that needs it.
void set_law(fem::Grid& grid, std::size_t e, const material::LawExtensions& extensions, double rigid_fraction) {
  const material::ExtendedLaw law = material::extended_law(extensions, {}, grid.threshold_j_per_m3[e], rigid_fraction);
  const auto put = [&](std::vector<double>& field, double value, double otherwise) {
    if (field.empty() && value == otherwise) return;
    if (field.empty()) field.assign(grid.phase.size(), otherwise);
    field[e] = value;
  };
  put(grid.laws.eigenstrain, law.eigenstrain, 0.0);
  put(grid.laws.inverse_limit, law.inverse_limit, 0.0);
  put(grid.laws.yield_pa, law.yield_pa, std::numeric_limits<double>::infinity());
}

/// The laws of a tester. The modulus tester strains too little for any: the Maxwell branch is a factor on its result,
/// and residual strains of 1 % change E by less than 1 %, nearly alike for all layouts.
material::LawExtensions laws_for(const material::Extensions& extensions, AssemblyTarget target) {
  return target == AssemblyTarget::toughness ? material::law_extensions(extensions) : material::LawExtensions{};
}

material::Phases phases_for(const material::ParameterSet& parameters, AssemblyTarget target) {
  return target == AssemblyTarget::modulus ? material::phases_of(parameters.modulus)
                                           : material::phases_of(parameters.toughness);
}

material::Phases phases_of_modulus(const material::ParameterSet& parameters, const TestConditions& conditions) {
  return material::phases_at_rate(phases_for(parameters, AssemblyTarget::modulus), parameters.extensions,
                                  conditions.strain_rate_per_s);
}

/// Constants of each element of a unit that differs from the others.
std::vector<material::Constants> constants_of(const LaidDown& made, const material::Phases& phases,
                                              const material::Extensions& extensions,
                                              const TestConditions& conditions) {
  const bool turned = conditions.orientation_deg == 90.0;
  const double printer_anisotropy = material::extension_value(extensions, "interface_anisotropy");
  const double anisotropy = turned ? -printer_anisotropy : printer_anisotropy;
  const double confinement = material::plane_strain_share(extensions, conditions.thickness_mm);
  std::vector<material::Constants> constants;
  for (const Element& element : made.elements) {
    constants.push_back(mean_constants(phases, element.rigid_fractions));
    const double factor = anisotropy_factor(element.share_x, element.share_y, anisotropy);
    constants.back().young_pa *= factor;
    constants.back().threshold_j_per_m3 *= factor;
    constants.back() = material::confined(constants.back(), confinement);
  }
  return constants;
}

/// Element (0, 0) of the grid is element (first, first) of a unit, and so on over the unit's edges.
void assign_layout(fem::Grid& grid, const pattern::Layout& layout, const material::Phases& phases,
                   const material::Extensions& extensions, const material::LawExtensions& laws,
                   const TestConditions& conditions, int refinement, int first) {
  const LaidDown& made = laid_down(layout, extensions, refinement);
  const std::vector<material::Constants> constants = constants_of(made, phases, extensions, conditions);
  const int side = kElementsPerUnit * refinement;
  const auto of_unit = [&](int i) { return (i + first + side) % side; };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int which = made.element_of[of_unit(row) * side + of_unit(column)];
      const double rigid_fraction = made.elements[which].mean_fraction;
      const std::size_t e = grid.index(row, column);
      set_element(grid, e, constants[which], nearest_phase(rigid_fraction), refinement);
      if (laws.any()) set_law(grid, e, laws, rigid_fraction);
    }
}

/// Constants of a blend in a coupon of this thickness.
material::Constants in_coupon(const material::Constants& blend, const material::Extensions& extensions,
                              const TestConditions& conditions) {
  return material::confined(blend, material::plane_strain_share(extensions, conditions.thickness_mm));
}

/// The same, by the law of blends.
material::Constants in_elastic_coupon(const material::Constants& blend, const pattern::Mixture& mixture,
                                      const material::Extensions& extensions, const TestConditions& conditions) {
  material::Constants constants = in_coupon(blend, extensions, conditions);
  constants.young_pa *= material::blend_factor(extensions, mixture.rigid_fraction);
  return constants;
}

}  // namespace

material::Constants elastic_coupon_constants(const material::ModulusParameters& theta, const pattern::Mixture& mixture,
                                             const material::Extensions& extensions, const TestConditions& conditions) {
  return in_elastic_coupon(material::blend_at_rate(material::phases_of(theta), extensions, mixture.rigid_fraction,
                                                   conditions.strain_rate_per_s),
                           mixture, extensions, conditions);
}

material::Constants held_coupon_constants(const material::ModulusParameters& theta, const pattern::Mixture& mixture,
                                          const material::Extensions& extensions, const TestConditions& conditions,
                                          double time_s) {
  return in_elastic_coupon(material::blend_held(material::phases_of(theta), extensions, mixture.rigid_fraction, time_s),
                           mixture, extensions, conditions);
}

UnitOfModulus unit_of_modulus(const pattern::Layout& layout, const material::ParameterSet& parameters,
                              const TestConditions& conditions, int refinement) {
  const LaidDown& made = laid_down(layout, parameters.extensions, refinement);
  return {constants_of(made, phases_of_modulus(parameters, conditions), parameters.extensions, conditions),
          made.element_of};
}

fem::Grid assemble_elastic_part(const pattern::Layout& layout, const material::ParameterSet& parameters,
                                AssemblyTarget target, int first, int count) {
  assert(first >= -kElementsPerUnit && count >= 1);
  fem::Grid grid = empty_grid(count, count, 1);
  assign_layout(grid, layout, phases_for(parameters, target), parameters.extensions, {}, {}, 1, first);
  return grid;
}

fem::Grid assemble(const pattern::Design& design, const material::ParameterSet& parameters,
                   const TestConditions& conditions, AssemblyTarget target, int units_x, int units_y, int refinement) {
  assert(units_x >= 1 && units_y >= 1 && refinement >= 1);
  assert(conditions.orientation_deg == 0.0 || conditions.orientation_deg == 90.0);
  const material::Phases phases =
      target == AssemblyTarget::modulus ? phases_of_modulus(parameters, conditions) : phases_for(parameters, target);
  const int side = kElementsPerUnit * refinement;
  fem::Grid grid = empty_grid(side * units_x, side * units_y, refinement);
  material::LawExtensions laws = laws_for(parameters.extensions, target);
  if (design.mixture() != nullptr) laws.shrinkage = 0.0;  // it shrinks freely, and is measured afterwards
  grid.laws.overstress = laws.overstress;
  grid.laws.relaxation_time_s = laws.relaxation_time_s;
  grid.laws.softening = laws.softening;
  grid.laws.tension_only = laws.tension_only;
  if (const pattern::Layout* layout = design.layout()) {
    assign_layout(grid, *layout, phases, parameters.extensions, laws, conditions, refinement, 0);
  } else {
    const double rigid_fraction = design.mixture()->rigid_fraction;
    const material::Constants constants =
        target == AssemblyTarget::modulus
            ? elastic_coupon_constants(parameters.modulus, *design.mixture(), parameters.extensions, conditions)
            : in_coupon(material::mixture(phases, rigid_fraction), parameters.extensions, conditions);
    for (std::size_t e = 0; e < grid.phase.size(); ++e) {
      set_element(grid, e, constants, nearest_phase(rigid_fraction), refinement);
      if (laws.any()) set_law(grid, e, laws, rigid_fraction);
    }
  }
  return grid;
}

}  // namespace nacre::tester
