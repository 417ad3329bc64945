#include "pattern/design.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"

namespace nacre::pattern {
namespace {

using ::testing::HasSubstr;

TEST(Design, CanonicalNamesReadBackAsThemselves) {
  for (const std::string name : {"soft", "interface", "rigid", "mix:0.65", "mix:0.1", "577fffe9fffdef",
                                 "L80000000000000000000000000000000000000000000000000"
                                 "00000000000000000000000000000000000000000000000000"}) {
    const Result<Design> design = design_from_name(name);
    ASSERT_TRUE(design) << design.error().message;
    EXPECT_EQ(design->name(), name);
  }
}

TEST(Design, MixturesAtTheEndsAndTheMiddleAreTheBaseMaterials) {
  EXPECT_EQ(design_from_name("mix:0").value(), design_from_name("soft").value());
  EXPECT_EQ(design_from_name("mix:0.50").value(), design_from_name("interface").value());
  EXPECT_EQ(design_from_name("mix:1.0").value(), design_from_name("rigid").value());
  EXPECT_EQ(design_from_name("mix:-0").value().name(), "soft");
}

TEST(Design, RigidFractionIsThatOfTheLayoutOrTheMixture) {
  EXPECT_DOUBLE_EQ(design_from_name("mix:0.65").value().rigid_fraction(), 0.65);
  EXPECT_DOUBLE_EQ(design_from_name("7fffffffffffff").value().rigid_fraction(), 1.0);
}

TEST(Design, BadNamesSayWhatWasExpected) {
  for (const std::string name : {"mix:1.1", "mix:-0.1", "mix:nan", "mix:inf", "mix:", "mix:0.5x", "mix: 0.5"}) {
    const auto design = design_from_name(name);
    ASSERT_FALSE(design) << name;
    EXPECT_THAT(design.error().message, HasSubstr("expected mix:F with a rigid fraction F from 0 to 1"));
  }
  EXPECT_THAT(design_from_name("steel").error().message, HasSubstr("soft, interface, rigid or mix:F"));
  EXPECT_THAT(design_from_name("57ZZZZZZZZZZZZ").error().message, HasSubstr("lower-case hex digit"));
}

TEST(DesignArgument, IsANameOrAFile) {
  const std::string path = std::string(NACRE_SOURCE_DIR) + "/data/patterns/published_b.txt";
  EXPECT_EQ(design_from_argument(path).name(), "3ffc9b4ad4d2d9");
  EXPECT_EQ(design_from_argument("mix:0.7").name(), "mix:0.7");
}

TEST(DesignArgument, ErrorsNameThePlace) {
  const auto message = [](const std::string& argument) -> std::string {
    try {
      design_from_argument(argument);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message("no/such/file.txt"), HasSubstr("nor is there a file of that name"));
  EXPECT_THAT(message(::testing::TempDir()), HasSubstr("is a folder"));
  const std::string bad = ::testing::TempDir() + "/nacre_bad_pattern.txt";
  write_file_atomically(bad, "01012\n");
  EXPECT_THAT(message(bad), HasSubstr(bad + ": line 1, column 5: '2', expected 20 lines of 20 characters"));
  std::filesystem::remove(bad);
}

}  // namespace
}  // namespace nacre::pattern
