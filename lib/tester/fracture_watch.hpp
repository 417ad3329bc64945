#pragma once
// Keeps the record of a fracture test, whichever solver pulls the specimen, and decides when it is over.

#include <cstdint>
#include <vector>

#include "tester/fracture_record.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::tester {

class FractureWatch {
 public:
  explicit FractureWatch(const FractureTest& test);

  /// One step: the strain of the grips, the mean stress of both, and the number of steps so far. True when it ends the
  /// test.
  bool add(double strain, double stress_pa, std::int64_t steps);
  /// Elements that failed in the step added last; call before the next one.
  void add_breaks(std::vector<int> elements);
  /// The result but for its frames. Only once the test is over. Error: too many steps, so that the area so
  /// far is meaningless.
  Result<ToughnessResult> take();

 private:
  double strain_limit_;
  bool limit_is_no_failure_;
  FractureRecord record_;
  ToughnessResult result_;
};

}  // namespace nacre::tester
