#pragma once
// The commands of the search study (docs/studies/search.md).

#include <cstdint>
#include <string>
#include <vector>

#include "explore/search.hpp"

namespace nacre::search_study {

struct Options {
  std::string work = "logs/search-study";  ///< evaluations, batches and growth of every run
  std::string fidelity = "tiny";
  std::string params;                            ///< parameter file; empty: the built-in parameters
  std::string set = "default";                   ///< name of the parameter set in file names
  std::string variant;                           ///< name of the run; the algorithm's when empty
  std::string reference = "nsga2-single-pixel";  ///< variant whose final hypervolume is to be reached
  std::string known;                             ///< gamut.csv of the same parameters to start from; empty: none
  std::string former;                            ///< gamut.csv that `learned` learns from too; empty: none
  explore::SearchSettings search;
  bool believed_modulus = false;  ///< `learned` is not told the modulus of its finalists
  std::string cells = "both";     ///< what predictors know of unit cells: both, modulus, loads, none
  std::uint64_t first_seed = 1;
  int seeds = 1;
  double minutes = 1e6;
  int threads = 0;
  std::vector<int> checkpoints = {100, 200, 300, 500, 800};               ///< samples learnt from, or tests done
  int next = 100;                                                         ///< held out: samples predicted
  int again = 8;                                                          ///< expected: specimens of a front's designs
  std::vector<std::string> variants = {"learned", "nsga2-single-pixel"};  ///< growth: curves of the figure
  int most = 5000;                                                        ///< growth: samples, the end of the figure
  std::string out;                                                        ///< of a figure
};

/// Searches, seed after seed. Returns whether all came to their end before the minutes were over.
bool run_searches(const Options& options);
/// Learns from the first samples of finished runs and predicts those asked for next.
void predict_held_out(const Options& options);
/// What the fronts that runs report after so many fracture tests are worth: every design of them is tested again with
/// `again` specimens of its own. One line for each checkpoint.
void expect_fronts(const Options& options);
/// Samples until the reference's final hypervolume, final hypervolumes, times: one line per variant.
void summarise(const Options& options);

/// Hypervolume against samples, mean and range over the seeds, as a picture (Figures 3-9 and 3-10 of the thesis).
void draw_growth(const Options& options);
/// E and T predicted against simulated, on the samples of one run that were learnt from and on those asked for next, as
/// two pictures, OUT-modulus.svg and OUT-toughness.svg (Figure 3-11 of the thesis).
void draw_predicted(const Options& options);

/// "tiny-default-nsga2-1" in the work folder, for a run's files.
std::string run_path(const Options& options, const std::string& variant, std::uint64_t seed);

}  // namespace nacre::search_study
