#pragma once
// Commands of the calibration study and their options.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace nacre::calibration_study {

struct Options {
  std::string fidelity = "preview", begin_at;
  int first_seed = 1, seeds = 5;
  int fitted = 18, predicted = 40;
  std::string criterion = "crack_band";
  bool next_round = false;
  std::vector<std::string> searches = {"posterior"};
  int budget = 25, ensemble = 8;
  std::string out = "logs/calibration-study", work = "logs/calibration-study";
  double minutes = 9.0;
  std::vector<std::string> effects;
};

/// Thrown between two simulations when `minutes` are over.
struct TimeIsUp : std::runtime_error {
  TimeIsUp() : std::runtime_error("time is up") {}
};

void study_base_materials(const Options& options);
void measure_laboratories(const Options& options);
void study_held_out(const Options& options);
void run_thesis_schedule(const Options& options);

}  // namespace nacre::calibration_study
