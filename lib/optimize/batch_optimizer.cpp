#include "optimize/batch_optimizer.hpp"

#include <nlopt.hpp>

#include "optimize/nlopt_optimizer.hpp"
#include "optimize/recorded_optimizer.hpp"
#include "optimize/rivals/bayesian_optimizer.hpp"
#include "optimize/rivals/cma_es.hpp"
#include "optimize/rivals/random_search.hpp"
#include "optimize/rivals/replayed_search.hpp"

namespace nacre::optimize {
namespace {

struct NamedAlgorithm {
  Algorithm algorithm;
  std::string_view name;
};
constexpr NamedAlgorithm kNames[] = {{Algorithm::bayesian, "bayesian"}, {Algorithm::trust_region, "trust_region"},
                                     {Algorithm::random, "random"},     {Algorithm::direct_l, "direct_l"},
                                     {Algorithm::crs2, "crs2"},         {Algorithm::cma_es, "cma_es"}};

}  // namespace

std::string_view to_string(Algorithm algorithm) {
  for (const NamedAlgorithm& entry : kNames) {
    if (entry.algorithm == algorithm) return entry.name;
  }
  return "unknown";
}

Result<Algorithm> algorithm_from_string(std::string_view name) {
  for (const NamedAlgorithm& entry : kNames) {
    if (entry.name == name) return entry.algorithm;
  }
  return fail("\"{}\" is no algorithm, expected bayesian, trust_region, random, direct_l, crs2 or cma_es", name);
}

void BatchOptimizer::resume(const std::vector<Evaluation>& told) {
  for (std::size_t done = 0; done < told.size();) {
    const std::vector<Point> points = ask();
    std::vector<std::optional<double>> values;
    for (const Point& point : points) {
      if (done == told.size() || told[done].point != point) throw another_search(done);
      values.push_back(told[done++].value);
    }
    if (points.empty())
      throw InputError::format("optimiser: {} evaluations, but these settings end after {}", told.size(), done);
    tell(values);
  }
}

std::unique_ptr<BatchOptimizer> make_optimizer(Algorithm algorithm, const BatchOptimizerSettings& settings) {
  switch (algorithm) {
    case Algorithm::bayesian:
      return make_bayesian_optimizer(settings);
    case Algorithm::random:
      return make_random_search(settings);
    case Algorithm::direct_l:
      return make_replayed_search(nlopt::GN_DIRECT_L, settings);
    case Algorithm::crs2:
      return make_replayed_search(nlopt::GN_CRS2_LM, settings);
    case Algorithm::cma_es:
      return make_cma_es(settings);
    case Algorithm::trust_region:
      break;
  }
  return make_nlopt_optimizer(settings);
}

}  // namespace nacre::optimize
