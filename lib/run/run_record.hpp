#pragma once
// A run as its messages tell it: what report, dashboard and command line read. Values of the messages themselves.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/measurement_book.hpp"
#include "measurement/specimen_record.hpp"
#include "optimize/pareto.hpp"
#include "wire/convert.hpp"

namespace nacre::run {

/// Patterns that a search evaluated, by key; two columns of equal length.
struct Gamut {
  std::vector<std::uint64_t> patterns;  ///< bits, as pattern::Pattern
  std::vector<optimize::Performance> performances;
};

/// One round; parts that have not been received yet are empty.
struct RoundRecord {
  std::optional<wire::RoundSummary> summary;
  std::optional<wire::AdoptedModel> model;
  int gamut_count = 0;                 ///< samples received
  bool is_gamut_whole = false;         ///< with all chunks of it and its bases
  std::shared_ptr<const Gamut> gamut;  ///< where it was asked for (Run::record_with_gamuts), else nullptr
  std::vector<wire::ProposedDesign> proposals;
  std::optional<wire::Diagnosis> diagnosis;
  bool repeats_model = false;  ///< simulates as that of the round before: what `simulated` has there holds here, too
  std::map<std::string, wire::SimulatedDesign> simulated;  ///< measured designs by this round's model, by design
  std::map<std::string, wire::Fracture> cracks;            ///< of the proposals, by design
};

struct MeasuredSpecimen {
  int round = -1;                      ///< that it was ordered in; -1: nobody ordered it
  int measured_in = 0;                 ///< round
  game::Amendment amendment;           ///< the last one; revision 0: none
  measurement::SpecimenRecord record;  ///< as amended, validity as reviewed
};

/// A family of the stage after the game.
struct FamilyRecord {
  wire::CalibratedFamily stated;
  int gamut_count = 0;
  std::shared_ptr<const Gamut> gamut;            ///< its variants by its own model, as RoundRecord::gamut
  std::map<std::string, wire::Fracture> cracks;  ///< of its seeds and chosen designs by its own model, by design
};

struct RunRecord {
  std::map<int, RoundRecord> rounds;
  std::vector<FamilyRecord> families;       ///< by number; empty where no stage was played
  std::vector<MeasuredSpecimen> specimens;  ///< by name
  std::optional<wire::Reveal> revealed;     ///< by a virtual laboratory, after the last round
  /// False where the scenario turns diagnosis off: none is to be awaited.
  bool is_diagnosed = true;
};

/// Of a round or a family; without patterns where it was not asked for.
const Gamut& gamut_of(const RoundRecord& round);
const Gamut& gamut_of(const FamilyRecord& family);

/// E and T of a design as the gamut has them.
inline optimize::Performance predicted(const wire::ProposedDesign& design) {
  return {design.modulus_pa, design.toughness_pa};
}

/// An effect that a diagnosis names, once each: a further row is a further parameter of it.
std::vector<wire::DiagnosedEffect> named_effects(const wire::Diagnosis& diagnosis);

}  // namespace nacre::run
