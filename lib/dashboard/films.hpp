#pragma once
// Fracture films: those in the run's folder, by design and model, and those that are made here on request, by design
// and parameters.

#include <filesystem>
#include <optional>
#include <string>

#include "dashboard/background.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

class Films {
 public:
  Films(std::filesystem::path run_folder, tester::Fidelity fidelity)
      : folder_(std::move(run_folder) / "films"), fidelity_(fidelity) {}

  /// The film that the farm made of a design with a model (the number of a round or the name of a family); nothing when
  /// there is none or its file cannot be read.
  std::optional<std::string> of_run(const run::RunRecord& run, const std::string& design,
                                    const std::string& model) const;
  /// Name of that film's file when it is there.
  std::optional<std::string> name_in_run(const run::RunRecord& run, const std::string& design,
                                         const std::string& model) const;

  /// Starts simulating and filming. False when too many tasks wait already.
  bool make(const pattern::Design& design, const material::ParameterSet& parameters);
  Background::State made(const pattern::Design& design, const material::ParameterSet& parameters) const;

 private:
  tester::Simulation simulation_of(const pattern::Design& design, const material::ParameterSet& parameters) const {
    return {design, parameters, {}, fidelity_};
  }
  std::filesystem::path folder_;
  tester::Fidelity fidelity_;
  Background background_;
};

/// The modulus that stands before the film in a made result, and the film's bytes.
struct MadeFilm {
  std::optional<double> modulus_pa;
  std::string_view film;
};
MadeFilm unpacked(const std::string& made);

}  // namespace nacre::dashboard
