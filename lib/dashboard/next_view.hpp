#pragma once
// Is another round worth it: what rounds brought, what the next is expected to bring, and what it costs.

#include <string>
#include <vector>

#include "dashboard/page_fields.hpp"
#include "dashboard/round_price.hpp"
#include "run/next_round.hpp"

namespace nacre::dashboard {

struct BroughtRow {
  static constexpr std::string_view kPageName = "Brought";
  const run::NextRound::Brought* brought = &nothing<run::NextRound::Brought>();

  static void fields(auto& field, auto& m) {
    field("round", m.brought->round);
    field("growth", m.brought->growth);
  }
};

struct NextRoundRow {
  static constexpr std::string_view kPageName = "NextRound";
  run::NextRound next;
  fabricate::Price price;  ///< of the next round

  static void fields(auto& field, auto& m) {
    field("round", m.next.round);
    field("hypervolume_gpa_mpa", m.next.hypervolume_gpa_mpa);
    field("brought", rows_of<BroughtRow>(m.next.brought));
    field("expected", m.next.expected);
    field("is_scatter_of_fit", m.next.is_scatter_of_fit);
    field("sentence", next_in_words(m));
    field("price", m.price);
  }
};

/// run::in_words() and the price, as one sentence.
std::string next_in_words(const NextRoundRow& row);

/// `facts`: of the laboratory.
NextRoundRow next_round_row(const game::Scenario& scenario, const run::RunRecord& run,
                            const game::LaboratoryFacts& facts);

}  // namespace nacre::dashboard
