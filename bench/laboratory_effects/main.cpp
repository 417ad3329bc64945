// Effect sizes of the laboratory's hidden effects in log E over random patterns, the part that a refit of the base
// absorbs, and the collinearity of effects. Everything with the laboratory's own discretisation. Results:
// docs/studies/laboratory-effects.md.

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/Dense>

#include "base/parallel.hpp"
#include "base/result.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "laboratory/laboratory.hpp"
#include "pattern/random_pattern.hpp"

namespace {

using namespace nacre;
using laboratory::EffectKind;
using laboratory::Truth;
using Patterns = std::vector<pattern::Pattern>;

constexpr int kConstants = 6;  // on which a static modulus test depends

/// log E of every pattern, as the laboratory's machine records it, without scatter.
Eigen::VectorXd log_moduli(Truth truth, const Patterns& patterns, int threads) {
  truth.noise = {.modulus = 0.0, .toughness = 0.0, .strain = 0.0};
  Eigen::VectorXd logs(static_cast<Eigen::Index>(patterns.size()));
  parallel_for(
      static_cast<int>(patterns.size()),
      [&](int i) {
        const laboratory::Experiment experiment{.design = patterns[i],
                                                .test = tester::TestKind::modulus,
                                                .conditions = {},
                                                .fidelity = tester::Fidelity::full};
        const auto record = laboratory::record_specimen(truth, experiment, respond(truth, experiment),
                                                        {.specimen = "noiseless", .batch = "", .print_order = 0});
        if (!record.modulus_pa) throw InputError(record.note);
        logs(i) = std::log(*record.modulus_pa);
      },
      threads);
  return logs;
}

/// Columns: d log E / d log E_m (three) and d nu_m (three).
Eigen::MatrixXd base_tangents(const Truth& truth, const Patterns& patterns, int threads, const Eigen::VectorXd& base) {
  Eigen::MatrixXd tangents(base.size(), kConstants);
  for (int i = 0; i < kConstants; ++i) {
    Truth moved = truth;
    material::ModulusVector constants = material::to_vector(truth.modulus);
    const double step = i < 3 ? 1e-3 : -1e-3;
    double& value = constants[i];
    value = i < 3 ? value * std::exp(step) : value + step;
    moved.modulus = material::modulus_from_vector(constants);
    tangents.col(i) = (log_moduli(moved, patterns, threads) - base) / step;
  }
  return tangents;
}

/// Residual of `vector` after the best combination of the columns of `space`.
Eigen::VectorXd beyond(const Eigen::MatrixXd& space, const Eigen::VectorXd& vector) {
  return vector - space * space.colPivHouseholderQr().solve(vector);
}

/// Root mean square with the degrees of freedom that the projection has taken given back.
double rms(const Eigen::VectorXd& vector, Eigen::Index lost = 0) {
  return std::sqrt(vector.squaredNorm() / static_cast<double>(vector.size() - lost));
}

struct HiddenSignature {
  const EffectKind* kind = nullptr;
  double value = 0.0;
  Eigen::VectorXd raw, left;  ///< difference of log E; beyond the base
};

std::vector<HiddenSignature> signatures(const Truth& truth, const Patterns& patterns, int threads,
                                        const Eigen::VectorXd& base, const Eigen::MatrixXd& tangents) {
  std::vector<HiddenSignature> result;
  for (const EffectKind& kind : laboratory::effect_kinds()) {
    if (!kind.drawn_unasked) continue;
    std::vector<double> values = {kind.drawn_minimum, kind.drawn_maximum};
    if (kind.either_sign) values = {-kind.drawn_maximum, -kind.drawn_minimum, kind.drawn_minimum, kind.drawn_maximum};
    for (const double value : values) {
      Truth changed = truth;
      changed.effects.*kind.value = value;
      HiddenSignature signature{
          .kind = &kind, .value = value, .raw = log_moduli(changed, patterns, threads) - base, .left = {}};
      signature.left = beyond(tangents, signature.raw);
      result.push_back(std::move(signature));
    }
  }
  return result;
}

/// Effect size beyond the base and all other effects of the diagnosis' library, each at all its magnitudes: no
/// combination of them comes closer. Not a number with too few patterns.
double beyond_library(const HiddenSignature& signature, const std::vector<HiddenSignature>& all,
                      const Eigen::MatrixXd& tangents) {
  Eigen::MatrixXd space = tangents;
  for (const HiddenSignature& other : all) {
    if (other.kind == signature.kind || !other.kind->in_library) continue;
    space.conservativeResize(Eigen::NoChange, space.cols() + 1);
    space.col(space.cols() - 1) = other.raw;
  }
  return space.cols() < space.rows() ? rms(beyond(space, signature.raw), space.cols()) : std::nan("");
}

void run(int count, std::uint64_t seed, int threads) {
  Truth truth = laboratory::draw_truth(seed, tester::Fidelity::full);
  truth.effects = {};
  RandomStream random(seed, "laboratory effects");
  const Patterns patterns = pattern::stratified_patterns(count, random);
  const Eigen::VectorXd base = log_moduli(truth, patterns, threads);
  const Eigen::MatrixXd tangents = base_tangents(truth, patterns, threads, base);
  const std::vector<HiddenSignature> all = signatures(truth, patterns, threads, base, tangents);
  fmt::print("{} patterns, seed {}\n| effect | value | mean | rms | beyond the base | beyond base and library |", count,
             seed);
  for (const HiddenSignature& other : all) fmt::print(" {:.4} {} |", other.kind->name, other.value);
  fmt::print("\n");
  for (const HiddenSignature& signature : all) {
    fmt::print("| {} | {} | {:+.3f} | {:.3f} | {:.4f} | {:.4f} |", signature.kind->name, signature.value,
               signature.raw.mean(), rms(signature.raw), rms(signature.left, kConstants),
               beyond_library(signature, all, tangents));
    for (const HiddenSignature& other : all) {
      fmt::print(" {:+.2f} |", signature.left.dot(other.left) / (signature.left.norm() * other.left.norm()));
    }
    fmt::print("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Signatures of the virtual laboratory's hidden effects in log E"};
  int patterns = 16, threads = 0;
  std::uint64_t seed = 1;
  app.add_option("--patterns", patterns, "Random patterns, stratified 50-85 %")->check(CLI::Range(8, 1000));
  app.add_option("--seed", seed, "Of truth and patterns");
  app.add_option("--threads", threads, "0: all allowed cores")->check(CLI::Range(0, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    run(patterns, seed, threads);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
