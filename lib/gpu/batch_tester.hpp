#pragma once
// Fracture tests by the batch: specimens wait in a queue for a place on a device, are pulled there in parallel, and are
// replaced by the next when finished.

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/device.hpp"
#include "tester/fracture_watch.hpp"
#include "tester/toughness.hpp"

namespace nacre::gpu {

/// A test whose specimen is mounted, ready for a device. Making one takes some milliseconds of a processor: any thread
/// may.
class PreparedTest {
 public:
  /// Error: what the solver refuses.
  static Result<PreparedTest> of(const tester::FractureTest& test);
  const SpecimenImage& image() const { return image_; }

  /// Follows the steps of a chunk. True when the test is over.
  bool follow(const Reactions& reactions);
  /// The result of a test that is over. `failed_at`: see Device. Error: the solution blew up.
  Result<tester::ToughnessResult> result(const std::vector<std::int32_t>& failed_at, std::int32_t inverted);

 private:
  PreparedTest(const tester::FractureTest& test, const tester::MountedSpecimen<float>& specimen);
  /// Strain of the grips in a step, from where they carry no force.
  double strain_at(std::int64_t step) const;

  SpecimenImage image_;
  tester::FractureWatch watch_;
  double rest_strain_ = 0.0, stress_unit_pa_ = 0.0;
  std::int64_t steps_ = 0;
};

/// A test and its number for the caller.
struct NumberedTest {
  int number = 0;
  PreparedTest test;
};

struct NumberedResult {
  int number = 0;
  Result<tester::ToughnessResult> result;
};

/// Not thread-safe.
class BatchTester {
 public:
  BatchTester(std::unique_ptr<Device> device, int places);
  const Device& device() const { return *device_; }

  void add(NumberedTest test) { waiting_.push_back(std::move(test)); }
  /// Tests in the queue and in places.
  int pending() const;
  /// Fills free places, makes one chunk of steps, and returns the tests that are over. Throws DeviceLost; the caller
  /// then repeats unfinished tests elsewhere.
  std::vector<NumberedResult> turn();

 private:
  void fill_places();

  std::unique_ptr<Device> device_;
  std::deque<NumberedTest> waiting_;
  std::vector<std::optional<NumberedTest>> places_;
};

/// Number of specimens of this kind that fit into a device's memory, at most `most`.
int places_for(const Device& device, const SpecimenImage& typical, int most);

}  // namespace nacre::gpu
