#include "film/film.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "tester/film_strains.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::film {
namespace {

constexpr int kCurvePoints = 256;
/// A value is updated only when it is off by more than this share of a step: smaller waves would flicker and take half
/// of the file.
constexpr double kEnergyBand = 0.75, kDisplacementBand = 1.0;

double largest_energy(const std::vector<tester::FractureFrame>& frames) {
  float largest = 0.0F;
  for (const tester::FractureFrame& frame : frames)
    for (const float energy : frame.energy_j_per_m3) largest = std::max(largest, energy);
  return largest > 0.0F ? static_cast<double>(largest) : 1.0;
}

/// The step nearest to `value`, or the previous one as long as it is near enough.
int followed(double value, int previous, double band) {
  return std::abs(value - previous) <= band ? previous : static_cast<int>(std::lround(value));
}

std::vector<std::uint8_t> energy_levels(const tester::FractureFrame& frame, const std::vector<std::uint8_t>& previous,
                                        double largest) {
  std::vector<std::uint8_t> levels(frame.energy_j_per_m3.size(), 0);
  for (std::size_t e = 0; e < levels.size(); ++e) {
    const double energy = frame.energy_j_per_m3[e];
    if (frame.material[e] == kVoid || !(energy > 0.0)) continue;
    const double exact = (std::log10(energy / largest) / kEnergyDecades + 1.0) * (kEnergyLevels - 1);
    const int level =
        followed(std::clamp(exact, 0.0, kEnergyLevels - 1.0), previous.empty() ? 0 : previous[e], kEnergyBand);
    levels[e] = static_cast<std::uint8_t>(level);
  }
  return levels;
}

/// Nodes of intact elements. The others drift freely and are not drawn.
std::vector<bool> held_nodes(const tester::FractureFrame& frame) {
  std::vector<bool> held((frame.columns + 1) * (frame.rows + 1), false);
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column) {
      if (frame.material[row * frame.columns + column] == kVoid) continue;
      const auto node = static_cast<std::size_t>(row * (frame.columns + 1) + column);
      const std::size_t above = node + static_cast<std::size_t>(frame.columns) + 1;
      held[node] = held[node + 1] = held[above] = held[above + 1] = true;
    }
  return held;
}

std::vector<std::int16_t> displacement_steps(const tester::FractureFrame& frame,
                                             const std::vector<std::int16_t>& previous, double step_m) {
  constexpr double kLimit = std::numeric_limits<std::int16_t>::max();
  const std::vector<bool> held = held_nodes(frame);
  const std::size_t nodes = held.size();
  std::vector<std::int16_t> steps = previous.empty() ? std::vector<std::int16_t>(2 * nodes, 0) : previous;
  for (std::size_t node = 0; node < nodes; ++node) {
    if (!held[node]) continue;
    const double height_m =
        static_cast<double>(node / static_cast<std::size_t>(frame.columns + 1)) * frame.element_size_m;
    const double beyond_m[2] = {frame.displacement_m[2 * node],
                                frame.displacement_m[2 * node + 1] - frame.strain * height_m};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      std::int16_t& step = steps[axis * nodes + node];
      const double exact = std::clamp(beyond_m[axis] / step_m, -kLimit, kLimit);
      step = static_cast<std::int16_t>(followed(exact, step, kDisplacementBand));
    }
  }
  return steps;
}

}  // namespace

double Film::energy_j_per_m3(int level) const {
  if (level <= 0) return 0.0;
  return largest_energy_j_per_m3 * std::pow(10.0, kEnergyDecades * (level / (kEnergyLevels - 1.0) - 1.0));
}

double Film::displacement_x_m(const FilmFrame& frame, int node) const {
  return displacement_step_m * frame.displacement_step[node];
}

double Film::displacement_y_m(const FilmFrame& frame, int node) const {
  const double height_m = (node / (columns + 1)) * element_size_m;
  return frame.strain * height_m + displacement_step_m * frame.displacement_step[node_count() + node];
}

Film film_of(const tester::Simulation& simulation, const tester::ToughnessResult& filmed) {
  assert(filmed.frames.size() >= 2);
  std::vector<tester::Break> order = filmed.breaks;  // strains as the file keeps them
  for (tester::Break& broken : order) broken.strain = static_cast<float>(broken.strain);
  const tester::FractureFrame& first = filmed.frames.front();
  Film film{.design = simulation.design.name(),
            .fidelity = std::string(tester::to_string(simulation.fidelity)),
            .columns = first.columns,
            .rows = first.rows,
            .element_size_m = first.element_size_m,
            .toughness_pa = filmed.toughness_pa,
            .peak_stress_pa = filmed.peak_stress_pa,
            .failure_strain = filmed.failure_strain,
            .end = std::string(tester::to_string(filmed.end)),
            .curve = filmed.curve.size() > kCurvePoints ? tester::resampled(filmed.curve, kCurvePoints) : filmed.curve,
            .material = first.material,
            .crack = crack::record_of(simulation, std::move(order)),
            .largest_energy_j_per_m3 = largest_energy(filmed.frames),
            .displacement_step_m = kDisplacementStep * first.element_size_m,
            .frames = {}};
  // The last frame may lie a rounding beyond the curve's end.
  const double last_strain = filmed.curve.empty() ? 0.0 : filmed.curve.strain.back();
  for (const tester::FractureFrame& frame : filmed.frames) {
    static const FilmFrame kNone;
    const FilmFrame& previous = film.frames.empty() ? kNone : film.frames.back();
    FilmFrame next{
        .strain = frame.strain,
        .stress_pa = tester::stress_at(filmed.curve, std::min(frame.strain, last_strain)),
        .broken = static_cast<int>(std::count_if(filmed.breaks.begin(), filmed.breaks.end(),
                                                 [&](const auto& b) { return b.strain < frame.strain; })),
        .energy_level = energy_levels(frame, previous.energy_level, film.largest_energy_j_per_m3),
        .displacement_step = displacement_steps(frame, previous.displacement_step, film.displacement_step_m)};
    film.frames.push_back(std::move(next));
  }
  return film;
}

Result<Film> record_film(const tester::Simulation& simulation, const tester::ToughnessResult& known, int frame_count) {
  tester::FractureTest test = tester::fracture_test(simulation);
  test.frame_strains = tester::film_strains(known, frame_count);
  const Result<tester::ToughnessResult> filmed = tester::run_fracture_test<float>(test);
  if (!filmed) return tl::unexpected(filmed.error());
  return film_of(simulation, *filmed);
}

}  // namespace nacre::film
