#pragma once
// Gamuts as bytes, and their best patterns.

#include <string>

#include "run/run_record.hpp"

namespace nacre::dashboard {

/// A gamut as bytes that a browser reads without parsing (docs/FORMATS.md, "Dashboard"): a header with the indices of
/// the front, then patterns (uint64), moduli and toughnesses (float32), little-endian. 100,000 patterns are 1.6 MB.
std::string gamut_bytes(const run::Gamut& gamut, int round);

/// The `most` best patterns by non-dominated rank, within the last rank by crowding distance; in the order of the
/// gamut.
std::vector<std::size_t> best_of(const run::Gamut& gamut, std::size_t most);

}  // namespace nacre::dashboard
