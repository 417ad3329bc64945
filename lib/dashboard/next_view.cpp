#include "dashboard/next_view.hpp"

#include <fmt/format.h>

namespace nacre::dashboard {

std::string next_in_words(const NextRoundRow& row) {
  const std::string words = in_words(row.next);
  if (row.price.specimens == 0) return words;
  return row.next.expected ? fmt::format("{}, for {}", words, in_words(row.price))
                           : fmt::format("{}; round {} asks for {}", words, row.next.round, in_words(row.price));
}

NextRoundRow next_round_row(const game::Scenario& scenario, const run::RunRecord& run,
                            const game::LaboratoryFacts& facts) {
  NextRoundRow row{.next = run::next_round(run), .price = {}};
  row.price = price_of_round(scenario, facts, row.next.round).all;
  return row;
}

}  // namespace nacre::dashboard
