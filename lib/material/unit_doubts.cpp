#include "material/unit_doubts.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace nacre::material {
namespace {

/// A factor that no ink explains, but a unit does.
constexpr double kFarOff = 100.0;

template <class Vector>
void add_doubts(std::vector<std::string>& doubts, const std::string& place, const Vector& values,
                std::span<const ParameterRange> base, std::span<const ParameterRange> microstructures) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double minimum = std::min(base[i].minimum, microstructures[i].minimum),
                 maximum = std::max(base[i].maximum, microstructures[i].maximum);
    if (values[i] >= minimum / kFarOff && values[i] <= maximum * kFarOff) continue;
    doubts.push_back(fmt::format("{}.{} = {:g} lies far outside {:g} to {:g}, where it is fitted: is the unit right?",
                                 place, base[i].name, values[i], minimum, maximum));
  }
}

void add_doubts(std::vector<std::string>& doubts, const std::string& place, std::span<const ParameterRange> own,
                std::span<const ParameterRange> usual) {
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i].maximum >= usual[i].minimum / kFarOff && own[i].minimum <= usual[i].maximum * kFarOff) continue;
    doubts.push_back(
        fmt::format("{}.{} from {:g} to {:g} lies far outside the thesis' {:g} to {:g}: is the unit right?", place,
                    own[i].name, own[i].minimum, own[i].maximum, usual[i].minimum, usual[i].maximum));
  }
}

}  // namespace

std::vector<std::string> unit_doubts(const std::string& file, const ParameterSet& set, const ParameterRanges& ranges) {
  std::vector<std::string> doubts;
  add_doubts(doubts, file + ": modulus", to_vector(set.modulus), ranges.modulus(FitTarget::base),
             ranges.modulus(FitTarget::microstructures));
  add_doubts(doubts, file + ": toughness", to_vector(set.toughness), ranges.toughness(FitTarget::base),
             ranges.toughness(FitTarget::microstructures));
  return doubts;
}

std::vector<std::string> unit_doubts(const std::string& file, const ParameterRanges& ranges) {
  std::vector<std::string> doubts;
  for (const FitTarget target : {FitTarget::base, FitTarget::microstructures}) {
    add_doubts(doubts, file + ": modulus", ranges.modulus(target), thesis_ranges().modulus(target));
    add_doubts(doubts, file + ": toughness", ranges.toughness(target), thesis_ranges().toughness(target));
  }
  return doubts;
}

}  // namespace nacre::material
