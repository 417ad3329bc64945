#pragma once
// All that a run knows of one design: proposals, simulations, cracks, specimens with curves.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/json_parts.hpp"
#include "pattern/design.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

struct SpecimenRow {
  static constexpr std::string_view kPageName = "Specimen";
  const run::MeasuredSpecimen* measured = &nothing<run::MeasuredSpecimen>();

  static void fields(auto& field, auto& m) {
    const measurement::SpecimenRecord& r = m.measured->record;
    field("specimen", r.specimen);
    field("round", m.measured->round);
    field("test", r.test);
    condition_fields(field, r.conditions);
    field("batch", r.batch);
    field("modulus_pa", r.modulus_pa ? r.modulus_pa : measurement::modulus_of(r));
    field("toughness_pa", r.toughness_pa ? r.toughness_pa : measurement::toughness_of(r));
    field("valid", r.valid);
    field("note", r.note);
    field("curve", curve_row(r.curve));
  }
};

/// The design in the proposal of a round.
struct ProposedInRound {
  static constexpr std::string_view kPageName = "ProposedInRound";
  int round = 0;
  const wire::ProposedDesign* proposed = &nothing<wire::ProposedDesign>();

  static void fields(auto& field, auto& m) {
    field("round", m.round);
    wire::ProposedDesign::fields(field, *m.proposed);
  }
};

/// The design by the model of a round; E is null where that test was not asked for, all is null where it failed.
struct SimulatedInRound {
  static constexpr std::string_view kPageName = "SimulatedInRound";
  int round = 0;
  const wire::SimulatedDesign* simulated = &nothing<wire::SimulatedDesign>();

  static void fields(auto& field, auto& m) {
    const wire::SimulatedDesign& s = *m.simulated;
    const bool is_there = s.failure.empty();
    field("round", m.round);
    field("failure", s.failure);
    field("modulus_pa", s.modulus_pa > 0.0 ? std::optional(s.modulus_pa) : std::nullopt);
    field("toughness_pa", is_there ? std::optional(s.toughness_pa) : std::nullopt);
    field("curve", curve_row(s.curve));
  }
};

/// How the design breaks by the model of a round; null where no element failed.
struct CrackInRound {
  static constexpr std::string_view kPageName = "CrackInRound";
  int round = 0;
  const wire::Fracture* fracture = &nothing<wire::Fracture>();

  static void fields(auto& field, auto& m) {
    const auto& path = m.fracture->crack.path;
    const auto of_path = [&](const auto& value) { return path ? std::optional(value(*path)) : std::nullopt; };
    field("round", m.round);
    field("film", !m.fracture->film.empty());
    field("broken", m.fracture->broken);
    field("branches", m.fracture->crack.branches);
    field("separate_cracks", m.fracture->crack.separate_cracks);
    field("path_ratio", of_path([](const auto& p) { return p.ratio(); }));
    field("bridged_share", of_path([](const auto& p) { return p.bridged_share; }));
    field("soft_share", of_path([](const auto& p) { return p.material[0]; }));
    field("rigid_share", of_path([](const auto& p) { return p.material[1]; }));
    field("interface_share", of_path([](const auto& p) { return p.material[2]; }));
    field("crosses", of_path([](const auto& p) { return p.crosses; }));
  }
};

struct DesignRow {
  static constexpr std::string_view kPageName = "Design";
  pattern::Design design;
  std::optional<std::string> violation;  ///< of a constraint of the design space
  std::vector<ProposedInRound> proposals;
  std::vector<SimulatedInRound> simulated;
  std::vector<CrackInRound> cracks;
  std::vector<SpecimenRow> specimens;

  static void fields(auto& field, auto& m) {
    field("design", m.design);
    field("rigid_fraction", m.design.rigid_fraction());
    field("violation", m.violation);
    field("proposals", m.proposals);
    field("simulated", m.simulated);
    field("cracks", m.cracks);
    field("specimens", m.specimens);
  }
};
/// Refers to the record.
DesignRow design_row(const run::RunRecord& run, const pattern::Design& design);

}  // namespace nacre::dashboard
