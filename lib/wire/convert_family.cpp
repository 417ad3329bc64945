// Part of the conversions (convert.hpp): FAMILY and FAMILY_GAMUT.

#include "wire/checks.hpp"
#include "wire/convert.hpp"

namespace nacre::wire {
namespace {

using game::FamilyDesign;

std::optional<double> value_or_none(double value_pa) {
  return value_pa > 0.0 ? std::optional<double>(value_pa) : std::nullopt;
}

family_design_t to_wire_design(const FamilyDesign& design) {
  return {static_cast<std::int64_t>(design.pattern.bits()), design.is_seed,
          design.measured.modulus_pa.value_or(0.0),         design.measured.toughness_pa.value_or(0.0),
          design.global_model.modulus_pa.value_or(0.0),     design.global_model.toughness_pa.value_or(0.0),
          design.family_model.modulus_pa.value_or(0.0),     design.family_model.toughness_pa.value_or(0.0)};
}

Result<FamilyDesign> design_of(const family_design_t& message) {
  const Result<pattern::Pattern> pattern = pattern_from_bits(message.pattern);
  if (!pattern) return tl::unexpected(pattern.error());
  const Result<void> sound = all_of(expect_pressure("measured_modulus_pa", message.measured_modulus_pa),
                                    expect_pressure("measured_toughness_pa", message.measured_toughness_pa),
                                    expect_pressure("global_modulus_pa", message.global_modulus_pa),
                                    expect_pressure("global_toughness_pa", message.global_toughness_pa),
                                    expect_pressure("family_modulus_pa", message.family_modulus_pa),
                                    expect_pressure("family_toughness_pa", message.family_toughness_pa));
  if (!sound) return tl::unexpected(sound.error());
  return FamilyDesign{
      .pattern = *pattern,
      .is_seed = message.is_seed != 0,
      .measured = {value_or_none(message.measured_modulus_pa), value_or_none(message.measured_toughness_pa)},
      .global_model = {value_or_none(message.global_modulus_pa), value_or_none(message.global_toughness_pa)},
      .family_model = {value_or_none(message.family_modulus_pa), value_or_none(message.family_toughness_pa)}};
}

}  // namespace

family_t to_wire(const CalibratedFamily& family) {
  family_t message{};
  message.round = family.round;
  message.fidelity = to_wire(family.fidelity);
  message.number = family.number;
  message.count = family.count;
  message.name = family.name;
  message.is_validated = family.is_validated;
  message.parameters = to_wire(family.parameters);
  message.simulations = family.simulations;
  message.samples = family.samples;
  for (const FamilyDesign& design : family.designs) message.designs.push_back(to_wire_design(design));
  return message;
}

Result<CalibratedFamily> from_wire(const family_t& message) {
  constexpr std::string_view type = "family_t";
  const Result<void> sound =
      all_of(expect_round(message.round), expect_range("count", message.count, 1, 1000),
             expect_index("number", message.number, message.count), expect_name("name", message.name),
             expect_range("simulations", message.simulations, 0, kLargestCount),
             expect_range("samples", message.samples, 0, kLargestCount),
             expect_count("designs", message.designs.size(), kMostFamilyDesigns));
  if (!sound) return in_type(type, sound.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  const Result<material::ParameterSet> parameters = from_wire(message.parameters);
  if (!parameters) return in_type(type, parameters.error());
  CalibratedFamily family{.round = message.round,
                          .fidelity = *fidelity,
                          .number = message.number,
                          .count = message.count,
                          .name = message.name,
                          .is_validated = message.is_validated != 0,
                          .parameters = *parameters,
                          .simulations = message.simulations,
                          .samples = message.samples,
                          .designs = {}};
  for (const family_design_t& each : message.designs) {
    const Result<FamilyDesign> design = design_of(each);
    if (!design) return in_type(type, design.error());
    family.designs.push_back(*design);
  }
  return family;
}

family_gamut_t to_wire(const FamilyGamut& gamut) {
  const gamut_t same = to_wire(GamutChunk{gamut.number, gamut.fidelity, gamut.chunk, gamut.chunks, gamut.samples});
  family_gamut_t message{};
  message.number = gamut.number;
  message.fidelity = same.fidelity;
  message.chunk = gamut.chunk;
  message.chunks = gamut.chunks;
  message.pattern = same.pattern;
  message.modulus_pa = same.modulus_pa;
  message.toughness_pa = same.toughness_pa;
  return message;
}

Result<FamilyGamut> from_wire(const family_gamut_t& message) {
  gamut_t same{};
  same.round = message.number;
  same.fidelity = message.fidelity;
  same.chunk = message.chunk;
  same.chunks = message.chunks;
  same.pattern = message.pattern;
  same.modulus_pa = message.modulus_pa;
  same.toughness_pa = message.toughness_pa;
  Result<GamutChunk> chunk = from_wire(same);
  if (!chunk) return in_type("family_gamut_t", chunk.error());
  return FamilyGamut{message.number, chunk->fidelity, chunk->chunk, chunk->chunks, std::move(chunk->samples)};
}

std::vector<FamilyGamut> family_gamut_chunks(int number, tester::Fidelity fidelity,
                                             std::span<const explore::Evaluated> samples) {
  std::vector<FamilyGamut> chunks;
  for (GamutChunk& chunk : gamut_chunks(number, fidelity, samples))
    chunks.push_back({number, fidelity, chunk.chunk, chunk.chunks, std::move(chunk.samples)});
  return chunks;
}

}  // namespace nacre::wire
