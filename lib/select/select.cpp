#include "select/select.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/result.hpp"
#include "select/beam.hpp"
#include "select/candidates.hpp"
#include "select/radial_bins.hpp"

namespace nacre::select {
namespace {

void check_settings(const SelectionSettings& settings) {
  const auto check = [](std::string_view key, int value) {
    if (value < 1) throw InputError::format("selection: {} = {}, expected at least 1", key, value);
  };
  check("count", settings.count);
  check("beam_width", settings.beam_width);
  check("maximum_rank", settings.maximum_rank);
}

/// A candidate that was chosen, for its bin or, with bin -1, to fill up.
struct Choice {
  std::size_t candidate = 0;
  int bin = -1;
};

/// One candidate for every bin that has any.
std::vector<Choice> choose_from_bins(const std::vector<explore::Evaluated>& candidates,
                                     std::span<const pattern::Pattern> measured, const SelectionSettings& settings) {
  const std::vector<int> bin_of = radial_bins(candidates, settings.count);
  std::vector<std::vector<std::size_t>> members(settings.count);
  for (std::size_t i = 0; i < candidates.size(); ++i) members[bin_of[i]].push_back(i);
  std::vector<std::vector<pattern::Pattern>> occupied;
  std::vector<int> occupied_bins;
  for (int bin = 0; bin < settings.count; ++bin) {
    const auto& indices = members[bin];
    if (indices.empty()) continue;
    occupied_bins.push_back(bin);
    occupied.emplace_back();
    for (const std::size_t i : indices) occupied.back().push_back(candidates[i].pattern);
  }
  const std::vector<std::size_t> chosen = beam_search(occupied, measured, settings.beam_width);
  std::vector<Choice> choices;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    choices.push_back({members[occupied_bins[k]][chosen[k]], occupied_bins[k]});
  }
  return choices;
}

/// Adds the candidates that differ most from everything measured and chosen, one by one, until `count` are chosen or
/// none is left.
void fill_up(std::vector<Choice>& choices, const std::vector<explore::Evaluated>& candidates,
             std::span<const pattern::Pattern> measured, int count) {
  std::vector<int> difference;
  difference.reserve(candidates.size());
  for (const explore::Evaluated& candidate : candidates)
    difference.push_back(smallest_difference(candidate.pattern, measured));
  const auto account_for = [&](std::size_t chosen) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      difference[i] =
          std::min(difference[i], pattern::pixel_difference(candidates[i].pattern, candidates[chosen].pattern));
    }
  };
  for (const Choice& choice : choices) account_for(choice.candidate);
  const auto wanted = std::min(static_cast<std::size_t>(count), candidates.size());
  while (choices.size() < wanted) {
    // What is chosen already differs from itself by nothing, so it is never the best: patterns are distinct.
    const auto farthest = std::max_element(difference.begin(), difference.end());
    choices.push_back({static_cast<std::size_t>(farthest - difference.begin()), -1});
    account_for(choices.back().candidate);
  }
}

std::string empty_bins_clause(const std::vector<Choice>& choices, int count) {
  std::vector<int> empty;
  for (int bin = 0; bin < count; ++bin) {
    if (std::none_of(choices.begin(), choices.end(), [&](const Choice& choice) { return choice.bin == bin; })) {
      empty.push_back(bin + 1);
    }
  }
  return fmt::format("{} {} of {} {} no candidate, so this one fills up", empty.size() == 1 ? "bin" : "bins",
                     fmt::join(empty, ", "), count, empty.size() == 1 ? "holds" : "hold");
}

std::string difference_clause(const pattern::Pattern& pattern, std::span<const pattern::Pattern> measured,
                              std::span<const pattern::Pattern> other_choices) {
  const bool alone = other_choices.empty();
  const int from_choices = alone ? 0 : smallest_difference(pattern, other_choices);
  if (measured.empty()) {
    constexpr const char* kNothing = "nothing is measured yet";
    return alone ? kNothing
                 : fmt::format("{}; differs by {} pixels or more from the other choices", kNothing, from_choices);
  }
  const std::string clause =
      fmt::format("differs by {} pixels or more from everything measured", smallest_difference(pattern, measured));
  return alone ? clause : fmt::format("{}, by {} or more from the other choices", clause, from_choices);
}

void erase_patterns(std::vector<explore::Evaluated>& samples, const std::vector<pattern::Pattern>& patterns) {
  const std::set<pattern::Pattern> gone(patterns.begin(), patterns.end());
  std::erase_if(samples, [&](const explore::Evaluated& sample) { return gone.contains(sample.pattern); });
}

}  // namespace

std::vector<Selected> select_designs(std::span<const explore::Evaluated> gamut,
                                     std::span<const pattern::Pattern> measured,
                                     std::span<const optimize::Performance> benchmark,
                                     const SelectionSettings& settings) {
  check_settings(settings);
  const std::vector<explore::Evaluated> pool = candidates(gamut, measured, benchmark, settings.maximum_rank);
  if (pool.empty()) return {};
  std::vector<Choice> choices = choose_from_bins(pool, measured, settings);
  fill_up(choices, pool, measured, settings.count);

  const std::string empty_bins = empty_bins_clause(choices, settings.count);
  std::vector<Selected> selected;
  for (const Choice& choice : choices) {
    const auto& [pattern, performance] = pool[choice.candidate];
    std::vector<pattern::Pattern> others;
    for (const Choice& other : choices) {
      if (other.candidate != choice.candidate) others.push_back(pool[other.candidate].pattern);
    }
    const std::string place =
        choice.bin >= 0 ? fmt::format("bin {} of {}", choice.bin + 1, settings.count) : empty_bins;
    selected.push_back(
        {pattern, performance,
         fmt::format("{} (toughness {:.3g} MPa, modulus {:.3g} GPa): {}", place, performance.toughness_pa / 1e6,
                     performance.modulus_pa / 1e9, difference_clause(pattern, measured, others)),
         choice.bin});
  }
  return selected;
}

std::vector<Selected> select_with_reserve(std::vector<explore::Evaluated> gamut, std::vector<pattern::Pattern> measured,
                                          std::span<const optimize::Performance> benchmark, int count) {
  erase_patterns(gamut, measured);
  std::vector<Selected> chosen = select_designs(gamut, measured, benchmark, {.count = count});
  const int missing = count - static_cast<int>(chosen.size());
  if (missing <= 0 || benchmark.empty()) return chosen;
  for (const Selected& each : chosen) measured.push_back(each.pattern);
  for (Selected& each : select_designs(gamut, measured, {}, {.count = missing})) {
    each.reason.insert(0, "below the homogeneous line, where too few samples lie above it: ");
    chosen.push_back(std::move(each));
  }
  return chosen;
}

}  // namespace nacre::select
