#include "dashboard/films.hpp"

#include <cstring>

#include "base/files.hpp"
#include "film/film_file.hpp"
#include "tester/modulus.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::size_t kMostFilmBytes = 64u << 20;

/// `HEX.film`, as the farm writes them: the name comes out of a database.
bool is_film_name(const std::string& name) {
  constexpr std::string_view kSuffix = ".film";
  const std::size_t length = name.size() < kSuffix.size() ? 0 : name.size() - kSuffix.size();
  return length > 0 && length <= 64 && name.ends_with(kSuffix) && name.find_first_not_of("0123456789abcdef") == length;
}

/// By the whole request, parameters included: a family keeps its name when another grouping gives it another model.
std::string key_of(const tester::Simulation& simulation) {
  return tester::simulation_key(simulation, tester::TestKind::modulus) +
         tester::simulation_key(simulation, tester::TestKind::toughness);
}

/// The cracks that a model predicts, by design; nullptr where the run has no such model.
const std::map<std::string, wire::Fracture>* cracks_by(const run::RunRecord& run, const std::string& model) {
  for (const auto& [number, round] : run.rounds)
    if (std::to_string(number) == model) return &round.cracks;
  for (const run::FamilyRecord& family : run.families)
    if (family.stated.name == model) return &family.cracks;
  return nullptr;
}

/// Simulates both tests, then the fracture once more for its film.
Result<std::string> simulated_film(const tester::Simulation& simulation) {
  const auto modulus = tester::test_modulus(simulation);
  const auto toughness = tester::test_toughness(simulation);
  if (!toughness) return fail("the fracture simulation failed: {}", toughness.error().message);
  const auto film = film::record_film(simulation, *toughness);
  if (!film) return fail("the film could not be made: {}", film.error().message);
  const double modulus_pa = modulus ? modulus->modulus_pa : 0.0;
  std::string made(sizeof(double), '\0');
  std::memcpy(made.data(), &modulus_pa, sizeof(double));
  return made + film::encode(*film);
}

}  // namespace

MadeFilm unpacked(const std::string& made) {
  double modulus_pa = 0.0;
  std::memcpy(&modulus_pa, made.data(), sizeof(double));
  return {modulus_pa > 0.0 ? std::optional<double>(modulus_pa) : std::nullopt,
          std::string_view(made).substr(sizeof(double))};
}

std::optional<std::string> Films::name_in_run(const run::RunRecord& run, const std::string& design,
                                              const std::string& model) const {
  const auto* cracks = cracks_by(run, model);
  if (cracks == nullptr) return std::nullopt;
  const auto found = cracks->find(design);
  if (found == cracks->end() || !is_film_name(found->second.film)) return std::nullopt;
  std::error_code unreadable;
  // A link could lead anywhere.
  if (std::filesystem::symlink_status(folder_ / found->second.film, unreadable).type() !=
      std::filesystem::file_type::regular)
    return std::nullopt;
  return found->second.film;
}

std::optional<std::string> Films::of_run(const run::RunRecord& run, const std::string& design,
                                         const std::string& model) const {
  const auto name = name_in_run(run, design, model);
  if (!name) return std::nullopt;
  try {
    return read_file_up_to(folder_ / *name, kMostFilmBytes);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool Films::make(const pattern::Design& design, const material::ParameterSet& parameters) {
  const tester::Simulation simulation = simulation_of(design, parameters);
  return background_.ask(key_of(simulation), [simulation](const auto&) { return simulated_film(simulation); });
}

Background::State Films::made(const pattern::Design& design, const material::ParameterSet& parameters) const {
  return background_.state(key_of(simulation_of(design, parameters)));
}

}  // namespace nacre::dashboard
