// What a node requests from the farm, with responses made up by the test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "material/parameters.hpp"
#include "runtime/farm_requests.hpp"

namespace nacre::runtime {
namespace {

using testing::SizeIs;
using testing::StartsWith;

/// The third evaluation of a calibration of round 1: the toughness of two designs.
FarmBatch third_evaluation(double w_if_j_per_m3, std::uint64_t second_design = 6) {
  FarmBatch batch{.requester = "validation_agent",
                  .label = "r1/c",
                  .wanted = {},
                  .measured = {},
                  .fidelity = tester::Fidelity::tiny};
  for (const std::uint64_t bits : {std::uint64_t{5}, second_design}) {
    batch.measured.emplace_back().design = pattern::Pattern(bits);
    batch.measured.back().toughness_count = 1;
  }
  sysid::WantedEvaluation evaluation{
      .id = "T2.0", .parameters = material::default_parameters(), .modulus = false, .toughness = true, .items = {0, 1}};
  evaluation.parameters.toughness.w_if_j_per_m3 = w_if_j_per_m3;
  batch.wanted.push_back(evaluation);
  return batch;
}

wire::SimulateRequest only_request(FarmRequests& test_requests, const FarmBatch& batch) {
  const std::vector<wire::SimulateRequest> requests = test_requests.ask(batch);
  EXPECT_THAT(requests, SizeIs(1));
  EXPECT_THAT(requests.front().request_id, StartsWith("validation_agent/r1/c/T2.0/0#"));
  return requests.front();
}

wire::SimulateResult response(const wire::SimulateRequest& request, double toughness_pa) {
  wire::SimulateResult whole{.request_id = request.request_id, .chunk = 0, .chunks = 1, .first = 0, .results = {}};
  for (const pattern::Design& design : request.designs) {
    wire::SimulatedDesign result;
    result.design = design;
    result.toughness_pa = toughness_pa;
    whole.results.push_back(result);
  }
  return whole;
}

// The journal was lost, and the second course of the game comes to other parameters, or to other designs in the same
// places, under the same label.
TEST(FarmRequests, AResponseToAnotherCoursesRequestIsNotTaken) {
  for (const FarmBatch& second_course : {third_evaluation(2e7), third_evaluation(1e7, 7)}) {
    FarmRequests before, now;
    const wire::SimulateRequest stale = only_request(before, third_evaluation(1e7));
    const wire::SimulateRequest asked = only_request(now, second_course);
    EXPECT_FALSE(now.take(response(stale, 1e5)));
    EXPECT_FALSE(now.predictions().at(0).at(1).toughness_pa);
    EXPECT_TRUE(now.take(response(asked, 2e5)));
    EXPECT_EQ(now.predictions().at(0).at(1).toughness_pa, 2e5);
    EXPECT_FALSE(now.take(response(stale, 1e5)));
    EXPECT_EQ(now.predictions().at(0).at(1).toughness_pa, 2e5);
  }
}

TEST(FarmRequests, TheSameCourseAsksTheSameAgain) {
  FarmRequests before, now;
  EXPECT_EQ(only_request(before, third_evaluation(1e7)), only_request(now, third_evaluation(1e7)));
}

}  // namespace
}  // namespace nacre::runtime
