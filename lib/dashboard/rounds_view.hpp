#pragma once
// The game by rounds.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dashboard/json_parts.hpp"
#include "dashboard/live_search.hpp"
#include "run/adopted_model.hpp"
#include "run/measured_patterns.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

struct RoundRow {
  static constexpr std::string_view kPageName = "Round";
  int number = 0;
  const run::RoundRecord* round = &nothing<run::RoundRecord>();
  int gamut_count = 0;
  std::vector<std::array<double, 2>> measured_front;

  static void fields(auto& field, auto& m) {
    const auto& model = m.round->model;
    const auto& diagnosis = m.round->diagnosis;
    field("round", m.number);
    field("summary", m.round->summary);
    field("gamut_count", m.gamut_count);
    field("measured_front", m.measured_front);
    field("benchmark", points_of(run::line_as_measured(*m.round)));
    field("proposals", m.round->proposals);
    field("parameters", model ? run::named_parameters(model->parameters) : std::map<std::string, double>{});
    field("verdict", diagnosis ? std::optional(diagnosis->verdict) : std::nullopt);
  }
};

/// A measured pattern: means and standard deviations of its replicates.
struct MeasuredRow {
  static constexpr std::string_view kPageName = "Measured";
  run::MeasuredPattern measured;

  static void fields(auto& field, auto& m) {
    field("design", m.measured.pattern);
    field("round", m.measured.round);
    field("rigid_fraction", m.measured.pattern.rigid_fraction());
    field("modulus_pa", m.measured.mean.modulus_pa);
    field("modulus_sd_pa", m.measured.modulus_sd_pa);
    field("modulus_count", m.measured.modulus_count);
    field("toughness_pa", m.measured.mean.toughness_pa);
    field("toughness_sd_pa", m.measured.toughness_sd_pa);
    field("toughness_count", m.measured.toughness_count);
  }
};

/// What a virtual laboratory had hidden.
struct RevealedRow {
  static constexpr std::string_view kPageName = "Revealed";
  const wire::Reveal* reveal = &nothing<wire::Reveal>();

  static void fields(auto& field, auto& m) {
    field("causes", m.reveal->causes);
    field("modulus_noise", m.reveal->modulus_noise);
    field("toughness_noise", m.reveal->toughness_noise);
    field("parameters", run::named_parameters(m.reveal->parameters));
  }
};

/// Per round: summary, errors, model, size of the gamut, proposals, measured front; and every measured pattern. Refers
/// to the record that it was made of. A round that is being searched has the size that its gamut has come to.
struct RoundsRow {
  static constexpr std::string_view kPageName = "Rounds";
  std::vector<RoundRow> rounds;
  std::vector<MeasuredRow> measured;
  std::optional<RevealedRow> revealed;  ///< after the last round of a virtual laboratory

  static void fields(auto& field, auto& m) {
    field("rounds", m.rounds);
    field("measured", m.measured);
    field("revealed", m.revealed);
  }
};
RoundsRow rounds_row(const run::RunRecord& run, const std::optional<LiveSearch::Progress>& search);

}  // namespace nacre::dashboard
