#include "select/beam.hpp"

#include <algorithm>
#include <cassert>

namespace nacre::select {
namespace {

/// A selection from the first bins: what was chosen, and each one's smallest difference so far.
struct Partial {
  std::vector<std::size_t> choices;
  std::vector<pattern::Pattern> patterns;
  std::vector<int> differences;
};

/// A partial selection with one more member, not built yet: most are thrown away.
struct Extension {
  int score = 0;
  std::size_t partial = 0;
  std::size_t candidate = 0;
  bool better_than(const Extension& other) const {
    if (score != other.score) return score > other.score;
    return partial != other.partial ? partial < other.partial : candidate < other.candidate;
  }
};

/// Gives `take` the smallest difference of every member once `newcomer` has joined, the newcomer's own last.
template <class Take>
void each_difference(const Partial& partial, const pattern::Pattern& newcomer, int difference_to_measured, Take take) {
  int own = difference_to_measured;
  for (std::size_t i = 0; i < partial.patterns.size(); ++i) {
    const int between = pattern::pixel_difference(partial.patterns[i], newcomer);
    own = std::min(own, between);
    take(std::min(partial.differences[i], between));
  }
  take(own);
}

/// Objective of Eq. 2.14 for the longer selection, without its factor 1/M.
int score_with(const Partial& partial, const pattern::Pattern& newcomer, int difference_to_measured) {
  int score = 0;
  each_difference(partial, newcomer, difference_to_measured, [&](int difference) { score += difference; });
  return score;
}

Partial extended(const Partial& partial, const pattern::Pattern& newcomer, std::size_t choice,
                 int difference_to_measured) {
  Partial longer{partial.choices, partial.patterns, {}};
  longer.choices.push_back(choice);
  longer.patterns.push_back(newcomer);
  each_difference(partial, newcomer, difference_to_measured,
                  [&](int difference) { longer.differences.push_back(difference); });
  return longer;
}

/// The best `width` extensions of all partial selections by all candidates, best first. A heap holds the worst of the
/// best on top, so that memory stays at `width` whatever the number of candidates.
std::vector<Extension> best_extensions(const std::vector<Partial>& beam, const std::vector<pattern::Pattern>& bin,
                                       const std::vector<int>& to_measured, std::size_t width) {
  const auto better = [](const Extension& a, const Extension& b) { return a.better_than(b); };
  std::vector<Extension> heap;
  for (std::size_t p = 0; p < beam.size(); ++p) {
    for (std::size_t c = 0; c < bin.size(); ++c) {
      const Extension extension{score_with(beam[p], bin[c], to_measured[c]), p, c};
      if (heap.size() == width) {
        if (!extension.better_than(heap.front())) continue;
        std::pop_heap(heap.begin(), heap.end(), better);
        heap.pop_back();
      }
      heap.push_back(extension);
      std::push_heap(heap.begin(), heap.end(), better);
    }
  }
  std::sort_heap(heap.begin(), heap.end(), better);
  return heap;
}

}  // namespace

int smallest_difference(const pattern::Pattern& pattern, std::span<const pattern::Pattern> others) {
  int smallest = pattern::kPixels;
  for (const pattern::Pattern& other : others) smallest = std::min(smallest, pattern::pixel_difference(pattern, other));
  return smallest;
}

std::vector<std::size_t> beam_search(std::span<const std::vector<pattern::Pattern>> bins,
                                     std::span<const pattern::Pattern> measured, int width) {
  assert(width >= 1);
  std::vector<Partial> beam(1);
  for (const std::vector<pattern::Pattern>& bin : bins) {
    assert(!bin.empty());
    std::vector<int> to_measured;
    to_measured.reserve(bin.size());
    for (const pattern::Pattern& pattern : bin) to_measured.push_back(smallest_difference(pattern, measured));
    std::vector<Partial> next;
    for (const Extension& best : best_extensions(beam, bin, to_measured, width)) {
      next.push_back(extended(beam[best.partial], bin[best.candidate], best.candidate, to_measured[best.candidate]));
    }
    beam = std::move(next);
  }
  return beam.front().choices;
}

}  // namespace nacre::select
