#pragma once
// The part of the data that carries an effect of the measuring side: a slack shows in toes, and what simulations get
// wrong behind the peak says nothing against it (docs/METHODS.md, "Diagnosis", step 7).

#include <string>
#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Rows that are one feature of one test, its history included: what batches do off a steady change speaks against a
/// drift.
struct RowClass {
  tester::TestKind test = tester::TestKind::modulus;
  Feature feature = Feature::log_modulus;
  bool operator==(const RowClass&) const = default;
};

struct CarriedPart {
  std::string effect;
  std::vector<RowClass> classes;  ///< that carry it
  Data data;                      ///< of their rows alone; no further fracture tests are simulated for it
};

/// The parts that carry the effect of the measuring side that improves the fit most, beyond chance: all classes of rows
/// in which its signature of usual size is, in the class's own noise, NameRules::carried of that in the class where it
/// is largest; then each of these alone, the largest first. None where no effect does, or where the whole data carry
/// it.
std::vector<CarriedPart> carried_parts(const Evidence& evidence);

/// The class outside the part that `fit` of all data predicts worst, and the root mean square of its residuals in their
/// own standard deviations.
struct WorstElsewhere {
  RowClass rows;
  double deviations = 0.0;
};
WorstElsewhere worst_elsewhere(const Observations& observations, const CarriedPart& part, const FittedModel& fit);

}  // namespace nacre::diagnosis
