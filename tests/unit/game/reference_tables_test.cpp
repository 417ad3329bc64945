#include "game/reference_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/result.hpp"

namespace nacre::game {
namespace {

using testing::HasSubstr;

std::filesystem::path table(const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
  std::ofstream(path) << text;
  return path;
}

std::string message_of(const std::string& text) {
  try {
    read_base_materials(table(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReferenceTables, TableOfTheThesisGivesTheThreeBaseMaterials) {
  const auto materials = read_base_materials(std::string(NACRE_SOURCE_DIR) + "/data/thesis/base_materials.csv");
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_EQ(materials[0].design.name(), "soft");
  EXPECT_EQ(materials[1].design.name(), "rigid");
  EXPECT_EQ(materials[2].design.name(), "interface");
  EXPECT_NEAR(materials[1].modulus_pa, 2.6613e9, 1.0);
  EXPECT_NEAR(materials[0].toughness_pa, 0.054335e6, 1e-3);
}

TEST(ReferenceTables, BenchmarkOfTheThesisRisesInModulus) {
  const auto line = read_benchmark_line(std::string(NACRE_SOURCE_DIR) + "/data/thesis/homogeneous_benchmark.csv");
  ASSERT_EQ(line.size(), 11u);
  for (std::size_t point = 1; point < line.size(); ++point)
    EXPECT_GE(line[point].modulus_pa, line[point - 1].modulus_pa);
}

TEST(ReferenceTables, ErrorsNameFileLineAndColumn) {
  const std::string header = "material,measured_modulus_gpa,measured_toughness_mpa\n";
  EXPECT_THAT(message_of(header + "TB,0.001,0.05\nVW,stiff,0.07\nIF,0.5,0.8\n"),
              testing::AllOf(HasSubstr("ErrorsNameFileLineAndColumn.csv:3"), HasSubstr("measured_modulus_gpa"),
                             HasSubstr("'stiff'")));
  EXPECT_THAT(message_of(header + "TB,0.001,0.05\nVW,2.6,nan\nIF,0.5,0.8\n"), HasSubstr("expected a positive number"));
  EXPECT_THAT(message_of(header + "TB,0.001,0.05\nVW,2.6,0.07\n"), HasSubstr("IF"));
  EXPECT_THAT(message_of(header + "TB,0.001,0.05\nTB,0.001,0.05\n"), HasSubstr("second time"));
  EXPECT_THAT(message_of(header + "TB,0.001\n"), HasSubstr("missing"));
  EXPECT_THAT(message_of("material,measured_modulus_gpa\nTB,1\n"), HasSubstr("measured_toughness_mpa"));
  EXPECT_THAT(message_of(""), HasSubstr("no rows"));
}

}  // namespace
}  // namespace nacre::game
