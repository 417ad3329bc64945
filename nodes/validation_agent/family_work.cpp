#include "validation_agent/family_work.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "base/counted.hpp"
#include "base/expected.hpp"
#include "base/files.hpp"
#include "families/dense_sampling.hpp"
#include "families/families_file.hpp"
#include "pattern/pattern_key.hpp"
#include "runtime/journal.hpp"
#include "wire/convert.hpp"

namespace nacre::validation_agent {
namespace {

constexpr const char* kFamiliesFile = "families.toml";

/// Designs in chunks, for there may be more of them than a message holds.
std::vector<families::MeasuredPattern> members_from(std::span<const std::string> chunks) {
  std::vector<families::MeasuredPattern> members;
  for (const std::string& payload : chunks)
    for (const explore::Evaluated& each : expected(wire::read<wire::GamutChunk>(payload)).samples)
      members.push_back({each.pattern, each.performance});
  return members;
}

/// Seeds must be measured: the calibration stands on them.
void check_seeds(const std::vector<families::SeedFamily>& families,
                 const std::vector<families::MeasuredPattern>& measured, const std::filesystem::path& file) {
  for (const families::SeedFamily& family : families) {
    for (const pattern::Pattern& seed : family.seeds) {
      if (std::ranges::count(measured, seed, &families::MeasuredPattern::pattern) == 0)
        throw InputError::format("{}: family '{}': seed {} is not measured in both tests", file.string(), family.name,
                                 seed.key());
    }
  }
}

std::string grouping_work(const std::filesystem::path& folder, const std::string& spec) {
  const std::vector<std::string> fields = expected(runtime::unpack(spec));
  const std::vector<families::MeasuredPattern> measured = members_from(std::span(fields).subspan(1));
  const std::filesystem::path file = folder / kFamiliesFile;
  const auto result = [](const std::vector<families::SeedFamily>& families, const std::string& remark, bool is_faulty) {
    return runtime::pack({families::to_toml(families), remark, is_faulty ? "faulty" : ""});
  };
  const auto proposed = families::proposed_families(families::near_pareto(measured, std::stoi(fields.at(0))));
  if (!folder.empty() && std::filesystem::exists(file)) {
    try {
      const std::vector<families::SeedFamily> chosen = families::read_families(file);
      check_seeds(chosen, measured, file);
      // A file that equals the proposal may be this program's own, from before a restart.
      if (chosen != proposed)
        return result(chosen, fmt::format("{} of {}", counted(std::ssize(chosen), "family", "families"), kFamiliesFile),
                      false);
    } catch (const InputError& error) {
      return result(proposed, fmt::format("{}; the families are proposed by pattern and properties", error.what()),
                    true);
    }
  }
  if (!folder.empty()) {
    std::filesystem::create_directories(folder);
    write_file_atomically(file, families::to_toml(proposed));
  }
  return result(
      proposed,
      fmt::format("{} proposed by pattern and properties", counted(std::ssize(proposed), "family", "families")), false);
}

std::string sampling_work(const std::string& spec) {
  const std::vector<std::string> fields = expected(runtime::unpack(spec));
  const std::vector<families::SeedFamily> families = families::parse_families(fields.at(0), "a sampling");
  families::DenseSampler sampler(families.at(0).seeds, {.seed = std::stoull(fields.at(2))});
  const auto wanted = static_cast<std::size_t>(std::stoi(fields.at(1)));
  while (sampler.members().size() < wanted && !sampler.exhausted()) sampler.next();
  std::vector<std::string> keys;
  // The last batch may be more than was wanted; seeds, which come first, stay whatever is wanted.
  const std::size_t count = std::min(sampler.members().size(), std::max(wanted, families.at(0).seeds.size()));
  for (const pattern::Pattern& member : std::span(sampler.members()).first(count)) keys.push_back(member.key());
  return runtime::pack(keys);
}

}  // namespace

std::string grouping_spec(const std::vector<families::MeasuredPattern>& measured, int rank) {
  std::vector<explore::Evaluated> samples;
  for (const families::MeasuredPattern& each : measured) samples.push_back({each.pattern, each.performance});
  std::vector<std::string> fields = {std::to_string(rank)};
  for (const wire::GamutChunk& chunk : wire::gamut_chunks(0, tester::Fidelity::full, samples))
    fields.push_back(wire::write(chunk));
  return runtime::pack(fields);
}

Grouping grouping_from(const std::string& result) {
  const std::vector<std::string> fields = expected(runtime::unpack(result));
  return {.families = families::parse_families(fields.at(0), "a grouping"),
          .remark = fields.at(1),
          .file_is_faulty = !fields.at(2).empty()};
}

std::string sampling_spec(const families::SeedFamily& family, int samples, std::uint64_t seed) {
  return runtime::pack({families::to_toml({family}), std::to_string(samples), std::to_string(seed)});
}

std::vector<pattern::Pattern> sample_from(const std::string& result) {
  std::vector<pattern::Pattern> sample;
  for (const std::string& key : expected(runtime::unpack(result)))
    sample.push_back(expected(pattern::pattern_from_key(key)));
  return sample;
}

std::map<std::string, runtime::WorkFunction> work_functions(const std::filesystem::path& run_dir) {
  const std::filesystem::path folder = run_dir.empty() ? run_dir : run_dir / "families";
  return {{"group_families", [folder](const std::string& spec) { return grouping_work(folder, spec); }},
          {"sample_family", sampling_work}};
}

}  // namespace nacre::validation_agent
