#include "expectation_floor.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/random.hpp"
#include "base/statistics.hpp"
#include "tester/toughness.hpp"

namespace nacre::discretisation_floor {
namespace {

constexpr int kBootstraps = 2000;
constexpr std::size_t kLeastDesigns = 3;  // of a parameter set in a bootstrap

/// T and peak stress of finished specimens, Pa.
struct Finished {
  std::vector<double> toughness_pa, peak_pa;
};

Finished finished(const FloorPlan& plan, std::size_t layout, std::size_t set, int refinement, int count,
                  const study::StudyTable& table) {
  Finished result;
  for (int specimen = 0; specimen < count; ++specimen) {
    const auto row = table.find(toughness_key(plan, layout, set, refinement, specimen));
    if (!row || (*row)[0] <= 0.0) break;
    result.toughness_pa.push_back((*row)[0]);
    result.peak_pa.push_back((*row)[1]);
  }
  return result;
}

/// Relative variances and covariance of the specimens of one design.
struct Scatter {
  double coarse = 0.0, fine = 0.0, both = 0.0;
};

Scatter scatter_of(const DesignPair& design) {
  const double coarse_mean = mean(design.coarse_pa), fine_mean = mean(design.fine_pa);
  const auto square = [](double x) { return x * x; };
  Scatter scatter{.coarse = square(standard_deviation(design.coarse_pa) / coarse_mean),
                  .fine = square(standard_deviation(design.fine_pa) / fine_mean)};
  const std::size_t common = std::min(design.coarse_pa.size(), design.fine_pa.size());
  const std::span<const double> coarse(design.coarse_pa.data(), common), fine(design.fine_pa.data(), common);
  const double coarse_middle = mean(coarse), fine_middle = mean(fine);
  for (std::size_t i = 0; i < common; ++i)
    scatter.both += (coarse[i] - coarse_middle) * (fine[i] - fine_middle) / coarse_mean / fine_mean;
  scatter.both /= std::max(1.0, static_cast<double>(common) - 1.0);
  return scatter;
}

double finite_n_variance(const DesignPair& design, const Scatter& scatter) {
  const auto coarse = static_cast<double>(design.coarse_pa.size()), fine = static_cast<double>(design.fine_pa.size());
  return scatter.coarse / coarse + scatter.fine / fine - 2.0 * scatter.both / std::max(coarse, fine);
}

/// Log ratios of pairs of T after one factor, and their ranks.
struct Comparison {
  double shift = 0.0, squares = 0.0, spearman = 0.0;
};

Comparison compare(const std::vector<double>& coarse_pa, const std::vector<double>& fine_pa) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < coarse_pa.size(); ++i) ratios.push_back(std::log(fine_pa[i] / coarse_pa[i]));
  Comparison result{.shift = mean(ratios), .spearman = rank_correlation(coarse_pa, fine_pa)};
  for (const double ratio : ratios) result.squares += (ratio - result.shift) * (ratio - result.shift);
  return result;
}

Comparison compare_means(const std::vector<const DesignPair*>& designs) {
  std::vector<double> coarse_pa, fine_pa;
  for (const DesignPair* design : designs) {
    coarse_pa.push_back(mean(design->coarse_pa));
    fine_pa.push_back(mean(design->fine_pa));
  }
  return compare(coarse_pa, fine_pa);
}

/// Specimens that every design has on both meshes.
std::size_t common_specimens(const std::vector<const DesignPair*>& designs) {
  std::size_t count = SIZE_MAX;
  for (const DesignPair* design : designs) count = std::min({count, design->coarse_pa.size(), design->fine_pa.size()});
  return count;
}

/// As of single specimens: the mean of the comparisons by the first, the second, ...
Comparison compare_ones(const std::vector<const DesignPair*>& designs) {
  const std::size_t count = common_specimens(designs);
  Comparison all;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> coarse_pa, fine_pa;
    for (const DesignPair* design : designs) {
      coarse_pa.push_back(design->coarse_pa[i]);
      fine_pa.push_back(design->fine_pa[i]);
    }
    const Comparison one = compare(coarse_pa, fine_pa);
    all.squares += one.squares / static_cast<double>(count);
    all.spearman += one.spearman / static_cast<double>(count);
  }
  return all;
}

