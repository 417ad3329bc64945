#include "run/recording.hpp"

#include <algorithm>
#include <utility>

#include "base/names.hpp"
#include "game/model.hpp"
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
    read_as<wire::GamutChunk>(payload, [&](const wire::GamutChunk& gamut) { take(id, gamut); });
  } else if (channel == "FAMILY_GAMUT") {
    read_as<wire::FamilyGamut>(payload, [&](const wire::FamilyGamut& g) {
      if (variants_[g.number].ids.emplace(g.chunk, id).second)
        variants_[g.number].count += static_cast<int>(g.samples.size());
    });
  } else if (channel == "DIAGNOSIS") {
    read_as<wire::Diagnosis>(payload, [&](wire::Diagnosis d) { rounds_[d.round].diagnosis = std::move(d); });
  }
}

void Recording::take(std::int64_t id, const wire::GamutChunk& gamut) {
  rounds_.try_emplace(gamut.round);
  Chunks& known = gamuts_[gamut.round];
  if (!known.ids.emplace(gamut.chunk, id).second) return;
  known.base = gamut.base;
  known.total = gamut.total;
  known.chunks = gamut.chunks;
  known.count += static_cast<int>(gamut.samples.size());
}

/// A game with a family stage closes its last round twice: the second ROUND counts, whatever comes after it.
void Recording::take(const wire::RoundSummary& summary) {
  auto& known = rounds_[summary.round].summary;
  if (known && known->last && !summary.last) return;
  known = summary;
  closed_.close(summary.round, summary.last);
}

/// The highest revision of a specimen counts, and of two reports with one revision the first: the other one is refused
/// by the validation agent, too. An amendment measures nothing anew: the round stays.
void Recording::take(const wire::Measurement& measured) {
  MeasuredSpecimen specimen{.round = measured.round,
                            .measured_in = measured_in(measured, closed_),
                            .amendment = {measured.revision, measured.by, measured.why},
                            .record = measured.record};
  const auto [position, is_new] = specimens_.try_emplace(measured.record.specimen, specimen);
  if (is_new) return;
  MeasuredSpecimen& known = position->second;
  known.measured_in = specimen.measured_in = std::min(known.measured_in, specimen.measured_in);
  if (specimen.amendment.revision > known.amendment.revision) known = std::move(specimen);
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
  const RoundRecord* before = nullptr;
  for (auto& [number, round] : record.rounds) {
    describe_gamut(number, round);
    round.repeats_model =
        before != nullptr && before->model && round.model &&
        game::material_side(before->model->parameters) == game::material_side(round.model->parameters);
    before = &round;
  }
  for (const auto& [number, family] : families_) {
    if (family.stated.name.empty()) continue;  // its cracks come before its FAMILY
    record.families.push_back(family);
    if (const auto variants = variants_.find(number); variants != variants_.end())
      record.families.back().gamut_count = variants->second.count;
  }
  for (const auto& [name, specimen] : specimens_) {
    const auto review = reviews_.find(name);
    record.specimens.push_back(reviewed(specimen, review == reviews_.end() ? nullptr : &review->second));
  }
  return record;
}

/// The gamut's own messages and those of its bases, as far as they have come.
void Recording::describe_gamut(int number, RoundRecord& round) const {
  const auto own = gamuts_.find(number);
  if (own == gamuts_.end()) return;
  int count = 0;
  round.is_gamut_whole = true;
  for (int base = number; base >= 0;) {
    const auto chunks = gamuts_.find(base);
    const bool is_there = chunks != gamuts_.end();
    round.is_gamut_whole =
        round.is_gamut_whole && is_there && std::cmp_equal(chunks->second.ids.size(), chunks->second.chunks);
    if (!is_there) break;
    count += chunks->second.count;
    base = chunks->second.base;
  }
  // Changed samples are no further ones.
  round.gamut_count = own->second.base < 0 ? count : std::min(count, own->second.total);
}

std::vector<std::int64_t> Recording::gamut_messages(int round) const {
  std::vector<const Chunks*> chain;
  for (auto chunks = gamuts_.find(round); chunks != gamuts_.end(); chunks = gamuts_.find(chunks->second.base))
    chain.push_back(&chunks->second);
  std::vector<std::int64_t> ids;
  for (auto chunks = chain.rbegin(); chunks != chain.rend(); ++chunks)
    for (const auto& [place, id] : (*chunks)->ids) ids.push_back(id);
  return ids;
}

std::vector<std::int64_t> Recording::variant_messages(int family) const {
  std::vector<std::int64_t> ids;
  if (const auto chunks = variants_.find(family); chunks != variants_.end())
    for (const auto& [place, id] : chunks->second.ids) ids.push_back(id);
  return ids;
}

}  // namespace nacre::run
