#include "explore/islands.hpp"

#include <cstddef>

#include "explore/surrogate_search.hpp"

namespace nacre::explore {
namespace {

double hypervolume_of(std::span<const Evaluated> samples) {
  return optimize::hypervolume_staircase_gpa_mpa(performances_of(samples));
}

bool stand_still(std::span<const Evaluated> samples, std::size_t patience) {
  constexpr double kGrowth = 0.01;
  return hypervolume_of(samples) < (1.0 + kGrowth) * hypervolume_of(samples.first(samples.size() - patience));
}

}  // namespace

std::span<const Evaluated> samples_to_go_by(std::span<const Evaluated> evaluated, int patience, int batch) {
  if (patience == 0) return evaluated;
  const auto least = static_cast<std::size_t>(patience), step = static_cast<std::size_t>(batch);
  std::size_t begin = 0;
  bool on_island = true;
  for (std::size_t end = step; end <= evaluated.size(); end += step) {
    if (end - begin < (on_island ? 2 * least : least)) continue;
    if (!stand_still(on_island ? evaluated.subspan(begin, end - begin) : evaluated.first(end), least)) continue;
    const bool is_alone = begin == 0;  // the first island: there is nothing to join it to
    on_island = !on_island || is_alone;
    begin = end;
  }
  return on_island ? evaluated.subspan(begin) : evaluated;
}

}  // namespace nacre::explore
