#pragma once
// What runs of the study wrote down of their growth.

#include <map>
#include <string>
#include <vector>

#include "commands.hpp"

namespace nacre::search_study {

/// One row of a growth table.
struct Step {
  double hypervolume_gpa_mpa = 0.0;  ///< staircase
  double thinking_s = 0.0, simulating_s = 0.0;
};

/// By samples, ascending.
using Growth = std::map<int, Step>;

/// Growths of all of the options' seeds of a variant that have run. Throws InputError with file and line for a faulty
/// table.
std::vector<Growth> growths_of(const Options& options, const std::string& variant);

/// Hypervolume with the first `samples` samples; 0 where none was told yet.
double hypervolume_at(const Growth& growth, int samples);

}  // namespace nacre::search_study
