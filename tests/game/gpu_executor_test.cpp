// The farm's executor with a device: the device's steps are emulated, its failures made up.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "film/film_file.hpp"
#include "gpu/emulated_device.hpp"
#include "simulator_farm/gpu_executor.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "tester/modulus.hpp"
#include "tester/simulation_key.hpp"
#include "wire/schema.hpp"

namespace nacre::simulator_farm {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

constexpr const char* kDesigns[] = {"577fffe9fffdef", "3ffdbefbf7efef"};

runtime::Compute test_request(const std::string& design, bool modulus) {
  wire::SimulateRequest request;
  request.request_id = design + (modulus ? "/E" : "/T");
  request.modulus = modulus;
  request.toughness = !modulus;
  request.fidelity = tester::Fidelity::tiny;
  request.parameters = material::default_parameters();
  request.curve_points = modulus ? 0 : 20;
  request.designs = {pattern::design_from_name(design).value()};
  return {request.request_id, "simulate", wire::write(request)};
}

/// A fracture test whose crack, or film too, is asked for.
runtime::Compute crack_request(const std::string& design, bool film) {
  runtime::Compute compute = test_request(design, false);
  auto request = wire::read<wire::SimulateRequest>(compute.spec).value();
  request.crack = true;
  request.film = film;
  compute.spec = wire::write(request);
  return compute;
}

std::vector<runtime::Compute> both_tests() {
  std::vector<runtime::Compute> test_requests;
  for (const char* design : kDesigns)
    for (const bool modulus : {true, false}) test_requests.push_back(test_request(design, modulus));
  return test_requests;
}

tester::Simulation simulation_of(const std::string& design) {
  return {pattern::design_from_name(design).value(), material::default_parameters(), {}, tester::Fidelity::tiny};
}

/// What the device makes of a design: it hinges on no other in the batch. Breaks as they are kept.
tester::ToughnessResult pulled_by_device(const std::string& design) {
  gpu::BatchTester batch(gpu::emulated_device(1), 1);
  batch.add({0, gpu::PreparedTest::of(tester::fracture_test(simulation_of(design))).value()});
  std::vector<gpu::NumberedResult> over;
  while (over.empty()) over = batch.turn();
  tester::ToughnessResult result = over.front().result.value();
  for (tester::Break& broken : result.breaks) broken.strain = static_cast<float>(broken.strain);
  return result;
}

Result<std::unique_ptr<gpu::Device>> emulated(int places) { return gpu::emulated_device(places); }
Result<std::unique_ptr<gpu::Device>> none(int) { return fail("there is none"); }

/// A device that is lost after some chunks.
class FailingDevice : public gpu::Device {
 public:
  explicit FailingDevice(int chunks) : device_(gpu::emulated_device(8)), left_(chunks) {}
  std::string name() const override { return "a device that fails"; }
  std::size_t free_bytes() const override { return device_->free_bytes(); }
  void load(int place, const gpu::SpecimenImage& image) override { device_->load(place, image); }
  void unload(int place) override { device_->unload(place); }
  void advance() override {
    if (left_-- == 0) throw gpu::DeviceLost("it fell off the bus");
    device_->advance();
  }
  std::vector<gpu::PlaceReport> reports() override { return device_->reports(); }
  std::vector<std::int32_t> failed_at(int place) override { return device_->failed_at(place); }

 private:
  std::unique_ptr<gpu::Device> device_;
  int left_;
};

class GpuExecutorTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    cache_ = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  }

  /// Responses by the ids of the test requests.
  std::map<std::string, TestResponse> responses(MakeDevice make_device,
                                                const std::vector<runtime::Compute>& test_requests = both_tests()) {
    GpuExecutor executor(cache_, {.films = folder_ / "films", .threads = 1, .make_device = std::move(make_device)},
                         [this] {
                           const std::lock_guard lock(mutex_);
                           woken_ = true;
                           changed_.notify_all();
                         });
    for (const runtime::Compute& compute : test_requests) executor.start(compute);
    const int expected = static_cast<int>(test_requests.size());
    EXPECT_EQ(executor.pending(), expected);
    std::map<std::string, TestResponse> responses;
    while (static_cast<int>(responses.size()) < expected) {
      std::unique_lock lock(mutex_);
      EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(120), [this] { return std::exchange(woken_, false); }))
          << "nothing more comes";
      lock.unlock();
      for (runtime::FinishedWork& work : executor.finished()) {
        EXPECT_TRUE(work.result) << work.result.error().message;
        EXPECT_TRUE(responses.emplace(work.compute.id, read_response(*work.result).value()).second)
            << work.compute.id << " has two responses";
      }
    }
    EXPECT_EQ(executor.pending(), 0);
    log_ = executor.take_log();
    return responses;
  }

  std::filesystem::path folder_;
  std::shared_ptr<store::SimulationCache> cache_;
  std::vector<runtime::LogLine> log_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool woken_ = false;
};

