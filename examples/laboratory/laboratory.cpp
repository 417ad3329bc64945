// A laboratory of one's own: it measures what nacre orders until the game is over. A simulation with other materials
// stands in for printer and testing machine; a real laboratory replaces pull().
// Usage: laboratory RUN, the folder of a game whose scenario says `virtual_lab = false`.

#include <iostream>

#include "client/client.hpp"
#include "tester/modulus.hpp"
#include "tester/tensile.hpp"
#include "tester/toughness.hpp"

namespace {

using namespace nacre;

/// E, T or a curve of one specimen of an order. Error: why the specimen is lost.
Result<void> pull(const client::Order& order, int number, measurement::SpecimenRecord& specimen) {
  material::ParameterSet ink = material::default_parameters();
  ink.modulus.e_vw_pa *= 0.9;  // materials that nacre does not know
  ink.toughness.w_vw_j_per_m3 *= 1.2;
  ink.strength_cv = 0.05;  // no two specimens break alike
  const tester::Simulation simulation{order.design, ink, order.conditions, order.fidelity, number};
  if (order.test == tester::TestKind::modulus) {
    const double gauge = 1.0 + 0.01 * RandomStream(1, specimen.specimen).normal();
    return tester::test_modulus(simulation).map([&](auto tested) { specimen.modulus_pa = gauge * tested.modulus_pa; });
  }
  if (order.test == tester::TestKind::toughness)
    return tester::test_toughness(simulation).map([&](auto tested) { specimen.toughness_pa = tested.toughness_pa; });
  const tester::Loading loading = order.loading.turns.empty() ? tester::Loading{{0.02}} : order.loading;
  return tester::test_tensile(simulation, tester::strain_path(loading, 1e-3)).map([&](auto curve) {
    specimen.curve = curve;
  });
}

void measure(client::Client& game, const client::Order& order) {
  for (int number = 1; number <= order.replicates; ++number) {
    measurement::SpecimenRecord specimen;
    specimen.specimen = order.id + "/" + std::to_string(number);
    specimen.design = order.design;
    specimen.test = order.test;
    specimen.conditions = order.conditions;
    specimen.batch = order.batch;
    const auto pulled = pull(order, number, specimen);
    specimen.valid = pulled.has_value();
    specimen.note = pulled ? "" : pulled.error().message;
    const auto answer = game.report(order, specimen);
    std::cout << specimen.specimen << (answer ? "" : ": " + answer.error().message) << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) try {
  client::Client game(argc > 1 ? argv[1] : "logs/latest", "own_laboratory");
  while (game.is_playing())
    for (const client::Order& order : game.orders(1.0)) measure(game, order);
} catch (const InputError& problem) {
  std::cerr << problem.what() << '\n';
  return 2;
}
