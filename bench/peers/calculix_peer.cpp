// The modulus of random patterns, by the modulus tester and by CalculiX (ccx) on the same mesh: agreement and time.
//
// CalculiX gets four-node plane-strain elements with the plane-stress equivalents E', nu' of Eq. 2.3, whose Lame
// parameters are the tester's; small strain. Times are processor time: of its process, reading and writing files
// included, and of test_modulus. Exit status 1 when the two differ by more than 1e-5 (it prints seven digits).

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/os.h>
#include <sys/resource.h>
#include <CLI/CLI.hpp>

#include "fem/element.hpp"
#include "fem/static_solver.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/fidelity.hpp"
#include "tester/modulus.hpp"
#include "thesis/constants.hpp"

namespace {

using namespace nacre;
namespace fs = std::filesystem;

/// Strain of the comparison: small enough that the tester's finite-strain law is linear to 1e-6.
constexpr double kStrain = 1e-6;

/// E' and nu' of plane strain with these Lame parameters.
std::pair<double, double> engineering(const material::Lame& lame) {
  const double sum = lame.lambda_pa + lame.mu_pa;
  return {lame.mu_pa * (3.0 * lame.lambda_pa + 2.0 * lame.mu_pa) / sum, 0.5 * lame.lambda_pa / sum};
}

/// Lines of at most eight numbers.
void write_set(fmt::ostream& deck, const std::vector<int>& members) {
  for (std::size_t i = 0; i < members.size(); ++i) deck.print("{}{}", members[i], i % 8 == 7 ? ",\n" : ", ");
  deck.print("\n");
}

/// Unit element size, unit thickness; nodes and elements counted from 1 in the grid's order.
void write_deck(const fs::path& file, const fem::Grid& grid) {
  fmt::ostream deck = fmt::output_file(file.string());
  const int per_row = grid.columns + 1, top = grid.rows * per_row;
  deck.print("*NODE, NSET=ALL\n");
  for (int node = 0; node < top + per_row; ++node)
    deck.print("{}, {}, {}, 0\n", node + 1, node % per_row, node / per_row);
  deck.print("*ELEMENT, TYPE=CPE4, ELSET=SPECIMEN\n");
  const std::vector<material::Lame> lame = fem::lame_of(grid);
  std::map<std::pair<double, double>, std::vector<int>> materials;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int element = grid.index(row, column), corner = row * per_row + column + 1;
      deck.print("{}, {}, {}, {}, {}\n", element + 1, corner, corner + 1, corner + per_row + 1, corner + per_row);
      materials[engineering(lame[element])].push_back(element + 1);
    }
  int name = 0;
  for (const auto& [constants, elements] : materials) {
    deck.print("*ELSET, ELSET=E{}\n", ++name);
    write_set(deck, elements);
    deck.print("*MATERIAL, NAME=M{}\n*ELASTIC\n{:.12e}, {:.12e}\n*SOLID SECTION, ELSET=E{}, MATERIAL=M{}\n1.\n", name,
               constants.first, constants.second, name, name);
  }
  deck.print("*NSET, NSET=BOTTOM, GENERATE\n1, {}\n*NSET, NSET=TOP, GENERATE\n{}, {}\n", per_row, top + 1,
             top + per_row);
  deck.print("*STEP\n*STATIC\n*BOUNDARY\n1, 1, 1\nBOTTOM, 2, 2\nTOP, 2, 2, {:.12e}\n", kStrain * grid.rows);
  deck.print("*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF\n*END STEP\n");
}

/// Vertical reaction of the upper grip over the width, Pa.
double read_stress(const fs::path& file, const fem::Grid& grid) {
  std::ifstream lines(file);
  std::string line, last;
  while (std::getline(lines, line))
    if (line.find_first_not_of(' ') != std::string::npos) last = line;
  std::istringstream numbers(last);
  double x = std::nan(""), y = std::nan("");
  numbers >> x >> y;
  return y / grid.columns;
}

double cpu_seconds(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

template <class Work>
double seconds_of(int who, const Work& work) {
  const double start = cpu_seconds(who);
  work();
  return cpu_seconds(who) - start;
}

/// A result and the processor time it took.
struct TimedModulus {
  double modulus_pa = std::nan("");
  double seconds = 0.0;
};

TimedModulus solve_with_calculix(const fem::Grid& grid, const std::string& solver, const fs::path& folder) {
  write_deck(folder / "specimen.inp", grid);
  const std::string command =
      fmt::format("cd {} && OMP_NUM_THREADS=1 {} -i specimen > log.txt 2>&1", folder.string(), solver);
  TimedModulus result;
  result.seconds = seconds_of(RUSAGE_CHILDREN, [&] {
    if (std::system(command.c_str()) != 0) throw std::runtime_error(command + " failed; see log.txt there");
  });
  result.modulus_pa = read_stress(folder / "specimen.dat", grid) / kStrain;
  return result;
}

TimedModulus solve_with_nacre(const tester::Simulation& simulation, const fem::Grid& grid, int repeats) {
  TimedModulus result{.modulus_pa = fem::pull(grid, kStrain).value().top_stress_pa / kStrain, .seconds = 0.0};
  result.seconds = seconds_of(RUSAGE_SELF,
                              [&] {
                                for (int i = 0; i < repeats; ++i) (void)tester::test_modulus(simulation).value();
                              }) /
                   repeats;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The modulus of random patterns by nacre and by CalculiX on the same mesh"};
  int count = 10;
  std::string solver = "ccx";
  fs::path folder = fs::temp_directory_path() / fmt::format("nacre-calculix-{}", getpid());
  app.add_option("--count", count, "patterns");
  app.add_option("--solver", solver, "the ccx program");
  app.add_option("--folder", folder, "where its files go");
  CLI11_PARSE(app, argc, argv);
  fs::create_directories(folder);
  RandomStream random(1, "peers");
  double worst = 0.0, ours = 0.0, theirs = 0.0;
  fmt::print("| pattern | rigid | E nacre, MPa | E CalculiX, MPa | relative difference | nacre, ms | CalculiX, ms |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const pattern::Pattern& pattern : pattern::stratified_patterns(count, random)) {
    const tester::Simulation simulation{
        .design = pattern, .parameters = material::default_parameters(), .conditions = {}};
    const tester::SpecimenUnits units = tester::modulus_units(simulation.fidelity);
    const fem::Grid grid = tester::assemble(simulation.design, simulation.parameters, simulation.conditions,
                                            tester::AssemblyTarget::modulus, units.x, units.y);
    const TimedModulus nacre = solve_with_nacre(simulation, grid, 20),
                       calculix = solve_with_calculix(grid, solver, folder);
    const double difference = nacre.modulus_pa / calculix.modulus_pa - 1.0;
    worst = std::max(worst, std::abs(difference));
    ours += nacre.seconds / count;
    theirs += calculix.seconds / count;
    fmt::print("| {} | {:.2f} | {:.4f} | {:.4f} | {:+.1e} | {:.2f} | {:.0f} |\n", pattern.key(),
               pattern.rigid_fraction(), nacre.modulus_pa * 1e-6, calculix.modulus_pa * 1e-6, difference,
               1e3 * nacre.seconds, 1e3 * calculix.seconds);
    std::fflush(stdout);
  }
  fmt::print("\nlargest difference {:.1e}; mean {:.2f} ms against {:.0f} ms of processor time: {:.0f} times\n", worst,
             1e3 * ours, 1e3 * theirs, theirs / ours);
  fs::remove_all(folder);
  return worst < 1e-5 ? 0 : 1;
}
