#include "wire/game_messages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "explore/merge.hpp"
#include "measurement/specimen_checks.hpp"
#include "measurement/summary.hpp"

namespace nacre::wire {

std::string strain_fault(double strain) {
  if (strain <= -1.0) return fmt::format("{}, expected above -1", strain);
  return Range{-kStrain.most, kStrain.most}(strain);
}

std::string Measurement::contradiction() const {
  for (const auto& [name, text] : {std::pair{"by", &by}, std::pair{"why", &why}}) {
    if (revision > 0 && text->find_first_not_of(' ') == std::string::npos)
      return fmt::format("{}: is empty, expected a text: revision {} amends specimen {}", name, revision,
                         record.specimen);
  }
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

std::string GamutChunk::contradiction() const {
  if (base >= round) return fmt::format("base: {}, expected a round before {}", base, round);
  return index_fault("chunk", chunk, chunks);
}

std::vector<GamutChunk> gamut_chunks(int round, tester::Fidelity fidelity,
                                     std::span<const explore::Evaluated> samples) {
  const std::size_t count = std::max<std::size_t>(1, (samples.size() + kGamutChunk - 1) / kGamutChunk);
  std::vector<GamutChunk> chunks;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = samples.subspan(i * kGamutChunk, std::min(kGamutChunk, samples.size() - i * kGamutChunk));
    chunks.push_back({.round = round,
                      .total = static_cast<int>(samples.size()),
                      .fidelity = fidelity,
                      .chunk = static_cast<int>(i),
                      .chunks = static_cast<int>(count),
                      .samples = {part.begin(), part.end()}});
  }
  return chunks;
}

std::vector<GamutChunk> gamut_chunks(int round, tester::Fidelity fidelity, std::span<const explore::Evaluated> samples,
                                     int base, std::span<const explore::Evaluated> base_samples) {
  const std::vector<explore::Evaluated> changes = explore::changes(base_samples, samples);
  const auto rebuilt = explore::with_changes({base_samples.begin(), base_samples.end()}, changes);
  if (base < 0 || changes.size() == samples.size() || !std::ranges::equal(rebuilt, samples))
    return gamut_chunks(round, fidelity, samples);
  std::vector<GamutChunk> chunks = gamut_chunks(round, fidelity, changes);
  for (GamutChunk& chunk : chunks) {
    chunk.base = base;
    chunk.total = static_cast<int>(samples.size());
  }
  return chunks;
}

void GamutCollector::add(GamutChunk part) {
  if (!whole_.contains(part.round)) parts_[part.round].insert_or_assign(part.chunk, std::move(part));
}

const std::vector<explore::Evaluated>* GamutCollector::whole(int round) {
  if (const auto known = whole_.find(round); known != whole_.end()) return &known->second;
  const auto parts = parts_.find(round);
  if (parts == parts_.end()) return nullptr;
  const GamutChunk& first = parts->second.begin()->second;
  if (static_cast<int>(parts->second.size()) < first.chunks) return nullptr;
  const std::vector<explore::Evaluated>* base = first.base < 0 ? nullptr : whole(first.base);
  if (first.base >= 0 && base == nullptr) return nullptr;
  std::vector<explore::Evaluated> samples;
  for (const auto& [chunk, part] : parts->second)
    samples.insert(samples.end(), part.samples.begin(), part.samples.end());
  if (base != nullptr) samples = explore::with_changes(*base, samples);
  parts_.erase(parts);
  return &whole_.emplace(round, std::move(samples)).first->second;
}

void GamutCollector::forget_before(int round) {
  parts_.erase(parts_.begin(), parts_.lower_bound(round));
  whole_.erase(whole_.begin(), whole_.lower_bound(round));
}

std::vector<FamilyGamut> family_gamut_chunks(int number, tester::Fidelity fidelity,
                                             std::span<const explore::Evaluated> samples) {
  std::vector<FamilyGamut> chunks;
  for (GamutChunk& chunk : gamut_chunks(number, fidelity, samples))
    chunks.push_back({number, fidelity, chunk.chunk, chunk.chunks, std::move(chunk.samples)});
  return chunks;
}

}  // namespace nacre::wire
