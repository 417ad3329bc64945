#include "select/select.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

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

/// "1", "1 and 2", "1, 2 and 3".
std::string list_in_words(const std::vector<int>& numbers) {
  std::string words = std::to_string(numbers.front());
  for (std::size_t i = 1; i < numbers.size(); ++i)
    words += (i + 1 < numbers.size() ? ", " : " and ") + std::to_string(numbers[i]);
  return words;
}

/// Where along the front a bin lies: they run from the least stiff candidates to the stiffest.
std::string part_in_words(int bin, int count) {
  if (count == 1) return "";
  const bool first = bin == 0, last = bin + 1 == count;
  if (count == 2) return first ? ", in the least stiff half" : ", in the stiffest half";
  if (first || last)
    return fmt::format(", in the {} of {} parts of the front", first ? "least stiff" : "stiffest", count);
  return fmt::format(", in part {} of {} of the front (part 1 is the least stiff)", bin + 1, count);
}

/// Why a design fills up, as a clause: which parts of the front hold no candidate.
std::string empty_parts_in_words(const std::vector<Choice>& choices, int count) {
  std::vector<int> empty;
  for (int bin = 0; bin < count; ++bin) {
    if (std::none_of(choices.begin(), choices.end(), [&](const Choice& choice) { return choice.bin == bin; })) {
      empty.push_back(bin + 1);
    }
  }
  if (empty.empty()) return "";
  return fmt::format(", taken because {} {} of {} of the front {} no candidate", empty.size() == 1 ? "part" : "parts",
                     list_in_words(empty), count, empty.size() == 1 ? "holds" : "hold");
}

/// How a design differs from what is known, as a clause.
std::string difference_in_words(const pattern::Pattern& pattern, std::span<const pattern::Pattern> measured,
                                std::span<const pattern::Pattern> other_proposals) {
  constexpr int kUnlike = pattern::kPixels / 10;  // from here on "unlike", below it "close to"
  const int from_measured = smallest_difference(pattern, measured),
            from_others = smallest_difference(pattern, other_proposals);
  if (measured.empty() && other_proposals.empty()) return "nothing is measured yet";
  if (measured.empty())
    return fmt::format("nothing is measured yet ({} of {} pixels differ from the other proposals)", from_others,
                       pattern::kPixels);
  return fmt::format("{} ({} of {} pixels differ{})",
                     from_measured >= kUnlike ? "unlike anything measured so far" : "close to a measured design",
                     from_measured, pattern::kPixels,
                     other_proposals.empty() ? "" : fmt::format(", {} from the other proposals", from_others));
}

void erase_patterns(std::vector<explore::Evaluated>& samples, const std::vector<pattern::Pattern>& patterns) {
  const std::set<pattern::Pattern> gone(patterns.begin(), patterns.end());
  std::erase_if(samples, [&](const explore::Evaluated& sample) { return gone.contains(sample.pattern); });
}

/// select_designs() that stays away from what is chosen already, too.
std::vector<Selected> select_apart(std::span<const explore::Evaluated> gamut,
                                   std::span<const pattern::Pattern> measured,
                                   std::span<const pattern::Pattern> chosen_before,
                                   std::span<const optimize::Performance> benchmark,
                                   const SelectionSettings& settings) {
  check_settings(settings);
  std::vector<pattern::Pattern> known(measured.begin(), measured.end());
  known.insert(known.end(), chosen_before.begin(), chosen_before.end());
  const std::vector<explore::Evaluated> pool = candidates(gamut, known, benchmark, settings.maximum_rank);
  if (pool.empty()) return {};
  std::vector<Choice> choices = choose_from_bins(pool, known, settings);
  fill_up(choices, pool, known, settings.count);

  const std::string empty_parts = empty_parts_in_words(choices, settings.count);
  std::vector<Selected> selected;
  for (const Choice& choice : choices) {
    const pattern::Pattern& pattern = pool[choice.candidate].pattern;
    std::vector<pattern::Pattern> others(chosen_before.begin(), chosen_before.end());
    for (const Choice& other : choices) {
      if (other.candidate != choice.candidate) others.push_back(pool[other.candidate].pattern);
    }
    const std::string place = choice.bin >= 0 ? part_in_words(choice.bin, settings.count) : empty_parts;
    selected.push_back({pattern, pool[choice.candidate].performance,
                        fmt::format("near the best predicted toughness for its stiffness{}; {}", place,
                                    difference_in_words(pattern, measured, others)),
                        choice.bin});
  }
  return selected;
}

}  // namespace

std::vector<Selected> select_designs(std::span<const explore::Evaluated> gamut,
                                     std::span<const pattern::Pattern> measured,
                                     std::span<const optimize::Performance> benchmark,
                                     const SelectionSettings& settings) {
  return select_apart(gamut, measured, {}, benchmark, settings);
}

std::vector<Selected> select_with_reserve(std::vector<explore::Evaluated> gamut, std::vector<pattern::Pattern> measured,
                                          std::span<const optimize::Performance> benchmark, int count) {
  erase_patterns(gamut, measured);
  std::vector<Selected> chosen = select_designs(gamut, measured, benchmark, {.count = count});
  const int missing = count - static_cast<int>(chosen.size());
  if (missing <= 0 || benchmark.empty()) return chosen;
  std::vector<pattern::Pattern> chosen_before;
  for (const Selected& each : chosen) chosen_before.push_back(each.pattern);
  for (Selected& each : select_apart(gamut, measured, chosen_before, {}, {.count = missing})) {
    each.reason += "; warning: a plain mixture is as stiff and as tough as predicted here";
    chosen.push_back(std::move(each));
  }
  return chosen;
}

}  // namespace nacre::select
