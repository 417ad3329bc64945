#pragma once
// The simulations of the discretisation floor: every layout with every parameter set on elements of size h, h/2, ...

#include <string>
#include <vector>

#include "material/parameters.hpp"
#include "pattern/layout.hpp"
#include "study/study_command.hpp"
#include "study/study_table.hpp"
#include "tester/simulation.hpp"

namespace nacre::discretisation_floor {

/// Share of rigid pixels that most proposals exceed: layouts with fewer and with more are told apart.
inline constexpr double kManyRigid = 0.75;

/// Layouts x parameter sets that are compared.
struct FloorPlan {
  tester::Fidelity fidelity = tester::Fidelity::preview;
  std::uint64_t seed = 1;
  std::vector<pattern::Pattern> layouts;
  std::vector<material::ParameterSet> sets;  ///< the first is the default
  int sets_per_layout = 5;  ///< of a fracture test, in turn; every layout with all of them: as many as sets
  int specimens = 1;        ///< of a fracture test: numbers 0 .. n - 1, the same on both meshes
};

/// Options of a program: its plan and its table.
struct FloorOptions {
  int layouts = 48, sets = 5, specimens = 1;
  std::string fidelity = "preview", gamut = "bench/discretisation_floor/gamut.csv";
  study::TableOptions table;
};
void add_options(CLI::App& app, FloorOptions& options);
FloorPlan plan_of(const FloorOptions& options);

/// Half of the layouts random, stratified over 50-85 % rigid; half the best ones (by rank) of a gamut.
std::vector<pattern::Pattern> floor_layouts(int count, const std::string& gamut_file, std::uint64_t seed);

/// The defaults, then sets drawn from the middle half of every range of Table A.2 (W for the default criterion).
std::vector<material::ParameterSet> floor_parameter_sets(int count, std::uint64_t seed);

/// E on elements of size h / refinement, Pa. Throws InputError when a simulation fails.
double modulus_pa(const FloorPlan& plan, const pattern::Pattern& layout, const material::ModulusParameters& theta,
                  int refinement);

inline const std::vector<std::string> kToughnessColumns = {"toughness_pa", "peak_stress_pa", "failure_strain"};
/// The key of a fracture test of a layout with a set of the plan: it names criterion and variation of the set too.
std::string toughness_key(const FloorPlan& plan, std::size_t layout, std::size_t set, int refinement, int specimen);

/// The plan where every set has this criterion, W of the same fracture energy, and this strength_cv.
FloorPlan with_criterion(FloorPlan plan, const material::FailureCriterion& criterion, double strength_cv);

/// One fracture test on elements of size h / refinement, with parameters `tester::refined`. A failed test gives zeros.
study::Wanted wanted_fracture_test(const FloorPlan& plan, std::size_t layout, std::size_t set, int refinement,
                                   int specimen);

/// Fracture tests at h and h/2: first every layout with one parameter set, in turn, then with the next one, then all
/// with the next specimen.
std::vector<study::Wanted> wanted_fracture_tests(const FloorPlan& plan);

}  // namespace nacre::discretisation_floor
