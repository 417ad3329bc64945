#include "run/recording.hpp"

#include <algorithm>

#include "base/names.hpp"
#include "measurement/specimen_checks.hpp"

namespace nacre::run {
namespace {

/// Calls `use` with the message, where it decodes.
template <class Domain, class Use>
void read_as(const std::string& payload, const Use& use) {
  if (auto value = wire::read<Domain>(payload)) use(*std::move(value));
}

/// Validity and note as reviewed. A review makes no specimen valid that has no usable value, as for the validation
/// agent.
MeasuredSpecimen reviewed(MeasuredSpecimen specimen, const wire::Review* review) {
  if (review != nullptr) {
    specimen.record.valid = review->valid;
    specimen.record.note = review->why;
  }
  specimen.record.valid = specimen.record.valid && !measurement::why_unusable(specimen.record);
  return specimen;
}

}  // namespace

void Recording::take(std::int64_t id, std::string_view channel, const std::string& payload) {
  const auto take_value = [&](const auto& value) { take(value); };
  if (channel == "ROUND") read_as<wire::RoundSummary>(payload, take_value);
  if (channel == "MEASUREMENT") read_as<wire::Measurement>(payload, take_value);
  if (channel == "SIMULATED") read_as<wire::SimulateResult>(payload, take_value);
  if (channel == "FRACTURE") read_as<wire::Fracture>(payload, take_value);
  if (channel == "FAMILY") read_as<wire::CalibratedFamily>(payload, take_value);
  if (channel == "REVIEW") take_review(payload);
  if (channel == "REVEAL") read_as<wire::Reveal>(payload, [&](wire::Reveal r) { revealed_ = std::move(r); });
  if (channel == "PARAMETERS") {
    read_as<wire::AdoptedModel>(payload, [&](wire::AdoptedModel model) { rounds_[model.round].model = model; });
  } else if (channel == "PROPOSAL") {
    read_as<wire::Proposal>(payload, [&](wire::Proposal p) { rounds_[p.round].proposals = std::move(p.designs); });
  } else if (channel == "GAMUT") {
    read_as<wire::GamutChunk>(payload, [&](const wire::GamutChunk& g) {
      rounds_.try_emplace(g.round);
      gamuts_[g.round][g.chunk] = {id, static_cast<int>(g.samples.size())};
    });
  } else if (channel == "FAMILY_GAMUT") {
    read_as<wire::FamilyGamut>(payload, [&](const wire::FamilyGamut& g) {
      variants_[g.number][g.chunk] = {id, static_cast<int>(g.samples.size())};
    });
  } else if (channel == "DIAGNOSIS") {
    read_as<wire::Diagnosis>(payload, [&](wire::Diagnosis d) { rounds_[d.round].diagnosis = std::move(d); });
  }
}

/// A game with a family stage closes its last round twice: the second ROUND counts, whatever comes after it.
void Recording::take(const wire::RoundSummary& summary) {
  auto& known = rounds_[summary.round].summary;
  if (known && known->last && !summary.last) return;
  known = summary;
  closed_.close(summary.round, summary.last);
}

/// The first report of a specimen counts: a different one with the same name is refused by the validation agent, too.
void Recording::take(const wire::Measurement& measured) {
  specimens_.try_emplace(measured.record.specimen, MeasuredSpecimen{.round = measured.round,
                                                                    .measured_in = measured_in(measured, closed_),
                                                                    .record = measured.record});
}

/// The highest revision counts; of two with one revision "not valid" stands, whichever came first.
void Recording::take_review(const std::string& payload) {
  const auto review = wire::read<wire::Review>(payload);
  if (!review) return;
  const auto [known, is_new] = reviews_.try_emplace(review->specimen, *review);
  const auto rank = [](const wire::Review& r) { return std::pair(r.revision, !r.valid); };
  if (rank(*review) > rank(known->second)) known->second = *review;
}

/// Responses to the analyser's own request `analyser/rN/measured`: what the model of round N predicts for the measured
/// designs.
void Recording::take(const wire::SimulateResult& response) {
  const auto round = number_between("analyser/r", "/measured", response.request_id);
  if (!round) return;
  for (const wire::SimulatedDesign& design : response.results)
    rounds_[*round].simulated.insert_or_assign(design.design.name(), design);
}

/// Responses to the analyser's own requests: how the designs proposed in round N break, and those of family N.
void Recording::take(const wire::Fracture& fracture) {
  const std::string design = fracture.design.name();
  if (const auto round = number_between("analyser/r", "/films", fracture.request_id))
    rounds_[*round].cracks.insert_or_assign(design, fracture);
  if (const auto family = number_between("analyser/family", "/films", fracture.request_id))
    families_[*family].cracks.insert_or_assign(design, fracture);
}

/// A family that is validated is not put back by an older FAMILY.
void Recording::take(const wire::CalibratedFamily& family) {
  wire::CalibratedFamily& stated = families_[family.number].stated;
  if (!stated.is_validated || family.is_validated) stated = family;
}

RunRecord Recording::record() const {
  RunRecord record;
  record.rounds = rounds_;
  record.revealed = revealed_;
  for (auto& [number, round] : record.rounds) round.gamut_count = count_of(gamuts_, number);
  for (const auto& [number, family] : families_) {
    if (family.stated.name.empty()) continue;  // its cracks come before its FAMILY
    record.families.push_back(family);
    record.families.back().gamut_count = count_of(variants_, number);
  }
  for (const auto& [name, specimen] : specimens_) {
    const auto review = reviews_.find(name);
    record.specimens.push_back(reviewed(specimen, review == reviews_.end() ? nullptr : &review->second));
  }
  return record;
}

std::vector<std::int64_t> Recording::ids_of(const Chunks& chunks, int number) {
  std::vector<std::int64_t> ids;
  if (const auto found = chunks.find(number); found != chunks.end())
    for (const auto& [place, chunk] : found->second) ids.push_back(chunk.id);
  return ids;
}

int Recording::count_of(const Chunks& chunks, int number) {
  int count = 0;
  if (const auto found = chunks.find(number); found != chunks.end())
    for (const auto& [place, chunk] : found->second) count += chunk.count;
  return count;
}

}  // namespace nacre::run
