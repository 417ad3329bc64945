// A batch of a search that thinks is worked out from its spec alone.

#include "proposal_agent/search_work.hpp"

#include <gtest/gtest.h>

#include "explore/mechanics.hpp"

namespace nacre::proposal_agent {
namespace {

TEST(SearchWork, FindsInTheSpecWhatTheBatchRequestHoldsAndTheModelThatMeasuresModuli) {
  explore::SearchSettings settings;
  settings.algorithm = "learned";
  settings.budget = 60;
  settings.population = 5;
  const auto search = explore::make_search(settings);
  wire::AdoptedModel model;
  model.fidelity = tester::Fidelity::tiny;
  model.parameters = material::default_parameters();
  double toughness_pa = 1e5;
  // Past the start, which nothing is believed for.
  while (search->evaluated().size() < static_cast<std::size_t>(settings.population + settings.learned.barred_start)) {
    std::vector<std::optional<optimize::Performance>> responses;
    const auto asked = search->batch_request();
    const auto start = search->ask();
    if (asked) {
      EXPECT_EQ(start, *batch_from_result(search_work(search_spec(*asked, model))));
    }
    for (const pattern::Pattern& pattern : start)
      responses.push_back(optimize::Performance{1e9 * pattern.rigid_fraction(), toughness_pa += 1e3});
    search->tell(responses);
  }
  explore::BatchRequest batch_request = *search->batch_request();
  const auto batch = batch_from_result(search_work(search_spec(batch_request, model)));
  ASSERT_TRUE(batch) << batch.error().message;
  EXPECT_EQ(batch->size(), 10u);
  batch_request.settings.mechanics = explore::mechanics_by_tester(model.parameters, model.fidelity, 1);
  EXPECT_EQ(*batch, explore::batch_for(batch_request));
  batch_request.settings.mechanics = {};
  EXPECT_NE(*batch, explore::batch_for(batch_request)) << "who believes what could be computed chooses otherwise";
}

}  // namespace
}  // namespace nacre::proposal_agent
