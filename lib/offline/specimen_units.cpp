#include "offline/specimen_units.hpp"

#include <fmt/format.h>

#include "game/plausibility.hpp"

namespace nacre::offline {

SpecimenUnitDoubts specimen_unit_doubts(std::span<const measurement::SpecimenRecord> specimens,
                                        const material::ParameterSet& model, tester::Fidelity fidelity) {
  constexpr int kShown = 3;
  game::UnitDoubts units(model, fidelity);
  SpecimenUnitDoubts doubts;
  int count = 0;
  for (const measurement::SpecimenRecord& specimen : specimens)
    if (const auto doubt = units.about(specimen); doubt && count++ < kShown) doubts.first.push_back(*doubt);
  if (count > 0)
    doubts.caution =
        fmt::format(" Caution: {} of {} specimens are so stiff or soft that only a wrong unit explains them.", count,
                    specimens.size());
  return doubts;
}

}  // namespace nacre::offline
