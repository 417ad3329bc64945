#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/result.hpp"
#include "base/statistics.hpp"
#include "commands.hpp"
#include "growth.hpp"

namespace nacre::search_study {
namespace {

/// First number of samples with at least this hypervolume.
std::optional<int> samples_until(const Growth& growth, double hypervolume) {
  for (const auto& [samples, step] : growth) {
    if (step.hypervolume_gpa_mpa >= hypervolume) return samples;
  }
  return std::nullopt;
}

/// Names of the variants that have growth tables.
std::vector<std::string> variants_in(const Options& options) {
  const std::string begin = fmt::format("{}-{}-", options.fidelity, options.set), end = "-growth.csv";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(options.work)) {
    std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(end)) continue;
    name = name.substr(begin.size(), name.size() - begin.size() - end.size());
    name = name.substr(0, name.rfind('-'));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

void print_variant(const Options& options, const std::string& variant, double goal, double reference_samples) {
  const std::vector<Growth> growths = growths_of(options, variant);
  if (growths.empty()) return;
  std::vector<double> until, final, at_1000;
  double thinking = 0.0, simulating = 0.0;
  int most = 0;
  for (const Growth& growth : growths) {
    if (const auto samples = samples_until(growth, goal)) until.push_back(*samples);
    final.push_back(growth.rbegin()->second.hypervolume_gpa_mpa);
    most = std::max(most, growth.rbegin()->first);
    at_1000.push_back(hypervolume_at(growth, 1000));
    for (const auto& [samples, step] : growth) thinking += step.thinking_s, simulating += step.simulating_s;
  }
  const auto range = [](const std::vector<double>& values) {
    return fmt::format("{:.4f} ({:.4f} to {:.4f})", mean(values), *std::min_element(values.begin(), values.end()),
                       *std::max_element(values.begin(), values.end()));
  };
  std::string reached = fmt::format("{} of {}", until.size(), growths.size()), ratio = "-";
  if (until.size() == growths.size()) {
    const double worst = *std::max_element(until.begin(), until.end());
    reached = fmt::format("{:.0f} (worst {:.0f})", mean(until), worst);
    ratio = fmt::format("{:.1f} (worst {:.1f})", reference_samples / mean(until), reference_samples / worst);
  }
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.0f} / {:.0f} |\n", variant, growths.size(), most, range(at_1000),
             range(final), reached, ratio, thinking / static_cast<double>(growths.size()),
             simulating / static_cast<double>(growths.size()));
}

}  // namespace

void summarise(const Options& options) {
  const std::vector<Growth> reference = growths_of(options, options.reference);
  if (reference.empty()) throw InputError::format("no run of {} in {}", options.reference, options.work);
  std::vector<double> final;
  double samples = 0.0;
  for (const Growth& growth : reference) {
    final.push_back(growth.rbegin()->second.hypervolume_gpa_mpa);
    samples += growth.rbegin()->first / static_cast<double>(reference.size());
  }
  const double goal = mean(final);
  fmt::print("Goal: {:.5f} GPa MPa, the mean final hypervolume of {} after {:.0f} samples\n\n", goal, options.reference,
             samples);
  fmt::print(
      "| variant | seeds | samples | hypervolume at 1000 | at the end | samples to the goal | ratio | thinking / "
      "simulating, processor s per run |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const std::string& variant : variants_in(options)) print_variant(options, variant, goal, samples);
}

}  // namespace nacre::search_study
