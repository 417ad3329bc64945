#include "diagnosis/procedure.hpp"

#include <gtest/gtest.h>

#include "diagnosis/procedure_fields.hpp"
#include "diagnosis/settings.hpp"

namespace nacre::diagnosis {
namespace {

/// Adds one to the number at `place` of a procedure, counted through all its tables; `name` says which it was.
struct NumberChange {
  int place = 0, at = 0;
  std::string name = {};
  void operator()(std::string_view field, auto& value) {
    if constexpr (HasFields<std::remove_cvref_t<decltype(value)>>) {
      walk_fields(*this, value);
    } else if constexpr (requires { value.begin(); }) {
      for (auto& each : value) change(field, each);
    } else {
      change(field, value);
    }
  }
  void change(std::string_view field, auto& number) {
    if (at++ == place) name = field, number += 1;
  }
};

TEST(Procedure, EveryNumberIsInTheHash) {
  DiagnosisSettings settings;
  NumberChange all{.place = -1};
  walk_fields(all, settings.procedure);
  ASSERT_GT(all.at, 100);
  const std::string hash = procedure_hash(settings);
  for (int place = 0; place < all.at; ++place) {
    DiagnosisSettings changed;
    NumberChange change{.place = place};
    walk_fields(change, changed.procedure);
    EXPECT_NE(procedure_hash(changed), hash) << change.name;
  }
}

// What the data are, and where a search begins, is no part of the procedure.
TEST(Procedure, TheSeedAndTheInitialGuessAreNotInTheHash) {
  DiagnosisSettings settings;
  const std::string hash = procedure_hash(settings);
  settings.seed = 7;
  settings.search_budget = 3;
  settings.start.modulus.e_vw_pa *= 1.1;
  EXPECT_EQ(procedure_hash(settings), hash);
  settings.bootstraps += 1;
  EXPECT_NE(procedure_hash(settings), hash) << "the chances are resolved otherwise";
}

}  // namespace
}  // namespace nacre::diagnosis
