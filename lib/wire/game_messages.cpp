#include "wire/game_messages.hpp"

#include <algorithm>
#include <iterator>

#include "measurement/specimen_checks.hpp"
#include "measurement/summary.hpp"

namespace nacre::wire {

std::string strain_fault(double strain) {
  if (strain <= -1.0) return fmt::format("{}, expected above -1", strain);
  return Range{-kStrain.most, kStrain.most}(strain);
}

std::string Measurement::contradiction() const {
  if (!record.valid) return {};
  const auto fault = measurement::why_unusable(record);
  return fault ? fmt::format("specimen {}: {} {}", record.specimen, fault->column, fault->reason) : "";
}

measurement::SpecimenRecord fit_to_send(measurement::SpecimenRecord specimen) {
  const tester::Curve whole = specimen.curve;
  if (whole.size() <= kMaximumCurvePoints) return specimen;
  if (specimen.test == tester::TestKind::toughness) specimen.toughness_pa = measurement::toughness_of(specimen);
  specimen.curve = {};
  for (std::size_t i = 0; i < kMaximumCurvePoints; ++i) {
    const std::size_t k = i * (whole.size() - 1) / (kMaximumCurvePoints - 1);
    specimen.curve.strain.push_back(whole.strain[k]);
    specimen.curve.stress_pa.push_back(whole.stress_pa[k]);
  }
  return specimen;
}

std::vector<GamutChunk> gamut_chunks(int round, tester::Fidelity fidelity,
                                     std::span<const explore::Evaluated> samples) {
  const std::size_t count = std::max<std::size_t>(1, (samples.size() + kGamutChunk - 1) / kGamutChunk);
  std::vector<GamutChunk> chunks;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = samples.subspan(i * kGamutChunk, std::min(kGamutChunk, samples.size() - i * kGamutChunk));
    chunks.push_back({round, fidelity, static_cast<int>(i), static_cast<int>(count), {part.begin(), part.end()}});
  }
  return chunks;
}

std::optional<std::vector<explore::Evaluated>> GamutCollector::add(GamutChunk part) {
  const int round = part.round;
  const int chunks = part.chunks;
  auto& parts = parts_[round];
  parts.insert_or_assign(part.chunk, std::move(part));
  if (static_cast<int>(parts.size()) < chunks) return std::nullopt;
  std::vector<explore::Evaluated> whole;
  for (const auto& [chunk, piece] : parts) whole.insert(whole.end(), piece.samples.begin(), piece.samples.end());
  parts_.erase(round);
  return whole;
}

std::vector<FamilyGamut> family_gamut_chunks(int number, tester::Fidelity fidelity,
                                             std::span<const explore::Evaluated> samples) {
  std::vector<FamilyGamut> chunks;
  for (GamutChunk& chunk : gamut_chunks(number, fidelity, samples))
    chunks.push_back({number, fidelity, chunk.chunk, chunk.chunks, std::move(chunk.samples)});
  return chunks;
}

}  // namespace nacre::wire
