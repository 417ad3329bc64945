#include "diagnosis/modulus_floor.hpp"

#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::diagnosis {
namespace {

std::filesystem::path floor_file(const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "modulus_floor_test.toml";
  write_file_atomically(path, text);
  return path;
}

TEST(ModulusFloor, TheShippedFileHasAFloorForEveryFidelity) {
  for (const auto fidelity : {tester::Fidelity::tiny, tester::Fidelity::preview, tester::Fidelity::full}) {
    const ModulusFloor floor = read_modulus_floor(NACRE_SOURCE_DIR "/data/discretisation_floor.toml", fidelity);
    EXPECT_GT(floor.log_modulus_sd, 0.0);
    EXPECT_GE(floor.mesh_amplitude, 1.0) << "the limit lies beyond the first halving";
    EXPECT_LT(floor.mesh_remainder_sd, floor.log_modulus_sd);
  }
}

TEST(ModulusFloor, WithoutACommonDirectionAllOfItIsIndependent) {
  const ModulusFloor floor = read_modulus_floor(floor_file("[full]\nlog_modulus_sd = 0.006\n"), tester::Fidelity::full);
  EXPECT_EQ(floor.mesh_amplitude, 0.0);
  EXPECT_EQ(floor.mesh_remainder_sd, 0.006);
}

TEST(ModulusFloor, WhatIsNoNumberIsNamed) {
  const auto file = floor_file("[full]\nlog_modulus_sd = -1\n");
  try {
    read_modulus_floor(file, tester::Fidelity::full);
    FAIL() << "a negative deviation was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("[full] log_modulus_sd"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nacre::diagnosis
