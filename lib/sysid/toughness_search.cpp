#include "sysid/toughness_search.hpp"

#include <algorithm>
#include <string>

namespace nacre::sysid {
namespace {

struct NamedSearch {
  ToughnessSearch search;
  std::string_view name;
  bool draws;
};
constexpr NamedSearch kNames[] = {{ToughnessSearch::posterior, "posterior", true},
                                  {ToughnessSearch::emulator, "emulator", false},
                                  {ToughnessSearch::gauss_newton, "gauss_newton", false},
                                  {ToughnessSearch::bayesian, "bayesian", true},
                                  {ToughnessSearch::trust_region, "trust_region", false},
                                  {ToughnessSearch::random, "random", true},
                                  {ToughnessSearch::direct_l, "direct_l", false},
                                  {ToughnessSearch::crs2, "crs2", true},
                                  {ToughnessSearch::cma_es, "cma_es", true}};

}  // namespace

std::string_view to_string(ToughnessSearch search) {
  for (const NamedSearch& entry : kNames) {
    if (entry.search == search) return entry.name;
  }
  return "unknown";
}

bool draws(ToughnessSearch search) {
  return std::ranges::any_of(kNames, [&](const NamedSearch& entry) { return entry.search == search && entry.draws; });
}

Result<ToughnessSearch> toughness_search_from_string(std::string_view name) {
  std::string expected;
  for (const NamedSearch& entry : kNames) {
    if (entry.name == name) return entry.search;
    expected += (expected.empty() ? "" : ", ") + std::string(entry.name);
  }
  return fail("\"{}\" is no search, expected one of {}", name, expected);
}

}  // namespace nacre::sysid
