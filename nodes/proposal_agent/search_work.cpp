#include "proposal_agent/search_work.hpp"

#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "explore/mechanics.hpp"
#include "game/model.hpp"
#include "runtime/journal.hpp"

namespace nacre::proposal_agent {
namespace {

static_assert(std::endian::native == std::endian::little, "specs are written as they lie in memory");

/// A sample as it lies in a spec: exact, and short, for a spec holds thousands.
struct PackedSample {
  std::uint64_t bits = 0;
  double modulus_pa = 0.0, toughness_pa = 0.0;
};
static_assert(sizeof(PackedSample) == 24);

template <class Packed>
std::string bytes_of(const std::vector<Packed>& items) {
  std::string bytes(items.size() * sizeof(Packed), '\0');
  if (!items.empty()) std::memcpy(bytes.data(), items.data(), bytes.size());
  return bytes;
}

template <class Packed>
std::vector<Packed> items_in(const std::string& bytes) {
  std::vector<Packed> items(bytes.size() / sizeof(Packed));
  if (!items.empty()) std::memcpy(items.data(), bytes.data(), items.size() * sizeof(Packed));
  return items;
}

std::string packed(const std::vector<explore::Evaluated>& samples) {
  std::vector<PackedSample> items;
  for (const explore::Evaluated& sample : samples)
    items.push_back({sample.pattern.bits(), sample.performance.modulus_pa, sample.performance.toughness_pa});
  return bytes_of(items);
}

std::vector<explore::Evaluated> unpacked(const std::string& bytes) {
  std::vector<explore::Evaluated> samples;
  for (const PackedSample& item : items_in<PackedSample>(bytes))
    samples.push_back({pattern::Pattern(item.bits), {item.modulus_pa, item.toughness_pa}});
  return samples;
}

std::string packed(const std::vector<pattern::Pattern>& patterns) {
  std::vector<std::uint64_t> items;
  for (const pattern::Pattern& pattern : patterns) items.push_back(pattern.bits());
  return bytes_of(items);
}

std::vector<pattern::Pattern> patterns_in(const std::string& bytes) {
  std::vector<pattern::Pattern> patterns;
  for (const std::uint64_t bits : items_in<std::uint64_t>(bytes)) patterns.emplace_back(bits);
  return patterns;
}

explore::BatchRequest batch_request_from(const std::string& spec) {
  const auto fields = runtime::unpack(spec);
  // A spec that this program wrote itself must read back.
  if (!fields || fields->size() != 8) throw std::logic_error("the spec of a search is damaged");
  explore::BatchRequest batch_request;
  batch_request.settings.algorithm = fields->at(0);
  batch_request.settings.seed = std::stoull(fields->at(1));
  batch_request.count = std::stoi(fields->at(2));
  batch_request.evaluated = unpacked(fields->at(3));
  batch_request.lost = patterns_in(fields->at(4));
  batch_request.settings.former = unpacked(fields->at(5));
  batch_request.settings.population = std::stoi(fields->at(6));
  const auto model = wire::read<wire::AdoptedModel>(fields->at(7));
  if (!model) throw std::logic_error("the model in the spec of a search: " + model.error().message);
  // On one core: the farm has the others.
  batch_request.settings.mechanics =
      explore::mechanics_by_tester(game::material_side(model->parameters), model->fidelity, 1);
  return batch_request;
}

}  // namespace

std::string search_spec(const explore::BatchRequest& batch_request, const wire::AdoptedModel& model) {
  assert(batch_request.settings.learned == explore::LearnedSettings{});
  return runtime::pack({batch_request.settings.algorithm, std::to_string(batch_request.settings.seed),
                        std::to_string(batch_request.count), packed(batch_request.evaluated),
                        packed(batch_request.lost), packed(batch_request.settings.former),
                        std::to_string(batch_request.settings.population), wire::write(model)});
}

std::string search_work(const std::string& spec) {
  return runtime::pack({packed(explore::batch_for(batch_request_from(spec)))});
}

Result<std::vector<pattern::Pattern>> batch_from_result(const std::string& result) {
  const auto fields = runtime::unpack(result);
  if (!fields) return tl::unexpected(fields.error());
  if (fields->size() != 1) return fail("{} fields, expected 1", fields->size());
  std::vector<pattern::Pattern> batch = patterns_in(fields->front());
  for (const pattern::Pattern& pattern : batch) {
    if (pattern.bits() >> pattern::kFreePixels) return fail("{:x} is no pattern", pattern.bits());
  }
  return batch;
}

}  // namespace nacre::proposal_agent