/// Squared correlation of the log ratios of T and of peak stress, both about the mean of their parameter set.
double peak_share(const std::map<std::size_t, std::vector<const DesignPair*>>& by_set) {
  double both = 0.0, toughness = 0.0, peak = 0.0;
  for (const auto& [set, own] : by_set) {
    const double shift = compare_means(own).shift;
    double middle = 0.0;
    for (const DesignPair* design : own) middle += design->log_peak_ratio / static_cast<double>(own.size());
    for (const DesignPair* design : own) {
      const double of_toughness = std::log(mean(design->fine_pa) / mean(design->coarse_pa)) - shift,
                   of_peak = design->log_peak_ratio - middle;
      both += of_toughness * of_peak, toughness += of_toughness * of_toughness, peak += of_peak * of_peak;
    }
  }
  return toughness > 0.0 && peak > 0.0 ? both * both / (toughness * peak) : 0.0;
}

/// A figure of the floor and how it is printed.
struct Figure {
  const char* words;
  bool of_scatter;  ///< needs at least two specimens of every design
  double ExpectationFloor::*value;
};
constexpr Figure kFigures[] = {
    {"mean of log T(fine)/T(coarse)", false, &ExpectationFloor::shift},
    {"sd after one factor per set, means of specimens", false, &ExpectationFloor::sd},
    {"share of the finite number of specimens", true, &ExpectationFloor::finite_n_sd},
    {"sd of log E[T], that share taken off", true, &ExpectationFloor::expected_sd},
    {"Spearman, means of specimens", false, &ExpectationFloor::spearman},
    {"sd after one factor per set, single specimens", false, &ExpectationFloor::one_sd},
    {"Spearman, single specimens", false, &ExpectationFloor::one_spearman},
    {"scatter between specimens, coarse", true, &ExpectationFloor::coarse_scatter},
    {"scatter between specimens, fine", true, &ExpectationFloor::fine_scatter},
    {"share of that variance with the change of peak stress", false, &ExpectationFloor::peak_share},
    {"correlation of one specimen's departure on both meshes", true, &ExpectationFloor::same_crack},
};

/// Designs drawn with replacement, within every parameter set as many as it has.
std::vector<DesignPair> resampled(const std::map<std::size_t, std::vector<const DesignPair*>>& by_set,
                                  RandomStream& random) {
  std::vector<DesignPair> drawn;
  for (const auto& [set, own] : by_set)
    for (std::size_t i = 0; i < own.size(); ++i) drawn.push_back(*own[random.index(static_cast<int>(own.size()))]);
  return drawn;
}

std::map<std::size_t, std::vector<const DesignPair*>> grouped_by_set(const std::vector<DesignPair>& designs) {
  std::map<std::size_t, std::vector<const DesignPair*>> by_set;
  for (const DesignPair& design : designs) by_set[design.set].push_back(&design);
  return by_set;
}

}  // namespace

std::vector<study::Wanted> wanted_specimens(const FloorPlan& plan, const SpecimenPlan& specimens) {
  std::vector<study::Wanted> wanted;
  for (int specimen = 0; specimen < std::max(specimens.coarse, specimens.fine); ++specimen)
    for (std::size_t pass = 0; pass < static_cast<std::size_t>(plan.sets_per_layout); ++pass)
      for (std::size_t i = 0; i < plan.layouts.size(); ++i)
        for (const bool fine : {false, true}) {
          if (specimen >= (fine ? specimens.fine : specimens.coarse)) continue;
          const int refinement = specimens.refinement * (fine ? 2 : 1);
          const std::size_t set = (i + pass) % plan.sets.size();
          wanted.push_back(wanted_fracture_test(plan, i, set, refinement, specimen));
        }
  return wanted;
}

