#pragma once
// Who watches a fracture test, whatever pulls the specimen: keeps its record and says when it is over.

#include <cstdint>
#include <vector>

#include "tester/fracture_record.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::tester {

class FractureWatch {
 public:
  explicit FractureWatch(const FractureTest& test);

  /// One step: the strain as the machine counts it, the mean stress of both grips, and the number of steps so far. True
  /// when the test is over with it.
  bool add(double strain, double stress_pa, std::int64_t steps);
  /// Elements that failed in the step added last; call before the next one.
  void add_breaks(std::vector<int> elements);
  /// The result but for its frames. Only once the test is over. Error: it has taken too many steps, its area so far
  /// says nothing.
  Result<ToughnessResult> take();

 private:
  double strain_limit_;
  bool limit_is_no_failure_;
  FractureRecord record_;
  ToughnessResult result_;
};

}  // namespace nacre::tester
