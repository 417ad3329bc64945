// Changes of the features that a diagnosis compares (lib/diagnosis/features.hpp) when the elements of the fracture
// tester are halved: elements of size h against h/2, the layouts and parameter sets of discretisation_floor. Finished
// tests are kept in a table. Result: [FIDELITY.curve] of data/discretisation_floor.toml,
// docs/studies/discretisation-floor.md.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <Eigen/Dense>

#include "base/files.hpp"
#include "diagnosis/features.hpp"
#include "floor_rows.hpp"
#include "study/study_command.hpp"
#include "tester/refinement.hpp"
#include "tester/toughness.hpp"

namespace {

using namespace nacre;
using namespace nacre::discretisation_floor;
using diagnosis::Feature;

constexpr std::size_t kLeastPairs = 4;  // of a parameter set that is used
constexpr double kMiddleFraction = 0.675, kFractionUnit = 0.1;

/// The features of a fracture test, in their order.
std::vector<Feature> compared() {
  std::vector<Feature> features;
  for (int f = static_cast<int>(Feature::log_toughness); f <= static_cast<int>(Feature::tail); ++f)
    features.push_back(static_cast<Feature>(f));
  return features;
}

/// Stands for the value of a test that failed or has not this feature: the table keeps numbers only.
constexpr double kMissing = 1e9;

std::vector<double> features_of(const tester::Simulation& simulation, int refinement) {
  const auto result = tester::test_toughness(simulation, {.refinement = refinement});
  const diagnosis::FeatureValues features =
      result ? diagnosis::fracture_features(result->curve, {}) : diagnosis::FeatureValues{};
  std::vector<double> values;
  for (const Feature feature : compared()) values.push_back(diagnosis::value_of(features, feature).value_or(kMissing));
  return values;
}

std::vector<study::Wanted> wanted_curves(const FloorPlan& plan) {
  std::vector<study::Wanted> wanted;
  for (int specimen = 0; specimen < plan.specimens; ++specimen)
    for (std::size_t pass = 0; pass < plan.sets.size(); ++pass)
      for (std::size_t i = 0; i < plan.layouts.size(); ++i)
        for (const int refinement : {1, 2}) {
          const std::size_t set = (i + pass) % plan.sets.size();
          const tester::Simulation simulation{
              plan.layouts[i], tester::refined(plan.sets[set], refinement), {}, plan.fidelity, specimen};
          wanted.push_back(
              {toughness_key(plan, i, set, refinement, specimen), [=] { return features_of(simulation, refinement); }});
        }
  return wanted;
}

/// One layout with one parameter set on both meshes.
struct MeshPair {
  double z = 0.0;
  int specimens = 0;
  Eigen::VectorXd change;   ///< feature(h/2) - feature(h), mean over specimens
  Eigen::MatrixXd squares;  ///< of the specimens' departures from it
};

/// Their specimens that have every feature on both meshes; nothing where none has.
std::optional<MeshPair> finished_pair(const FloorPlan& plan, const study::StudyTable& table, std::size_t layout,
                                      std::size_t set) {
  const auto count = static_cast<Eigen::Index>(compared().size());
  Eigen::MatrixXd changes(count, 0);
  for (int specimen = 0; specimen < plan.specimens; ++specimen) {
    const auto coarse = table.find(toughness_key(plan, layout, set, 1, specimen)),
               fine = table.find(toughness_key(plan, layout, set, 2, specimen));
    if (!coarse || !fine || std::ranges::max(*coarse) == kMissing || std::ranges::max(*fine) == kMissing) continue;
    changes.conservativeResize(Eigen::NoChange, changes.cols() + 1);
    changes.rightCols<1>() = Eigen::Map<const Eigen::VectorXd>(fine->data(), count) -
                             Eigen::Map<const Eigen::VectorXd>(coarse->data(), count);
  }
  if (changes.cols() == 0) return std::nullopt;
  const Eigen::VectorXd mean = changes.rowwise().mean();
  const Eigen::MatrixXd departures = changes.colwise() - mean;
  return MeshPair{(plan.layouts[layout].rigid_fraction() - kMiddleFraction) / kFractionUnit,
                  static_cast<int>(changes.cols()), mean, departures * departures.transpose()};
}

/// The covariance nearest to a difference of two (in correlations): variances keep at least a thousandth of `whole`.
Eigen::MatrixXd as_covariance(const Eigen::MatrixXd& difference, const Eigen::MatrixXd& whole) {
  constexpr double kLeast = 1e-3;
  const Eigen::VectorXd scale = whole.diagonal().cwiseSqrt();
  const Eigen::MatrixXd relative = scale.cwiseInverse().asDiagonal() * difference * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(relative);
  const Eigen::MatrixXd positive =
      parts.eigenvectors() * parts.eigenvalues().cwiseMax(kLeast).asDiagonal() * parts.eigenvectors().transpose();
  return scale.asDiagonal() * positive * scale.asDiagonal();
}

/// Covariance of changes of expectations: the part that all layouts share and the part linear in rigid fraction (means
/// over parameter sets), and the residual of a layout, less what the finite number of specimens makes of it: cracks go
/// other ways on other elements, and a mean over few of them is still chance.
struct CurveFloor {
  Eigen::MatrixXd shared, rigid, layout;
  Eigen::VectorXd finite_n_sd;  ///< of a residual, taken off
  int pairs = 0, sets = 0;
};

CurveFloor curve_floor(const FloorPlan& plan, const study::StudyTable& table) {
  const auto count = static_cast<Eigen::Index>(compared().size());
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(count, count);
  CurveFloor floor{none, none, none, Eigen::VectorXd::Zero(count)};
  Eigen::MatrixXd departures = none;
  double freedom = 0.0, freedom_of_departures = 0.0, shares = 0.0;
  for (std::size_t s = 0; s < plan.sets.size(); ++s) {
    std::vector<MeshPair> pairs;
    for (std::size_t i = 0; i < plan.layouts.size(); ++i)
      if (const auto pair = finished_pair(plan, table, i, s)) pairs.push_back(*pair);
    if (pairs.size() < kLeastPairs) continue;
    double n = 0.0, z1 = 0.0, z2 = 0.0;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(count), sum_z = sum;
    for (const MeshPair& pair : pairs)
      n += 1.0, z1 += pair.z, z2 += pair.z * pair.z, sum += pair.change, sum_z += pair.z * pair.change;
    const double determinant = n * z2 - z1 * z1;
    const Eigen::VectorXd middle = (z2 * sum - z1 * sum_z) / determinant, slope = (n * sum_z - z1 * sum) / determinant;
    floor.shared += middle * middle.transpose();
    floor.rigid += slope * slope.transpose();
    for (const MeshPair& pair : pairs) {
      const Eigen::VectorXd residual = pair.change - middle - pair.z * slope;
      floor.layout += residual * residual.transpose();
      departures += pair.squares;
      freedom_of_departures += pair.specimens - 1.0;
      shares += 1.0 / pair.specimens;
    }
    freedom += n - 2.0;
    floor.pairs += static_cast<int>(pairs.size());
    ++floor.sets;
  }
  if (floor.sets == 0) return floor;
  floor.shared /= floor.sets, floor.rigid /= floor.sets, floor.layout /= freedom;
  if (freedom_of_departures == 0.0) return floor;
  const Eigen::MatrixXd finite_n = departures / freedom_of_departures * (shares / floor.pairs);
  floor.finite_n_sd = finite_n.diagonal().cwiseSqrt();
  floor.layout = as_covariance(floor.layout - finite_n, floor.layout);
  return floor;
}

std::string text_of(const Eigen::MatrixXd& matrix) {
  std::string text = "[\n";
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    text += "  [";
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      text += fmt::format("{}{:.3e}", column == 0 ? "" : ", ", matrix(row, column));
    text += "],\n";
  }
  return text + "]";
}

