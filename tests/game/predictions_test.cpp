// What a proposal says of its designs, from specimens that did not choose them.

#include "proposal_agent/predictions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/specimen_numbers.hpp"

namespace nacre::proposal_agent {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

wire::Proposal chosen(int count) {
  RandomStream random(1, "designs");
  wire::Proposal proposal{.simulations = 300, .designs = {}};
  for (int i = 0; i < count; ++i)
    proposal.designs.push_back(
        {.design = pattern::random_pattern(70, random), .modulus_pa = 1e9, .toughness_pa = 2e5, .reason = {}});
  return proposal;
}

wire::SimulateRequest model(const material::ParameterSet& parameters) {
  wire::SimulateRequest request;
  request.modulus = request.toughness = true;
  request.parameters = parameters;
  return request;
}

TEST(Predictions, OfSpecimensThatDifferComeFromSpecimensThatChoseNothing) {
  Predictions predictions(chosen(3));
  const auto requests = predictions.requests(model(material::default_parameters()), "proposal_agent/r1/predicted");
  ASSERT_THAT(requests, SizeIs(1));
  EXPECT_FALSE(requests[0].modulus);
  EXPECT_GT(requests[0].first_specimen, tester::kFirstSelectionSpecimen + 100) << "the most that a candidate may have";
  EXPECT_LT(requests[0].first_specimen + requests[0].specimens, tester::kFirstCalibrationSpecimen);
  EXPECT_TRUE(predictions.waits_for(requests[0].request_id));
  std::vector<wire::SimulatedDesign> response(3);
  for (std::size_t i = 0; i < 3; ++i) response[i].design = requests[0].designs[i];
  response[0].toughness_pa = 1.5e5;
  response[0].toughness_sd_pa = 1e4;
  response[0].specimens = requests[0].specimens;
  response[1].failure = response[2].failure = "did not break";
  EXPECT_TRUE(predictions.take(requests[0].request_id, response));
  const wire::Proposal& proposal = predictions.proposal();
  EXPECT_EQ(proposal.designs[0].toughness_pa, 1.5e5);
  EXPECT_EQ(proposal.designs[0].toughness_sd_pa, 1e4);
  EXPECT_EQ(proposal.designs[0].specimens, tester::kPredictionSpecimens);
  EXPECT_EQ(proposal.designs[1], chosen(3).designs[1]) << "keeps what it was chosen by";
  EXPECT_EQ(proposal.simulations, 300 + 3 * tester::kPredictionSpecimens);
}

TEST(Predictions, OfMoreDesignsThanARequestHoldsWaitForAll) {
  Predictions predictions(chosen(70));
  const auto requests = predictions.requests(model(material::default_parameters()), "proposal_agent/r1/predicted");
  ASSERT_THAT(requests, SizeIs(2));
  EXPECT_FALSE(predictions.take(requests[1].request_id, {}));
  EXPECT_TRUE(predictions.take(requests[0].request_id, {}));
}

TEST(Predictions, OfSpecimensThatAreAllAlikeAreThoseOfTheSelection) {
  Predictions predictions(chosen(3));
  EXPECT_THAT(predictions.requests(model(material::thesis_parameters()), "proposal_agent/r1/predicted"), IsEmpty());
  EXPECT_EQ(predictions.proposal(), chosen(3));
}

}  // namespace
}  // namespace nacre::proposal_agent