void expect_like_the_processors(const std::map<std::string, TestResponse>& responses) {
  for (const char* design : kDesigns) {
    const tester::Simulation simulation = simulation_of(design);
    EXPECT_DOUBLE_EQ(responses.at(std::string(design) + "/E").design.modulus_pa,
                     tester::test_modulus(simulation)->modulus_pa);
    const TestResponse& fracture = responses.at(std::string(design) + "/T");
    // Which way a crack takes may hinge on rounding.
    EXPECT_NEAR(std::log(fracture.design.toughness_pa / tester::test_toughness(simulation)->toughness_pa), 0.0, 0.3)
        << design;
    EXPECT_FALSE(fracture.design.curve.empty());
  }
}

TEST_F(GpuExecutorTest, FractureTestsGoToTheDeviceAndAllElseToThreads) {
  expect_like_the_processors(responses(emulated));
  EXPECT_THAT(log_, Contains(Field(&runtime::LogLine::text, HasSubstr("fracture tests run on"))));
}

TEST_F(GpuExecutorTest, WithoutADeviceThreadsDoEverything) {
  expect_like_the_processors(responses(none));
  EXPECT_THAT(log_, Contains(Field(&runtime::LogLine::text, HasSubstr("there is none"))));
}

TEST_F(GpuExecutorTest, ADeviceThatIsLostLosesNoTest) {
  expect_like_the_processors(
      responses([](int) -> Result<std::unique_ptr<gpu::Device>> { return std::make_unique<FailingDevice>(3); }));
  EXPECT_THAT(log_, Contains(Field(&runtime::LogLine::text, HasSubstr("it fell off the bus"))));
}

TEST_F(GpuExecutorTest, WhatTheCacheKnowsIsNotPulledAgain) {
  const auto first = responses(emulated);
  const auto second =
      responses([](int) -> Result<std::unique_ptr<gpu::Device>> { return std::make_unique<FailingDevice>(0); });
  for (const auto& [id, response] : first)
    EXPECT_EQ(second.at(id).design.toughness_pa, response.design.toughness_pa) << id;
  EXPECT_TRUE(log_.empty()) << "the device was asked for something";
}

TEST_F(GpuExecutorTest, NumbersCrackAndFilmTellOfTheDevicesFracture) {
  const auto filmed = responses(emulated, {crack_request(kDesigns[0], true), crack_request(kDesigns[1], true)});
  for (const char* design : kDesigns) {
    const tester::ToughnessResult pulled = pulled_by_device(design);
    const TestResponse& response = filmed.at(std::string(design) + "/T");
    EXPECT_EQ(response.design.toughness_pa, pulled.toughness_pa) << "also for those who want a film";
    ASSERT_TRUE(response.fracture);
    EXPECT_EQ(response.fracture->crack.order, pulled.breaks);
    const auto file =
        folder_ / "films" / (tester::simulation_key(simulation_of(design), tester::TestKind::toughness) + ".film");
    // Rounding may have led the processor's specimen another way: then there is no film.
    ASSERT_EQ(std::filesystem::exists(file), !response.fracture->film.empty());
    if (response.fracture->film.empty()) continue;
    EXPECT_EQ(response.fracture->film, file.filename());
    EXPECT_NEAR(film::read_film(file).toughness_pa, pulled.toughness_pa, 0.01 * pulled.toughness_pa);
  }
}

TEST_F(GpuExecutorTest, ACrackAskedForWithoutTheDeviceIsStillThatOfItsNumbers) {
  responses(emulated);
  const auto later = responses(none, {crack_request(kDesigns[0], false), crack_request(kDesigns[1], false)});
  for (const char* design : kDesigns) {
    const tester::ToughnessResult pulled = pulled_by_device(design);
    const TestResponse& response = later.at(std::string(design) + "/T");
    EXPECT_EQ(response.design.toughness_pa, pulled.toughness_pa);
    ASSERT_TRUE(response.fracture);
    EXPECT_EQ(response.fracture->crack.order, pulled.breaks);
  }
}

TEST_F(GpuExecutorTest, ACrackOfNumbersThatThreadsGaveIsOfTheirFractureWithADeviceToo) {
  responses(none);
  const auto later = responses(emulated, {crack_request(kDesigns[0], false)});
  const TestResponse& response = later.at(std::string(kDesigns[0]) + "/T");
  const auto tested = tester::test_toughness(simulation_of(kDesigns[0])).value();
  EXPECT_EQ(response.design.toughness_pa, tested.toughness_pa);
  ASSERT_TRUE(response.fracture) << response.design.failure;
  const auto pulled = pulled_by_device(kDesigns[0]);
  if (std::abs(pulled.toughness_pa / tested.toughness_pa - 1.0) > 0.01) {
    EXPECT_EQ(response.fracture->broken, static_cast<int>(tested.breaks.size())) << "not the device's";
  }
}

}  // namespace
}  // namespace nacre::simulator_farm
