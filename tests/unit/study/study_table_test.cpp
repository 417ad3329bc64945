#include "study/study_table.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::study {
namespace {

/// A file of its own that does not exist yet.
std::string fresh_file(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / ("study_table_test_" + name + ".csv");
  std::filesystem::remove(path);
  return path.string();
}

std::vector<Wanted> counting(int count, std::atomic<int>& simulated) {
  std::vector<Wanted> wanted;
  for (int i = 0; i < count; ++i)
    wanted.push_back({"case " + std::to_string(i), [i, &simulated]() -> std::vector<double> {
                        ++simulated;
                        return {i / 3.0, -1.0};
                      }});
  return wanted;
}

TEST(StudyTable, WhatIsThereIsNotSimulatedAgain) {
  const std::string file = fresh_file("resumed");
  std::atomic<int> simulated = 0;
  {
    StudyTable table(file, {"a", "b"});
    EXPECT_EQ(fill(table, counting(3, simulated), 60.0, 2), 0);
  }
  StudyTable table(file, {"a", "b"});
  EXPECT_EQ(fill(table, counting(5, simulated), 60.0, 2), 0);
  EXPECT_EQ(simulated, 5);
  ASSERT_TRUE(table.find("case 2"));
  EXPECT_NEAR(table.find("case 2")->front(), 2 / 3.0, 1e-8);
  EXPECT_FALSE(table.find("case 5"));
}

TEST(StudyTable, NothingBeginsAfterTheTimeIsUp) {
  std::atomic<int> simulated = 0;
  StudyTable table(fresh_file("late"), {"a", "b"});
  EXPECT_EQ(fill(table, counting(4, simulated), 0.0, 1), 4);
  EXPECT_EQ(simulated, 0);
}

// A study that was killed while it wrote leaves half a line.
TEST(StudyTable, HalfALineIsCutOff) {
  const std::string file = fresh_file("torn");
  write_file_atomically(file, "key,a,b\nwhole,1,2\nhal");
  {
    StudyTable table(file, {"a", "b"});
    EXPECT_TRUE(table.find("whole"));
    table.add("next", {3.0, 4.0});
  }
  EXPECT_EQ(read_file(file), "key,a,b\nwhole,1,2\nnext,3,4\n");
}

TEST(StudyTable, AnotherStudysTableIsRefused) {
  const std::string file = fresh_file("other");
  write_file_atomically(file, "key,c\nx,1\n");
  EXPECT_THROW(StudyTable(file, {"a", "b"}), InputError);
}

TEST(StudyTable, AFaultyLineIsNamed) {
  const std::string file = fresh_file("faulty");
  write_file_atomically(file, "key,a\nx,1\ny,one\n");
  try {
    StudyTable(file, {"a"});
    FAIL() << "a word was taken for a number";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(file + ":3"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nacre::study
