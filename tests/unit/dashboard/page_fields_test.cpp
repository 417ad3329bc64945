#include "dashboard/page_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "dashboard/laboratory_view.hpp"
#include "dashboard/nodes_view.hpp"

namespace nacre::dashboard {
namespace {

using testing::HasSubstr;

TEST(PageFields, TheKeptTypesAreThoseOfTheTables) {
  EXPECT_EQ(read_file(NACRE_SOURCE_DIR "/web/src/page_types.ts"), page_types())
      << "cmake --build build --target page_types writes them anew";
}

TEST(PageFields, AFieldHasTheSameNameInJsonAndInItsType) {
  PageTypes types;
  EXPECT_EQ(types.type_of<NodeRow>(), "NodeState");
  const Json json = wire::json_of(NodeRow{});
  for (const auto& [name, value] : json.items()) EXPECT_THAT(types.text(), HasSubstr("  " + name + ": "));
  EXPECT_THAT(types.text(), HasSubstr("state: \"starting\" | \"running\" | \"finished\" | \"ended\" | \"silent\";"));
  EXPECT_THAT(types.text(), HasSubstr("progress: number | null;"));
}

TEST(PageFields, WhatIsAbsentIsNull) {
  const Json group = wire::json_of(GroupRow{});
  EXPECT_TRUE(group["mean_pa"].is_null());
  EXPECT_EQ(group["test"], "modulus");
  EXPECT_EQ(group["thickness_mm"], 3.2);
  EXPECT_TRUE(wire::json_of(sysid::PredictionErrors{}).is_null()) << "nothing was compared";
  EXPECT_EQ(wire::json_of(sysid::PredictionErrors{.modulus_count = 2})["n_modulus"], 2);
  EXPECT_EQ(PageTypes().type_of<std::vector<std::optional<int>>>(), "(number | null)[]");
}

}  // namespace
}  // namespace nacre::dashboard