std::vector<DesignPair> finished_designs(const FloorPlan& plan, const SpecimenPlan& specimens,
                                         const study::StudyTable& table) {
  std::vector<DesignPair> designs;
  const auto values = [&](std::size_t layout, std::size_t set, bool fine) {
    return finished(plan, layout, set, specimens.refinement * (fine ? 2 : 1), fine ? specimens.fine : specimens.coarse,
                    table);
  };
  for (std::size_t i = 0; i < plan.layouts.size(); ++i)
    for (std::size_t set = 0; set < plan.sets.size(); ++set) {
      const Finished coarse = values(i, set, false), fine = values(i, set, true);
      const auto enough = [](const Finished& is, int wanted) {
        return static_cast<int>(is.peak_pa.size()) >= std::min(2, wanted);
      };
      if (!enough(coarse, specimens.coarse) || !enough(fine, specimens.fine)) continue;
      designs.push_back(
          {set, coarse.toughness_pa, fine.toughness_pa, std::log(mean(fine.peak_pa) / mean(coarse.peak_pa))});
    }
  return designs;
}

ExpectationFloor expectation_floor(const std::vector<DesignPair>& designs) {
  ExpectationFloor floor;
  double freedom = 0.0, variance = 0.0, one_variance = 0.0, noise = 0.0;
  Scatter scatter;
  for (const DesignPair& design : designs) {
    const auto count = static_cast<double>(designs.size());
    const Scatter own = scatter_of(design);
    scatter.coarse += own.coarse / count, scatter.fine += own.fine / count, scatter.both += own.both / count;
    noise += finite_n_variance(design, own) / count;
  }
  const auto by_set = grouped_by_set(designs);
  for (const auto& [set, own] : by_set) {
    const Comparison means = compare_means(own), ones = compare_ones(own);
    floor.shift += means.shift * static_cast<double>(own.size()) / static_cast<double>(designs.size());
    floor.spearman += means.spearman / static_cast<double>(by_set.size());
    floor.one_spearman += ones.spearman / static_cast<double>(by_set.size());
    variance += means.squares, one_variance += ones.squares;
    freedom += static_cast<double>(own.size()) - 1.0;
  }
  variance /= freedom;
  floor.sd = std::sqrt(variance);
  floor.peak_share = peak_share(by_set);
  floor.one_sd = std::sqrt(one_variance / freedom);
  floor.finite_n_sd = std::sqrt(std::max(0.0, noise));
  floor.expected_sd = std::sqrt(std::max(0.0, variance - noise));
  floor.coarse_scatter = std::sqrt(scatter.coarse), floor.fine_scatter = std::sqrt(scatter.fine);
  if (scatter.coarse > 0.0 && scatter.fine > 0.0)
    floor.same_crack = scatter.both / std::sqrt(scatter.coarse * scatter.fine);
  return floor;
}

std::string expectation_table(const std::vector<DesignPair>& designs, std::uint64_t seed) {
  const auto by_set = grouped_by_set(designs);
  for (const auto& [set, own] : by_set)
    if (own.size() < kLeastDesigns) return fmt::format("fewer than {} designs of set {}\n", kLeastDesigns, set);
  if (by_set.empty()) return "no design is finished\n";
  std::vector<ExpectationFloor> draws;
  RandomStream random(seed, "expectation floor");
  for (int b = 0; b < kBootstraps; ++b) draws.push_back(expectation_floor(resampled(by_set, random)));
  const ExpectationFloor floor = expectation_floor(designs);
  std::string text = "| figure | value | 90 % interval |\n| --- | --- | --- |\n";
  const bool scatters = std::ranges::all_of(
      designs, [](const DesignPair& design) { return std::min(design.coarse_pa.size(), design.fine_pa.size()) > 1; });
  for (const Figure& figure : kFigures) {
    if (figure.of_scatter && !scatters) continue;
    std::vector<double> values;
    for (const ExpectationFloor& draw : draws) values.push_back(draw.*figure.value);
    text += fmt::format("| {} | {:.3f} | {:.3f} to {:.3f} |\n", figure.words, floor.*figure.value,
                        quantile(values, 0.05), quantile(values, 0.95));
  }
  return text;
}

}  // namespace nacre::discretisation_floor
