#include "proposal_agent/selection_work.hpp"

#include "base/expected.hpp"
#include "optimize/pareto.hpp"
#include "proposal_agent/search_work.hpp"
#include "runtime/journal.hpp"
#include "select/select.hpp"

namespace nacre::proposal_agent {
namespace {

Selection selection_from(const std::string& spec) {
  const std::vector<std::string> fields = expected(runtime::unpack(spec));
  Selection selection;
  selection.model = expected(wire::read<wire::AdoptedModel>(fields.at(0)));
  selection.count = std::stoi(fields.at(1));
  selection.simulations = std::stoi(fields.at(2));
  for (std::size_t field = 3; field < fields.size(); ++field) {
    const auto chunk = expected(wire::read<wire::GamutChunk>(fields[field]));
    selection.gamut.insert(selection.gamut.end(), chunk.samples.begin(), chunk.samples.end());
  }
  return selection;
}

std::string work(const std::string& spec) {
  Selection selection = selection_from(spec);
  const std::vector<optimize::Performance> performances = explore::performances_of(selection.gamut);
  wire::Proposal proposal;
  proposal.round = selection.model.round;
  proposal.fidelity = selection.model.fidelity;
  proposal.gamut_hypervolume_staircase = optimize::hypervolume_staircase_gpa_mpa(performances);
  proposal.gamut_hypervolume_polygon = optimize::hypervolume_polygon_gpa_mpa(performances);
  proposal.simulations = selection.simulations;
  for (const select::Selected& each : select::select_with_reserve(std::move(selection.gamut), selection.model.measured,
                                                                  selection.model.benchmark, selection.count)) {
    proposal.designs.push_back({.design = each.pattern,
                                .modulus_pa = each.predicted.modulus_pa,
                                .toughness_pa = each.predicted.toughness_pa,
                                .bin = each.bin,
                                .reason = each.reason});
  }
  return wire::write(proposal);
}

}  // namespace

std::string selection_spec(const Selection& selection) {
  std::vector<std::string> fields = {wire::write(selection.model), std::to_string(selection.count),
                                     std::to_string(selection.simulations)};
  for (const wire::GamutChunk& chunk :
       wire::gamut_chunks(selection.model.round, selection.model.fidelity, selection.gamut))
    fields.push_back(wire::write(chunk));
  return runtime::pack(fields);
}

std::map<std::string, runtime::WorkFunction> work_functions() { return {{"search", search_work}, {"select", work}}; }

}  // namespace nacre::proposal_agent
