// Part of the command line (command.hpp): nacre show, a specimen that breaks, as a film and a page.

#include <filesystem>
#include <string>

#include "base/files.hpp"
#include "base/output_path.hpp"
#include "base/parallel.hpp"
#include "base/shipped_files.hpp"
#include "command.hpp"
#include "crack/crack_record.hpp"
#include "film/film.hpp"
#include "film_files.hpp"
#include "material/parameters.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "report/fracture_page.hpp"
#include "tester/modulus.hpp"

namespace nacre::cli {
namespace {

struct ShowOptions {
  std::string design;
  std::string out = "show";
  std::string fidelity = "full";
};

constexpr int kFilmWidth = 960;

pattern::Design design_to_show(const std::string& typed) {
  if (!typed.empty()) return pattern::design_from_argument(typed);
  return pattern::design_from_argument((shipped_folder() / "data" / "patterns" / "published_a.txt").string());
}

template <class Value>
Value expect(const Result<Value>& result, const pattern::Design& design) {
  if (!result) throw InputError::format("{}: {}", design.name(), result.error().message);
  return *result;
}

/// E and T of the design and of the rigid material, side by side.
void run_tests(report::BrokenSpecimen& specimen, const tester::Simulation& simulation,
               const tester::Simulation& reference) {
  Result<tester::ToughnessResult> fracture = fail("not run"), reference_fracture = fail("not run");
  Result<tester::ModulusResult> modulus = fail("not run"), reference_modulus = fail("not run");
  parallel_for(4, [&](int i) {
    if (i == 0) fracture = tester::test_toughness(simulation);
    if (i == 1) reference_fracture = tester::test_toughness(reference);
    if (i == 2) modulus = tester::test_modulus(simulation);
    if (i == 3) reference_modulus = tester::test_modulus(reference);
  });
  specimen.tested = {simulation.design, expect(modulus, simulation.design).modulus_pa,
                     expect(fracture, simulation.design)};
  specimen.reference = {reference.design, expect(reference_modulus, reference.design).modulus_pa,
                        expect(reference_fracture, reference.design)};
}

int show(const ShowOptions& options) {
  const tester::Simulation simulation{
      design_to_show(options.design), material::default_parameters(), {}, fidelity_from_option(options.fidelity)};
  tester::Simulation reference = simulation;
  reference.design = pattern::design_from_argument("rigid");
  prepare_output_folder(options.out);
  const std::string stem = file_stem(simulation.design.name());
  const std::filesystem::path folder(options.out), film_file = folder / (stem + ".gif"),
                                                   page = folder / (stem + ".html");

  Progress progress("show");
  report::BrokenSpecimen specimen{.tested = {}, .reference = {}, .crack = {}, .fidelity = simulation.fidelity};
  progress.set_share(0.0, "breaking");
  run_tests(specimen, simulation, reference);
  specimen.crack = crack::record_of(simulation, specimen.tested.fracture.breaks);
  progress.set_share(0.4, "filming");
  const film::Film film = expect(film::record_film(simulation, specimen.tested.fracture), simulation.design);
  progress.set_share(0.7, "drawing");
  draw_film(film, film_file.string(), stem, kFilmWidth);
  write_file_atomically(page, report::render_fracture_page(specimen, read_file(film_file)));
  progress.end();
  fmt::print("{}: E {} GPa, T {} MPa\n{}\nfilm: {}\npage: {}\n", simulation.design.name(),
             shown(1e-9 * specimen.tested.modulus_pa), shown(1e-6 * specimen.tested.fracture.toughness_pa),
             report::fracture_in_words(specimen), film_file.string(), page.string());
  return 0;
}

}  // namespace

void add_show(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ShowOptions>();
  CLI::App& command =
      add_command(app, action, "show", "Break a published pattern: a film, and a page that explains it", options, show);
  command.add_option("DESIGN", options->design, std::string(kDesignWords) + "; default: the thesis' pattern A");
  command.add_option("--out", options->out, "Folder for KEY.gif and KEY.html")->capture_default_str();
  add_fidelity(command, options->fidelity)->capture_default_str();
}

}  // namespace nacre::cli
