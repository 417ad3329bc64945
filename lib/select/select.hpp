#pragma once
// Which samples of a gamut are worth a measurement (thesis 2.3.4).

#include <span>
#include <string>
#include <vector>

#include "explore/search.hpp"
#include "thesis/constants.hpp"

namespace nacre::select {

struct SelectionSettings {
  int count = 8;  ///< M of 2.3.4
  int beam_width = thesis::kBeamSize;
  int maximum_rank = thesis::kBoundaryRanks;
};

struct Selected {
  pattern::Pattern pattern;
  optimize::Performance predicted;
  std::string reason;  ///< in plain words
  int bin = -1;        ///< radial bin 0..M-1, -1 when taken to fill up
};

/// Two-stage selection: rank <= 3 and above the benchmark lines l1 (measured homogeneous line, may be empty) and l2,
/// then radial bins (Eq. 2.13 as corrected) and a beam search for Eq. 2.14 against `measured`. Fewer than count come
/// back when the gamut has fewer candidates; empty bins are filled from the remaining candidates and the reason says
/// so. The reason is a sentence for people: where on the front a design lies and how it differs from what is known.
std::vector<Selected> select_designs(std::span<const explore::Evaluated> gamut,
                                     std::span<const pattern::Pattern> measured,
                                     std::span<const optimize::Performance> benchmark,
                                     const SelectionSettings& settings);

/// select_designs() among the samples that are not among `measured`; where too few of the first ranks lie above the
/// homogeneous line, the rest of the choice is made below it, and the reason warns that a plain mixture is as good: a
/// model that sees nothing better must be measured, too.
std::vector<Selected> select_with_reserve(std::vector<explore::Evaluated> gamut, std::vector<pattern::Pattern> measured,
                                          std::span<const optimize::Performance> benchmark, int count);

}  // namespace nacre::select
