#pragma once
// Fronts of two objectives that are both maximised, Young's modulus and toughness: ranks, crowding, hypervolume, gap.

#include <span>
#include <vector>

namespace nacre::optimize {

/// One point of the performance space.
struct Performance {
  double modulus_pa = 0.0;
  double toughness_pa = 0.0;
  bool operator==(const Performance&) const = default;
};

/// a is at least as good as b in both objectives and better in one.
bool dominates(const Performance& a, const Performance& b);

/// Rank of every point by non-dominated sorting, 1 for the Pareto front. O(N log N).
std::vector<int> non_dominated_ranks(std::span<const Performance> points);

/// NSGA-II crowding distance of each point within its rank; infinity at the ends of a rank.
std::vector<double> crowding_distances(std::span<const Performance> points, std::span<const int> ranks);

/// The Pareto front, by increasing modulus; equal points once.
std::vector<Performance> pareto_front(std::span<const Performance> points);

/// Area dominated by the front with respect to (0, 0), in GPa MPa: staircase = exact hypervolume; polygon = area under
/// the piecewise-linear front, closed by a horizontal line to the toughness axis and a vertical one to the modulus
/// axis.
double hypervolume_staircase_gpa_mpa(std::span<const Performance> points);
double hypervolume_polygon_gpa_mpa(std::span<const Performance> points);

/// The sim-to-real gap: area of the symmetric difference of the two staircase-dominated regions, in GPa MPa.
double front_gap_gpa_mpa(std::span<const Performance> a, std::span<const Performance> b);

}  // namespace nacre::optimize
