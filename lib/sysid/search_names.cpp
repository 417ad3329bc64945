#include "sysid/calibration.hpp"

namespace nacre::sysid {
namespace {

struct NamedSearch {
  ToughnessSearch search;
  std::string_view name;
};
constexpr NamedSearch kNames[] = {{ToughnessSearch::posterior, "posterior"},
                                  {ToughnessSearch::emulator, "emulator"},
                                  {ToughnessSearch::gauss_newton, "gauss_newton"},
                                  {ToughnessSearch::bayesian, "bayesian"},
                                  {ToughnessSearch::trust_region, "trust_region"},
                                  {ToughnessSearch::random, "random"},
                                  {ToughnessSearch::direct_l, "direct_l"},
                                  {ToughnessSearch::crs2, "crs2"},
                                  {ToughnessSearch::cma_es, "cma_es"}};

}  // namespace

std::string_view to_string(ToughnessSearch search) {
  for (const NamedSearch& entry : kNames) {
    if (entry.search == search) return entry.name;
  }
  return "unknown";
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
