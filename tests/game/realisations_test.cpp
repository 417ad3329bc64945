// Realisations of candidates, with responses made up by the test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "material/parameters.hpp"
#include "pattern/random_pattern.hpp"
#include "proposal_agent/realisations.hpp"

namespace nacre::proposal_agent {
namespace {

using explore::Evaluated;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kDraws = 3;

/// A front of eight, and eight behind it that come out as they first did.
std::vector<Evaluated> gamut() {
  RandomStream random(1, "redraws test");
  std::vector<Evaluated> samples;
  for (int i = 0; i < 16; ++i) {
    const double modulus = 1.0 + i % 8, luck = i < 8 ? 1.0 : 0.6;
    samples.push_back({pattern::random_pattern(60 + i, random), {1e9 * modulus, 1e5 * (9.0 - modulus) * luck}});
  }
  return samples;
}

wire::SimulateRequest model() {
  wire::SimulateRequest request;
  request.modulus = request.toughness = true;
  request.fidelity = tester::Fidelity::tiny;
  request.parameters = material::thesis_parameters();
  return request;
}

/// The first eight are best of N by chance: with perturbed parameters T is a third. A little of it is the realisation's
/// own.
std::vector<wire::SimulatedDesign> response(const wire::SimulateRequest& request, const std::vector<Evaluated>& truth) {
  std::vector<wire::SimulatedDesign> results;
  const double draw =
      std::sqrt(request.parameters.toughness.w_if_j_per_m3 / model().parameters.toughness.w_if_j_per_m3);
  for (const pattern::Design& design : request.designs) {
    const auto of = std::find_if(truth.begin(), truth.end(),
                                 [&](const Evaluated& each) { return each.pattern.key() == design.name(); });
    wire::SimulatedDesign result;
    result.design = design;
    result.toughness_pa = of->performance.toughness_pa * draw * (of - truth.begin() < 8 ? 1.0 / 3.0 : 1.0);
    results.push_back(result);
  }
  return results;
}

/// Realisations until nothing more is requested; responses come in the order of requests, or from the last to the
/// first.
Realisations drawn(const std::vector<pattern::Pattern>& chosen, bool backwards = false) {
  Realisations realisations(gamut(), chosen, kDraws, 7, "test");
  for (auto requests = realisations.next(model()); !requests.empty(); requests = realisations.next(model())) {
    if (backwards) std::reverse(requests.begin(), requests.end());
    for (const wire::SimulateRequest& request : requests) {
      EXPECT_FALSE(request.modulus);
      EXPECT_NE(request.parameters.toughness, model().parameters.toughness);
      EXPECT_TRUE(realisations.waits_for(request.request_id));
      realisations.take(request.request_id, response(request, gamut()));
    }
  }
  return realisations;
}

TEST(Realisations, TheBestOfNFallBackAndOthersAreSimulatedInTheirPlace) {
  const Realisations realisations = drawn({});
  EXPECT_EQ(realisations.simulated(), 16 * kDraws);
  for (std::size_t i = 0; i < 16; ++i) {
    const double ratio = realisations.gamut()[i].performance.toughness_pa / gamut()[i].performance.toughness_pa;
    EXPECT_NEAR(std::log(ratio), i < 8 ? 0.75 * std::log(1.0 / 3.0) : 0.0, 0.1) << i;
    EXPECT_EQ(realisations.gamut()[i].performance.modulus_pa, gamut()[i].performance.modulus_pa);
  }
}

TEST(Realisations, OfSpecimensThatDifferOnlyFurtherOnesCount) {
  Realisations realisations(gamut(), {}, kDraws, 7, "test");
  wire::SimulateRequest varied = model();
  varied.parameters.strength_cv = 0.1;
  for (auto requests = realisations.next(varied); !requests.empty(); requests = realisations.next(varied)) {
    ASSERT_THAT(requests, SizeIs(1));
    EXPECT_EQ(requests[0].parameters, varied.parameters);
    EXPECT_GT(requests[0].first_specimen, 0) << "specimen 0 chose the design";
    EXPECT_EQ(requests[0].specimens, kDraws);
    realisations.take(requests[0].request_id, response(requests[0], gamut()));
  }
  EXPECT_EQ(realisations.simulated(), 16 * kDraws);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(realisations.gamut()[i].performance.toughness_pa, gamut()[i].performance.toughness_pa / 3.0, 1e-3);
}

TEST(Realisations, TheOrderOfResponsesChangesNothing) { EXPECT_EQ(drawn({}).gamut(), drawn({}, true).gamut()); }

TEST(Realisations, WhatCannotBeSelectedIsSimulatedAgainOnTheFrontOnly) {
  std::vector<pattern::Pattern> all;
  for (const Evaluated& sample : gamut()) all.push_back(sample.pattern);
  Realisations realisations(gamut(), all, kDraws, 7, "test");
  const auto requests = realisations.next(model());
  ASSERT_THAT(requests, SizeIs(kDraws));
  EXPECT_THAT(requests.front().designs, SizeIs(8));
}

TEST(Realisations, ADrawThatFailsDoesNotCount) {
  Realisations realisations(gamut(), {}, kDraws, 7, "test");
  for (const wire::SimulateRequest& request : realisations.next(model())) {
    auto results = response(request, gamut());
    for (wire::SimulatedDesign& result : results)
      result = {.design = result.design, .failure = "did not break", .curve = {}};
    realisations.take(request.request_id, results);
  }
  EXPECT_EQ(realisations.gamut(), gamut());
}

TEST(Realisations, NoRealisationsNoRequests) {
  Realisations realisations(gamut(), {}, 0, 7, "test");
  EXPECT_THAT(realisations.next(model()), IsEmpty());
  EXPECT_EQ(realisations.gamut(), gamut());
}

}  // namespace
}  // namespace nacre::proposal_agent
