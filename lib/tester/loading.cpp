#include "tester/loading.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nacre::tester {
namespace {

constexpr std::string_view kMonotonic = "monotonic", kStrains = "strain";
constexpr std::size_t kMostTurns = 20;
constexpr double kLargestStrain = 2.0;

}  // namespace

std::string to_string(const Loading& loading) {
  if (loading.turns.empty()) return std::string(kMonotonic);
  return fmt::format("{} {}", kStrains, fmt::join(loading.turns, " "));
}

Result<Loading> loading_from_string(std::string_view text) {
  if (text == kMonotonic) return Loading{};
  std::istringstream words{std::string(text)};
  std::string first, word;
  Loading loading;
  bool sound = static_cast<bool>(words >> first) && first == kStrains;
  for (double before = 0.0; sound && words >> word;) {
    std::istringstream number(word);
    double strain = 0.0;
    sound = static_cast<bool>(number >> strain) && number.eof() && strain >= 0.0 && strain <= kLargestStrain &&
            strain != before && loading.turns.size() < kMostTurns;
    loading.turns.push_back(before = strain);
  }
  if (sound && !loading.turns.empty()) return loading;
  return fail(
      "loading \"{}\", expected \"monotonic\", or \"strain\" and 1 to {} strains from 0 to {}, one after another", text,
      kMostTurns, kLargestStrain);
}

std::vector<double> strain_path(const Loading& loading, double step) {
  std::vector<double> strains = {0.0};
  for (const double turn : loading.turns) {
    const double from = strains.back();
    const int steps = std::max(1, static_cast<int>(std::lround(std::abs(turn - from) / step)));
    for (int i = 1; i < steps; ++i) strains.push_back(from + (turn - from) * i / steps);
    strains.push_back(turn);
  }
  return strains;
}

}  // namespace nacre::tester
