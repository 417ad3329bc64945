#include "designs.hpp"

#include <algorithm>
#include <sstream>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::calibration_study {
namespace {

constexpr int kRandomFitted = 10;  // of round 1 (thesis Table 3.2)

std::vector<pattern::Design> front_like() {
  std::istringstream lines(read_file(NACRE_STUDY_DIR "/front_like.txt"));
  std::vector<pattern::Design> patterns;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('#')) patterns.push_back(pattern::design_from_name(line).value());
  }
  return patterns;
}

template <class T>
void shuffle(std::vector<T>& items, RandomStream& random) {
  for (std::size_t i = items.size(); i > 1; --i) {
    std::swap(items[i - 1], items[random.index(static_cast<int>(i))]);
  }
}

}  // namespace

StudyDesigns draw_designs(std::uint64_t seed, int fitted, int held_out) {
  RandomStream front_order(seed, "study/front"), random(seed, "study/random");
  std::vector<pattern::Design> front = front_like();
  shuffle(front, front_order);
  const std::vector<pattern::Pattern> drawn = pattern::stratified_patterns(kRandomFitted + held_out / 2, random);
  StudyDesigns designs;
  auto from_random = drawn.begin();
  auto from_front = front.begin();
  for (int k = 0; k < held_out; ++k)
    designs.held_out.push_back(k % 2 == 0 ? pattern::Design(*from_random++) : *from_front++);
  for (int k = 0; k < fitted; ++k) {
    if (k < kRandomFitted) {
      designs.fitted.emplace_back(*from_random++);
    } else if (from_front != front.end()) {
      designs.fitted.emplace_back(*from_front++);
    } else {
      throw InputError::format("{} fitted and {} held-out designs, expected at most 42 and 40", fitted, held_out);
    }
  }
  return designs;
}

}  // namespace nacre::calibration_study
