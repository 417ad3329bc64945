#pragma once
// The searches for eta that a calibration can use (docs/studies/calibration compares them at equal numbers of
// simulations).

#include <string_view>

#include "base/result.hpp"

namespace nacre::sysid {

enum class ToughnessSearch {
  posterior,     ///< most probable parameters by an emulator of features that averages over the testers' jumps
  emulator,      ///< smallest objective (2.8) by the same emulator, which trusts the best evaluation
  gauss_newton,  ///< least squares of the features, slopes by finite differences
  bayesian,      ///< batch Bayesian optimisation of the objective, as the thesis does
  trust_region,  ///< NLopt's BOBYQA and Nelder-Mead on the objective
  random,
  direct_l,
  crs2,
  cma_es,
};

std::string_view to_string(ToughnessSearch search);
/// Whether the seed decides where a search goes: repetitions of one that does not depend on it are all the same.
bool draws(ToughnessSearch search);
Result<ToughnessSearch> toughness_search_from_string(std::string_view name);

}  // namespace nacre::sysid
