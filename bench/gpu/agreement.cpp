#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/statistics.hpp"
#include "batch.hpp"
#include "commands.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::gpu_study {
namespace {

constexpr double kPerturbation = 1e-6;  // relative perturbation of every parameter: far below its uncertainty
constexpr double kSlopeStrain = 0.002;  // up to which a curve's slope is its modulus

/// Random patterns over the strata of Table 3.2, and as many of 76 to 85 % rigid, which searches propose.
std::vector<pattern::Pattern> patterns_of(int count) {
  RandomStream random(1, "gpu agreement");
  std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(count / 2, random);
  for (int i = 0; static_cast<int>(patterns.size()) < count; ++i)
    patterns.push_back(pattern::random_pattern(76 + i % 10, random));
  return patterns;
}

material::ParameterSet moved_parameters(const pattern::Pattern& pattern) {
  material::ParameterSet set = material::default_parameters();
  RandomStream random(pattern.bits(), "gpu agreement, moved");
  set.toughness = material::perturbed(set.toughness, kPerturbation, random);
  return set;
}

double slope_pa(const tester::Curve& curve) {
  double xy = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < curve.size() && curve.strain[i] <= kSlopeStrain; ++i) {
    xy += curve.strain[i] * curve.stress_pa[i];
    xx += curve.strain[i] * curve.strain[i];
  }
  return xy / xx;
}

/// The result of one pattern.
struct PatternAgreement {
  double slope = 0.0;                         ///< relative difference of the initial slopes
  double curve = 0.0;                         ///< up to the first failure
  bool same_first = false;                    ///< the same element fails first
  double log_t = 0.0, log_t_perturbed = 0.0;  ///< against the processor's own
};

PatternAgreement row_of(const tester::ToughnessResult& device, const tester::ToughnessResult& own,
                        const tester::ToughnessResult& moved) {
  PatternAgreement row;
  row.slope = slope_pa(device.curve) / slope_pa(own.curve) - 1.0;
  row.curve = tester::largest_difference(own.curve, device.curve,
                                         own.breaks.empty() ? own.failure_strain : own.breaks.front().strain);
  row.same_first =
      !own.breaks.empty() && !device.breaks.empty() && own.breaks.front().element == device.breaks.front().element;
  row.log_t = std::log(device.toughness_pa / own.toughness_pa);
  row.log_t_perturbed = std::log(moved.toughness_pa / own.toughness_pa);
  return row;
}

void print_summary(const std::vector<PatternAgreement>& rows) {
  const auto column = [&](auto value) {
    std::vector<double> values;
    for (const PatternAgreement& row : rows) values.push_back(value(row));
    return values;
  };
  const auto largest = [&](auto value) {
    double most = 0.0;
    for (const double each : column(value)) most = std::max(most, std::abs(each));
    return most;
  };
  const auto same = std::count_if(rows.begin(), rows.end(), [](const PatternAgreement& row) { return row.same_first; });
  fmt::print(
      "{} patterns: initial slopes within {:.2g}, curves up to the first failure within {:.2g}, {} begin at the same "
      "element\n",
      rows.size(), largest([](const PatternAgreement& r) { return r.slope; }),
      largest([](const PatternAgreement& r) { return r.curve; }), same);
  for (const auto& [name, value] : {std::pair{"device", &PatternAgreement::log_t},
                                    std::pair{"processor, parameters perturbed", &PatternAgreement::log_t_perturbed}}) {
    std::vector<double> sizes;
    for (const double each : column([&](const PatternAgreement& r) { return r.*value; }))
      sizes.push_back(std::abs(each));
    fmt::print("log T, {} against processor: root mean square {:.4f}, median {:.4f}, ninth decile {:.4f}\n", name,
               root_mean_square(sizes), quantile(sizes, 0.5), quantile(sizes, 0.9));
  }
}

}  // namespace

void run_agreement(const Options& options) {
  const auto fidelity = tester::fidelity_from_string(options.fidelity).value();
  const std::vector<pattern::Pattern> patterns = patterns_of(options.count);
  const auto test_of = [&](const pattern::Pattern& pattern, const material::ParameterSet& set) {
    return tester::fracture_test({.design = pattern, .parameters = set, .conditions = {}, .fidelity = fidelity});
  };
  std::vector<tester::FractureTest> tests;
  for (const pattern::Pattern& pattern : patterns) tests.push_back(test_of(pattern, material::default_parameters()));
  const int places = std::min(places_on_device(tests.front(), options.most_places, options.emulated), options.count);
  auto device = device_with(places, options.emulated);
  fmt::print("device: {}, {} places\n", device->name(), places);
  BatchTimes times;
  const auto on_device = pull_all(std::move(device), places, tests, times);
  fmt::print("device: {:.1f} s, preparing {:.1f} s; now the processor\n", times.pulling_s, times.preparing_s);
  std::vector<PatternAgreement> rows(patterns.size());
  parallel_for(options.count, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    rows[at] = row_of(on_device[at].value(), tester::run_fracture_test<float>(tests[at]).value(),
                      tester::run_fracture_test<float>(test_of(patterns[at], moved_parameters(patterns[at]))).value());
  });
  std::ofstream csv(options.table);
  fmt::print(csv,
             "pattern,slope_difference,curve_difference,same_first_element,log_t_difference,log_t_difference_moved\n");
  for (std::size_t i = 0; i < rows.size(); ++i)
    fmt::print(csv, "{},{:.3e},{:.3e},{},{:.6f},{:.6f}\n", patterns[i].key(), rows[i].slope, rows[i].curve,
               rows[i].same_first ? 1 : 0, rows[i].log_t, rows[i].log_t_perturbed);
  print_summary(rows);
}

}  // namespace nacre::gpu_study
