#include "tester/modulus_probe.hpp"

#include "fem/element.hpp"
#include "fem/static_solver.hpp"
#include "tester/assembly.hpp"
#include "tester/fidelity.hpp"
#include "tester/modulus.hpp"
#include "tester/usable.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {
namespace {

fem::Grid grid_of(const Simulation& simulation) {
  const SpecimenUnits units = modulus_units(simulation.fidelity);
  return assemble(simulation.design, simulation.parameters, simulation.conditions, AssemblyTarget::modulus, units.x,
                  units.y, refinement_of(simulation.fidelity));
}

}  // namespace

Result<ModulusProbe> ModulusProbe::at(const Simulation& simulation) {
  if (simulation.design.mixture() != nullptr) return fail("modulus probe: expected a layout");
  if (std::string fault = simulation_fault(simulation, TestKind::modulus); !fault.empty())
    return fail("modulus probe: {}", fault);
  const fem::Grid grid = grid_of(simulation);
  const Result<fem::StaticSolution> solution = fem::pull(grid, thesis::kModulusStrain);
  if (!solution) return fail("modulus probe: {}", solution.error().message);
  ModulusProbe probe;
  probe.relaxed_pa_ = solution->top_stress_pa / thesis::kModulusStrain;
  const int side = kElementsPerUnit * refinement_of(simulation.fidelity);
  probe.shear_.assign(static_cast<std::size_t>(side * side), 0.0);
  probe.bulk_ = probe.shear_;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      fem::ElementVector moved;
      int a = 0;
      for (const int node : fem::element_nodes(grid, row, column)) {
        for (int direction = 0; direction < 2; ++direction)
          moved[2 * a + direction] = solution->displacement[2 * node + direction];
        ++a;
      }
      const std::size_t place = (row % side) * side + column % side;
      probe.shear_[place] += 0.5 * moved.dot(fem::unit_stiffness().shear * moved);
      probe.bulk_[place] += 0.5 * moved.dot(fem::unit_stiffness().bulk * moved);
    }
  }
  return probe.of(simulation);
}

ModulusProbe ModulusProbe::of(const Simulation& simulation) const {
  ModulusProbe probe = *this;
  probe.simulation_ = simulation;
  probe.modulus_pa_ = relaxed_pa_ * rate_factor(simulation);
  probe.energy_ = probe.energy(simulation.parameters);
  return probe;
}

double ModulusProbe::energy(const material::ParameterSet& parameters) const {
  const UnitOfModulus unit = unit_of_modulus(*simulation_.design.layout(), parameters, simulation_.conditions,
                                             refinement_of(simulation_.fidelity));
  std::vector<material::Lame> lame;
  for (const material::Constants& kind : unit.kinds)
    lame.push_back(material::lame_from_engineering(kind.young_pa, kind.poisson));
  double sum = 0.0;
  for (std::size_t e = 0; e < unit.kind_of.size(); ++e) {
    const material::Lame& here = lame[unit.kind_of[e]];
    sum += here.mu_pa * shear_[e] + here.lambda_pa * bulk_[e];
  }
  return sum * rate_factor({simulation_.design, parameters, simulation_.conditions, simulation_.fidelity});
}

double ModulusProbe::nearby(const material::ParameterSet& parameters) const {
  return modulus_pa_ * energy(parameters) / energy_;
}

}  // namespace nacre::tester
