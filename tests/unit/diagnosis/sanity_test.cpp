#include "diagnosis/sanity.hpp"

#include <gtest/gtest.h>

namespace nacre::diagnosis {
namespace {

std::vector<measurement::SpecimenRecord> moduli_of_one_design(const std::vector<double>& moduli_pa) {
  std::vector<measurement::SpecimenRecord> specimens;
  for (const double modulus_pa : moduli_pa) {
    measurement::SpecimenRecord record;
    record.specimen = std::to_string(specimens.size());
    record.design = *pattern::design_from_name("577fffe9fffdef");
    record.modulus_pa = modulus_pa;
    specimens.push_back(record);
  }
  return specimens;
}

TEST(GroupsOutOfLine, AValueMistypedByHalfIsSeenAmongThreeAndAmongFour) {
  const std::vector<std::string> expected = {"modulus of 577fffe9fffdef"};
  EXPECT_EQ(groups_out_of_line(moduli_of_one_design({5e8, 5.1e8, 7.6e8})), expected);
  EXPECT_EQ(groups_out_of_line(moduli_of_one_design({5e8, 5.1e8, 7.6e8, 5.05e8})), expected);
}

TEST(GroupsOutOfLine, ReplicatesThatScatterAsPrintedOnesDoAreInLine) {
  EXPECT_TRUE(groups_out_of_line(moduli_of_one_design({5e8, 5.1e8, 4.9e8})).empty());
  EXPECT_TRUE(groups_out_of_line(moduli_of_one_design({5e8})).empty());
}

}  // namespace
}  // namespace nacre::diagnosis
