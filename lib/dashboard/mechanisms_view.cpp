#include "dashboard/mechanisms_view.hpp"

#include "tester/fracture_test.hpp"
#include "tester/usable.hpp"

namespace nacre::dashboard {
namespace {

void add(MechanismsRow& row, const std::string& model, const material::ParameterSet& parameters,
         tester::Fidelity fidelity, const std::map<std::string, wire::Fracture>& cracks) {
  for (const auto& [name, fracture] : cracks) {
    const tester::Simulation simulation{fracture.design, parameters, {}, fidelity};
    if (!tester::simulation_fault(simulation, tester::TestKind::toughness).empty()) continue;
    const fem::Grid notched = tester::fracture_test(simulation).grid;
    const auto elements = static_cast<std::int64_t>(fracture.crack.columns) * fracture.crack.rows;
    if (elements != static_cast<std::int64_t>(notched.phase.size())) continue;
    row.designs.push_back({name, model, crack::mechanisms_of(notched, fracture.crack)});
  }
}

}  // namespace

MechanismsRow mechanisms_row(const run::RunRecord& run, tester::Fidelity fidelity) {
  MechanismsRow row;
  for (const auto& [number, round] : run.rounds)
    if (round.model) add(row, std::to_string(number), round.model->parameters, fidelity, round.cracks);
  for (const run::FamilyRecord& family : run.families)
    add(row, family.stated.name, family.stated.parameters, fidelity, family.cracks);
  return row;
}

}  // namespace nacre::dashboard
