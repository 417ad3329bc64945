#include "tester/names.hpp"

#include "base/name_table.hpp"

namespace nacre::tester {
namespace {

constexpr NameTable<Fidelity, 4> kFidelities = {
    {{Fidelity::tiny, "tiny"}, {Fidelity::preview, "preview"}, {Fidelity::full, "full"}, {Fidelity::fine, "fine"}}};
constexpr NameTable<TestKind, 3> kTestKinds = {
    {{TestKind::modulus, "modulus"}, {TestKind::toughness, "toughness"}, {TestKind::tensile, "tensile"}}};
constexpr NameTable<EndReason, 4> kEndReasons = {{{EndReason::stress_drop, "stress_drop"},
                                                  {EndReason::strain_limit, "strain_limit"},
                                                  {EndReason::no_failure, "no_failure"},
                                                  {EndReason::step_limit, "step_limit"}}};

}  // namespace

std::string_view to_string(Fidelity fidelity) { return name_in(kFidelities, fidelity); }
std::string_view to_string(TestKind kind) { return name_in(kTestKinds, kind); }
std::string_view to_string(EndReason reason) { return name_in(kEndReasons, reason); }

Result<Fidelity> fidelity_from_string(std::string_view name) { return value_in(kFidelities, "fidelity", name); }
Result<TestKind> test_kind_from_string(std::string_view name) { return value_in(kTestKinds, "test", name); }

}  // namespace nacre::tester