void run(const FloorOptions& options) {
  const FloorPlan plan = plan_of(options);
  std::vector<std::string> columns;
  for (const Feature feature : compared()) columns.emplace_back(to_string(feature));
  study::StudyTable table(options.table.table, columns);
  const int missing = study::fill(table, wanted_curves(plan), options.table.seconds, options.table.threads);
  if (missing > 0) fmt::print(stderr, "{} fracture tests are still missing: run it again\n", missing);
  const CurveFloor floor = curve_floor(plan, table);
  std::string names;
  for (const std::string& name : columns) names += (names.empty() ? "\"" : ", \"") + name + "\"";
  fmt::print(
      "[{}.curve]  # {} pairs, {} parameter sets; taken off for their finite numbers of specimens: sd {:.3f}\n"
      "features = [{}]\ncovariance_shared = {}\ncovariance_rigid = {}\ncovariance_layout = {}\n",
      options.fidelity, floor.pairs, floor.sets, fmt::join(floor.finite_n_sd, ", "), names, text_of(floor.shared),
      text_of(floor.rigid), text_of(floor.layout));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Discretisation floor of the features of a curve: elements of size h against h/2"};
  FloorOptions options{.table = {.table = "curve_floor.csv"}};
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  return study::exit_status_of([&] { run(options); });
}
