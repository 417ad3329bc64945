#include "tester/names.hpp"

#include <array>
#include <utility>

namespace nacre::tester {
namespace {

template <class Value, std::size_t count>
using NamesOf = std::array<std::pair<Value, std::string_view>, count>;

constexpr NamesOf<Fidelity, 3> kFidelities = {
    {{Fidelity::tiny, "tiny"}, {Fidelity::preview, "preview"}, {Fidelity::full, "full"}}};
constexpr NamesOf<TestKind, 3> kTestKinds = {
    {{TestKind::modulus, "modulus"}, {TestKind::toughness, "toughness"}, {TestKind::tensile, "tensile"}}};
constexpr NamesOf<EndReason, 4> kEndReasons = {{{EndReason::stress_drop, "stress_drop"},
                                                {EndReason::strain_limit, "strain_limit"},
                                                {EndReason::no_failure, "no_failure"},
                                                {EndReason::step_limit, "step_limit"}}};
constexpr NamesOf<CriterionKind, 3> kCriteria = {{{CriterionKind::element, "element"},
                                                  {CriterionKind::neighbourhood, "neighbourhood"},
                                                  {CriterionKind::crack_band, "crack_band"}}};

template <class Table, class Value>
std::string_view name_of(const Table& table, Value value) {
  for (const auto& [entry, name] : table)
    if (entry == value) return name;
  return "?";
}

template <class Table>
auto value_of(const Table& table, std::string_view what, std::string_view name) -> Result<decltype(table[0].first)> {
  std::string known;
  for (const auto& [value, entry] : table) {
    if (entry == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(entry);
  }
  return fail("{} '{}': expected one of {}", what, name, known);
}

}  // namespace

std::string_view to_string(Fidelity fidelity) { return name_of(kFidelities, fidelity); }
std::string_view to_string(TestKind kind) { return name_of(kTestKinds, kind); }
std::string_view to_string(EndReason reason) { return name_of(kEndReasons, reason); }
std::string_view to_string(CriterionKind kind) { return name_of(kCriteria, kind); }

Result<Fidelity> fidelity_from_string(std::string_view name) { return value_of(kFidelities, "fidelity", name); }
Result<TestKind> test_kind_from_string(std::string_view name) { return value_of(kTestKinds, "test", name); }
Result<CriterionKind> criterion_from_string(std::string_view name) { return value_of(kCriteria, "criterion", name); }

}  // namespace nacre::tester
