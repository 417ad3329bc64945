#include "tester/loading.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nacre::tester {
namespace {

constexpr std::string_view kMonotonic = "monotonic", kStrains = "strain", kHold = "hold", kUnload = "unload",
                           kDwell = "dwell";
constexpr std::size_t kMostTurns = 20;
constexpr double kLargestStrain = 2.0, kLongestPauseS = 1e7;

/// Reads the words of a programme one after another.
class LoadingReader {
 public:
  explicit LoadingReader(std::string_view text) : words_{std::string(text)} {}

  std::optional<Loading> read() {
    std::string word;
    if (!(words_ >> word) || word != kStrains) return std::nullopt;
    while (words_ >> word)
      if (loading_.dwell_s ? !take_dwell(word) : !take(word)) return std::nullopt;
    if (loading_.turns.empty()) return std::nullopt;
    return loading_;
  }

 private:
  static std::optional<double> number_in(const std::string& word, double most) {
    std::istringstream number(word);
    double value = 0.0;
    if (!(number >> value && number.eof() && value >= 0.0 && value <= most)) return std::nullopt;
    return value;
  }

  std::optional<double> next_pause() {
    std::string word;
    if (!(words_ >> word)) return std::nullopt;
    const auto pause_s = number_in(word, kLongestPauseS);
    return pause_s && *pause_s > 0.0 ? pause_s : std::nullopt;
  }

  bool take(const std::string& word) {
    std::vector<double>& turns = loading_.turns;
    const double last = turns.empty() ? 0.0 : turns.back();
    if (word == kHold) {
      const auto pause_s = next_pause();
      if (turns.empty() || !pause_s) return false;
      loading_.holds_s.resize(turns.size(), 0.0);
      if (loading_.holds_s.back() > 0.0) return false;
      loading_.holds_s.back() = *pause_s;
      return true;
    }
    if (word == kUnload) {
      loading_.dwell_s = 0.0;
      return last > 0.0;
    }
    const auto strain = number_in(word, kLargestStrain);
    if (!strain || *strain == last || turns.size() == kMostTurns) return false;
    turns.push_back(*strain);
    if (!loading_.holds_s.empty()) loading_.holds_s.push_back(0.0);
    return true;
  }

  bool take_dwell(const std::string& word) {
    if (word != kDwell || *loading_.dwell_s > 0.0) return false;
    loading_.dwell_s = next_pause();
    return loading_.dwell_s.has_value();
  }

  std::istringstream words_;
  Loading loading_;
};

}  // namespace

std::string to_string(const Loading& loading) {
  if (loading.turns.empty()) return std::string(kMonotonic);
  std::string text(kStrains);
  for (std::size_t i = 0; i < loading.turns.size(); ++i) {
    text += fmt::format(" {}", loading.turns[i]);
    if (i < loading.holds_s.size() && loading.holds_s[i] > 0.0)
      text += fmt::format(" {} {}", kHold, loading.holds_s[i]);
  }
  if (loading.dwell_s) text += fmt::format(" {}", kUnload);
  if (loading.dwell_s.value_or(0.0) > 0.0) text += fmt::format(" {} {}", kDwell, *loading.dwell_s);
  return text;
}

Result<Loading> loading_from_string(std::string_view text) {
  if (text == kMonotonic) return Loading{};
  if (auto loading = LoadingReader(text).read()) return *std::move(loading);
  return fail(
      "loading \"{}\", expected \"monotonic\", or \"strain\" and 1 to {} strains from 0 to {}, one after another, each "
      "perhaps with \"hold\" and seconds, in the end perhaps \"unload\" (to zero force), \"dwell\" and seconds",
      text, kMostTurns, kLargestStrain);
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
