// Part of the Python module (module.hpp): runs as their messages tell them.

#include <filesystem>

#include "conversion.hpp"
#include "gamuts.hpp"
#include "module.hpp"
#include "parameters.hpp"
#include "run/run.hpp"
#include "wire/field_json.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

template <class T>
py::object dict_or_none(const std::optional<T>& value) {
  return python_of(wire::json_of(value));
}

py::dict gamut_dict(const run::Gamut& gamut) {
  std::vector<explore::Evaluated> samples;
  samples.reserve(gamut.patterns.size());
  for (std::size_t i = 0; i < gamut.patterns.size(); ++i)
    samples.push_back({pattern::Pattern(gamut.patterns[i]), gamut.performances[i]});
  py::dict dict;
  add_gamut(dict, samples);
  return dict;
}

py::object model_of(const std::optional<wire::AdoptedModel>& model) {
  if (!model) return py::none();
  py::dict dict = python_of(model->parameters);
  dict["fidelity"] = std::string(to_string(model->fidelity));
  dict["simulations"] = model->simulations;
  dict["before"] = python_of(wire::json_of(model->before));
  dict["after"] = python_of(wire::json_of(model->after));
  return dict;
}

py::dict round_of(int number, const run::RoundRecord& round) {
  py::dict dict;
  dict["round"] = number;
  dict["summary"] = dict_or_none(round.summary);
  dict["model"] = model_of(round.model);
  dict["proposals"] = python_of(wire::json_of(round.proposals));
  dict["diagnosis"] = dict_or_none(round.diagnosis);
  dict["gamut"] = gamut_dict(run::gamut_of(round));
  return dict;
}

py::dict family_of(const run::FamilyRecord& family) {
  py::dict dict = python_of(wire::json_of(family.stated));
  dict["parameters"] = python_of(family.stated.parameters);
  dict["gamut"] = gamut_dict(run::gamut_of(family));
  return dict;
}

py::object number_or_none(const std::optional<double>& value) {
  if (!value) return py::none();
  return py::float_(*value);
}

py::dict specimen_of(const run::MeasuredSpecimen& measured) {
  const measurement::SpecimenRecord& record = measured.record;
  py::dict dict;
  dict["specimen"] = record.specimen;
  dict["design"] = record.design.name();
  dict["test"] = std::string(to_string(record.test));
  dict["round"] = measured.round < 0 ? py::object(py::none()) : py::object(py::int_(measured.round));
  dict["measured_in"] = measured.measured_in;
  dict["orientation_deg"] = record.conditions.orientation_deg;
  dict["strain_rate_per_s"] = record.conditions.strain_rate_per_s;
  dict["thickness_mm"] = record.conditions.thickness_mm;
  dict["batch"] = record.batch;
  dict["modulus_pa"] = number_or_none(record.modulus_pa);
  dict["toughness_pa"] = number_or_none(record.toughness_pa);
  dict["curve"] = python_of(record.curve);
  dict["valid"] = record.valid;
  dict["note"] = record.note;
  return dict;
}

run::RunRecord record_of(const std::filesystem::path& folder) {
  const py::gil_scoped_release released;
  return run::Run(folder).record_with_gamuts();
}

py::dict read_run(const py::object& folder) {
  const std::filesystem::path path = path_from(folder, "run");
  if (!std::filesystem::is_directory(path)) throw InputError::format("{}: no folder of a run", path.string());
  const run::RunRecord record = record_of(path);
  py::list rounds, families, specimens;
  for (const auto& [number, round] : record.rounds) rounds.append(round_of(number, round));
  for (const run::FamilyRecord& family : record.families) families.append(family_of(family));
  for (const run::MeasuredSpecimen& specimen : record.specimens) specimens.append(specimen_of(specimen));
  py::dict run;
  run["rounds"] = rounds;
  run["families"] = families;
  run["specimens"] = specimens;
  return run;
}

constexpr const char* kReadRun = R"(A run, finished or growing: logs/RUN.

run: path of its folder.
Returns a dict:
    rounds: by number; each has round, summary (hypervolumes in GPa MPa, gap, errors; None before its end), model
        (modulus, toughness, extension as params of simulate(); fidelity, simulations, before, after; None before it is
        adopted), proposals (design, modulus_pa, toughness_pa, reason), diagnosis (or None), gamut;
    families: of the stage after the game, each with its parameters, designs and gamut;
    specimens: specimen, design, test, round (None: nobody ordered it), measured_in, conditions, modulus_pa,
        toughness_pa (None: not measured), curve, valid, note.
    A gamut has arrays of equal length: pattern (keys), modulus_pa, toughness_pa, specimens,
    toughness_se_pa (0: unknown), is_on_front.
Raises InputError where run.db cannot be read.)";

}  // namespace

void add_runs(py::module_& module) { module.def("read_run", read_run, py::arg("run"), kReadRun); }

}  // namespace nacre::python
