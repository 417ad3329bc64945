// Part of the conversions (convert.hpp): DIAGNOSE and DIAGNOSIS.

#include <algorithm>

#include "wire/checks.hpp"
#include "wire/convert.hpp"

namespace nacre::wire {
namespace {

/// Any name will do: the validation agent reports an effect that it does not know, and the game goes on.
Result<void> check(const effect_t& effect) {
  return all_of(expect_name("effect", effect.name), expect_finite("parameter", effect.parameter),
                expect_finite("interval_low", effect.interval_low),
                expect_finite("interval_high", effect.interval_high));
}

Result<void> check(const candidate_t& candidate) {
  constexpr std::string_view statuses[] = {"in_set", "excluded", "invisible", "not_applicable"};
  if (std::ranges::find(statuses, candidate.status) == std::end(statuses)) {
    return fail("status \"{}\", expected in_set, excluded, invisible or not_applicable", candidate.status);
  }
  constexpr double kRounding = 1e-6;  // a difference of two norms
  return all_of(expect_name("candidate", candidate.name), expect_finite("statistic", candidate.statistic),
                expect_range("p_family_wise", candidate.p_family_wise, 0.0, 1.0),
                expect_range("absorption", candidate.absorption, -kRounding, 1.0 + kRounding));
}

Result<void> check_gain(const diagnosis_t& message) {
  if (message.has_gain == 0) return {};
  return all_of(expect_finite("held_out_error_before", message.held_out_error_before),
                expect_finite("held_out_error_after", message.held_out_error_after),
                expect_finite("relative_reduction", message.relative_reduction),
                expect_finite("reduction_low", message.reduction_low),
                expect_finite("reduction_high", message.reduction_high));
}

Result<void> check(const next_experiment_t& next) {
  if (const auto design = pattern::design_from_name(next.design); !design) return tl::unexpected(design.error());
  if (const auto test = test_kind_from_wire(next.test); !test) return tl::unexpected(test.error());
  if (const auto conditions = from_wire(next.conditions); !conditions) return tl::unexpected(conditions.error());
  if (const auto loading = tester::loading_from_string(next.loading); !loading) return tl::unexpected(loading.error());
  return expect_range("replicates", next.replicates, 1, 1000);
}

/// The first fault among the parts of a diagnosis.
template <class Part>
Result<void> check_all(const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    if (const Result<void> sound = check(part); !sound) return in_type("diagnosis_t", sound.error());
  }
  return {};
}

}  // namespace

diagnose_request_t to_wire(const DiagnoseRequest& request) {
  diagnose_request_t message{};
  message.round = request.round;
  message.fidelity = to_wire(request.fidelity);
  message.parameters = to_wire(request.parameters);
  message.specimens = request.specimens;
  return message;
}

Result<DiagnoseRequest> from_wire(const diagnose_request_t& message) {
  constexpr std::string_view type = "diagnose_request_t";
  if (const Result<void> sound = expect_round(message.round); !sound) return in_type(type, sound.error());
  const Result<tester::Fidelity> fidelity = fidelity_from_wire(message.fidelity);
  if (!fidelity) return in_type(type, fidelity.error());
  const Result<material::ParameterSet> parameters = from_wire(message.parameters);
  if (!parameters) return in_type(type, parameters.error());
  if (!std::ranges::is_sorted(message.specimens)) return fail("{}: specimens are not sorted", type);
  return DiagnoseRequest{message.round, *fidelity, *parameters, message.specimens};
}

Result<void> validate(const diagnosis_t& message) {
  constexpr std::string_view verdicts[] = {"base_sufficient", "named", "ambiguous", "unexplained"};
  if (std::ranges::find(verdicts, message.verdict) == std::end(verdicts)) {
    return fail("diagnosis_t: verdict \"{}\", expected base_sufficient, named, ambiguous or unexplained",
                message.verdict);
  }
  return all_of(expect_round(message.round), check_all(message.effects), check_all(message.candidates),
                check_gain(message), check_all(message.next_experiments));
}

}  // namespace nacre::wire
