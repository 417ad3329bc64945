#pragma once
// A fracture test as a film: the data for a picture of every moment, quantised so that it is small. Elements and nodes
// are numbered as in fem::Grid, row 0 at the bottom.

#include <cstdint>
#include <string>
#include <vector>

#include "crack/crack_record.hpp"

namespace nacre::film {

/// Frames of a film, unless asked otherwise.
inline constexpr int kFrames = 48;
/// Energy densities are kept in so many logarithmic levels ...
inline constexpr int kEnergyLevels = 48;
/// ... over so many decades below the largest of the film; lower ones are level 0.
inline constexpr double kEnergyDecades = 3.2;
/// Step of displacements, as a share of an element's side; they are right to within one step.
inline constexpr double kDisplacementStep = 0.125;
/// Material of an element that is empty.
inline constexpr std::uint8_t kVoid = 3;

/// One moment.
struct FilmFrame {
  double strain = 0.0;
  double stress_pa = 0.0;
  int broken = 0;                               ///< number of failed elements, the first of the crack's order
  std::vector<std::uint8_t> energy_level;       ///< per element, 0 .. kEnergyLevels - 1
  std::vector<std::int16_t> displacement_step;  ///< x of all nodes, then y; beyond the uniform stretch, see Film
  bool operator==(const FilmFrame&) const = default;
};

struct Film {
  std::string design;  ///< canonical name
  std::string fidelity;
  int columns = 0, rows = 0;
  double element_size_m = 0.0;
  double toughness_pa = 0.0, peak_stress_pa = 0.0, failure_strain = 0.0;
  std::string end;                     ///< why the test ended
  tester::Curve curve;                 ///< resampled to at most 256 points
  std::vector<std::uint8_t> material;  ///< per element before the test: 0 soft, 1 rigid, 2 interface, 3 void
  crack::CrackRecord crack;
  double largest_energy_j_per_m3 = 0.0;
  double displacement_step_m = 0.0;
  std::vector<FilmFrame> frames;
  bool operator==(const Film&) const = default;

  int node_count() const { return (columns + 1) * (rows + 1); }
  /// Energy density of a level, J/m^3: largest * 10^(decades * (level / (levels - 1) - 1)); 0 for level 0.
  double energy_j_per_m3(int level) const;
  /// Displacement of a node in a frame, m: steps times the step, and along y the uniform stretch strain * height.
  double displacement_x_m(const FilmFrame& frame, int node) const;
  double displacement_y_m(const FilmFrame& frame, int node) const;
};

/// The film of a toughness test that was run with frames (Discretisation::frame_count >= 2).
Film film_of(const tester::Simulation& simulation, const tester::ToughnessResult& filmed);

/// Films a test whose result is known (curve, breaks, failure strain): the specimen is pulled once more, its frames
/// placed by film_strains(). Error: as test_toughness.
Result<Film> record_film(const tester::Simulation& simulation, const tester::ToughnessResult& known,
                         int frame_count = kFrames);

}  // namespace nacre::film
