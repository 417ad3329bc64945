#include "pattern/random_pattern.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

#include "pattern/constraints.hpp"

namespace nacre::pattern {
namespace {

/// The free pixels in random order (Fisher-Yates).
std::array<int, kFreePixels> shuffled_free_pixels(RandomStream& random) {
  std::array<int, kFreePixels> order{};
  std::iota(order.begin(), order.end(), 0);
  for (int i = kFreePixels - 1; i > 0; --i) {
    std::swap(order[i], order[random.index(i + 1)]);
  }
  return order;
}

/// Rows first to last - 1 of the quarter.
struct Gap {
  int first = 0, last = 0;
};

/// The gaps between random bars: runs of rows without a bar.
std::vector<Gap> gaps_between_bars(RandomStream& random) {
  constexpr int kFewest = 2, kMost = 6;  // not counting the outer row; more than six leave too little soft
  std::array<bool, kQuarter> is_bar{true};
  for (int left = kFewest + random.index(kMost - kFewest + 1); left > 0;) {
    bool& row = is_bar[1 + random.index(kQuarter - 1)];
    left -= row ? 0 : 1;
    row = true;
  }
  std::vector<Gap> gaps;
  for (int row = 1; row < kQuarter; ++row) {
    if (is_bar[row]) continue;
    if (gaps.empty() || gaps.back().last != row) gaps.push_back({row, row});
    gaps.back().last = row + 1;
  }
  return gaps;
}

void soften(Pattern& pattern, const Gap& rows, const Gap& columns) {
  for (int row = rows.first; row < rows.last; ++row)
    for (int column = columns.first; column < columns.last; ++column) pattern.set(row, column, false);
}

constexpr std::uint64_t bit(int free_pixel) { return std::uint64_t{1} << free_pixel; }

}  // namespace

Pattern random_pattern(int rigid_percent, RandomStream& random) {
  assert(rigid_percent >= 50 && rigid_percent <= 85);
  const int wanted = rigid_percent * kPixels / 100;
  const std::uint64_t required = required_rigid_bits(wanted);
  const auto order = shuffled_free_pixels(random);
  std::uint64_t bits = required;
  int missing = wanted - Pattern(bits).rigid_count();
  for (const int free_pixel : order) {
    const int size = Pattern::orbit_size(free_pixel);
    if ((bits & bit(free_pixel)) != 0 || size > missing) continue;
    bits |= bit(free_pixel);
    missing -= size;
  }
  if (missing > 0) {
    // Only 4 can be missing, with the whole diagonal rigid: a diagonal pixel gives way to one with 8 images.
    const auto diagonal = std::find_if(order.begin(), order.end(), [&](int free_pixel) {
      return Pattern::orbit_size(free_pixel) == 4 && (required & bit(free_pixel)) == 0;
    });
    const auto soft =
        std::find_if(order.begin(), order.end(), [&](int free_pixel) { return (bits & bit(free_pixel)) == 0; });
    bits ^= bit(*diagonal) | bit(*soft);
  }
  const Pattern pattern(bits);
  assert(pattern.rigid_count() == wanted && is_feasible(pattern));
  return pattern;
}

Pattern random_pattern(RandomStream& random) {
  const int lowest = kStrata[0].minimum_percent, highest = std::rbegin(kStrata)->maximum_percent;
  return random_pattern(lowest + random.index(highest - lowest + 1), random);
}

Pattern random_barred_pattern(RandomStream& random) {
  constexpr double kLeastSoft = 0.2, kMostSoft = 0.9;
  while (true) {
    const std::vector<Gap> gaps = gaps_between_bars(random);
    const double soft = kLeastSoft + (kMostSoft - kLeastSoft) * random.uniform();
    Pattern pattern(kAllFreePixels);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      for (std::size_t j = i; j < gaps.size(); ++j)
        if (random.uniform() < soft) soften(pattern, gaps[i], gaps[j]);
    }
    if (is_feasible(pattern)) return pattern;
  }
}

std::vector<Pattern> stratified_patterns(int count, RandomStream& random) {
  std::vector<Pattern> patterns;
  while (static_cast<int>(patterns.size()) < count) {
    const Stratum& stratum = kStrata[patterns.size() % std::size(kStrata)];
    const int percents = stratum.maximum_percent - stratum.minimum_percent + 1;
    const Pattern pattern = random_pattern(stratum.minimum_percent + random.index(percents), random);
    if (std::find(patterns.begin(), patterns.end(), pattern) == patterns.end()) patterns.push_back(pattern);
  }
  return patterns;
}

}  // namespace nacre::pattern
