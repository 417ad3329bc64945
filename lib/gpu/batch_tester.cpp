#include "gpu/batch_tester.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nacre::gpu {

PreparedTest::PreparedTest(const tester::FractureTest& test, const tester::MountedSpecimen<float>& specimen)
    : image_(image_of(specimen.solver, test.settings.strain_rate_per_s * test.settings.time_step_s)),
      watch_(test),
      rest_strain_(specimen.rest_strain),
      stress_unit_pa_(specimen.solver.stress_unit_pa()) {}

Result<PreparedTest> PreparedTest::of(const tester::FractureTest& test) {
  if (test.grid.neighbourhood_m > 0.0)
    return fail("toughness tester: the neighbourhood criterion runs on processors alone, not on a device");
  const Result<tester::MountedSpecimen<float>> specimen = tester::mount<float>(test);
  if (!specimen) return fail("toughness tester: {}", specimen.error().message);
  return PreparedTest(test, *specimen);
}

double PreparedTest::strain_at(std::int64_t step) const {
  const Specimen& s = image_.specimen;
  return (s.initial_strain + s.strain_per_step * static_cast<double>(step) - rest_strain_) / (1.0 + rest_strain_);
}

bool PreparedTest::follow(const Reactions& reactions) {
  for (int k = 0; k < kChunkSteps; ++k) {
    const double strain = strain_at(steps_);
    const double stress_pa = 0.5 * (reactions.top[k] + reactions.bottom[k]) * stress_unit_pa_;
    if (watch_.add(strain, stress_pa, ++steps_)) return true;
  }
  return false;
}

Result<tester::ToughnessResult> PreparedTest::result(const std::vector<std::int32_t>& failed_at,
                                                     std::int32_t inverted) {
  if (inverted >= 0 && failed_at[inverted] <= steps_) {
    const int columns = image_.specimen.state.columns;
    return fail("toughness tester: the solution blew up: J <= 0 in element row {} column {} at step {}",
                inverted / columns, inverted % columns, failed_at[inverted]);
  }
  Result<tester::ToughnessResult> taken = watch_.take();
  if (!taken) return taken;
  tester::ToughnessResult result = *std::move(taken);
  // Intact elements are checked only where they fail, and a value that is not a number has passed no threshold.
  if (!std::isfinite(result.toughness_pa)) return fail("toughness tester: the solution blew up: T is not a number");
  for (std::size_t element = 0; element < failed_at.size(); ++element) {
    const std::int32_t step = failed_at[element];
    if (step >= 0 && step < steps_) result.breaks.push_back({static_cast<int>(element), strain_at(step)});
  }
  // In the order of failing; within one step in that of the elements.
  std::stable_sort(result.breaks.begin(), result.breaks.end(),
                   [](const tester::Break& a, const tester::Break& b) { return a.strain < b.strain; });
  return result;
}

BatchTester::BatchTester(std::unique_ptr<Device> device, int places) : device_(std::move(device)), places_(places) {}

int BatchTester::pending() const {
  return static_cast<int>(waiting_.size()) +
         static_cast<int>(
             std::count_if(places_.begin(), places_.end(), [](const auto& place) { return place.has_value(); }));
}

void BatchTester::fill_places() {
  for (std::size_t place = 0; place < places_.size() && !waiting_.empty(); ++place) {
    if (places_[place]) continue;
    places_[place] = std::move(waiting_.front());
    waiting_.pop_front();
    device_->load(place, places_[place]->test.image());
  }
}

std::vector<NumberedResult> BatchTester::turn() {
  fill_places();
  device_->advance();
  const std::vector<PlaceReport> reports = device_->reports();
  std::vector<NumberedResult> over;
  for (std::size_t place = 0; place < places_.size(); ++place) {
    if (!places_[place]) continue;
    PreparedTest& test = places_[place]->test;
    const PlaceReport& report = reports[place];
    if (!test.follow(report.reactions) && report.inverted < 0) continue;
    over.push_back({places_[place]->number, test.result(device_->failed_at(place), report.inverted)});
    device_->unload(place);
    places_[place].reset();
  }
  return over;
}

int places_for(const Device& device, const SpecimenImage& typical, int most) {
  constexpr double kShare = 0.8;  // a specimen with history takes more than one without
  const std::size_t bytes = typical.device_numbers() * sizeof(float) + typical.elements * sizeof(std::int32_t);
  return std::clamp(static_cast<int>(kShare * static_cast<double>(device.free_bytes()) / static_cast<double>(bytes)), 1,
                    most);
}

}  // namespace nacre::gpu
