#include "sysid/prediction_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::sysid {
namespace {

std::filesystem::path fresh_file(const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / ("prediction_store_" + name + ".bin");
  std::filesystem::remove(file);
  return file;
}

Prediction fracture(double toughness_pa) {
  Prediction prediction;
  prediction.toughness_pa = toughness_pa;
  for (int i = 0; i < 500; ++i) {
    prediction.curve.strain.push_back(0.1 * i / 499);
    prediction.curve.stress_pa.push_back(1e6 * i);
  }
  return prediction;
}

TEST(PredictionStore, GivesTheSamePredictionFromTheFileAsWhenItWasPutIn) {
  const auto file = fresh_file("same");
  Prediction put;
  {
    PredictionStore store(file);
    put = store.put("T/a", fracture(3.14159e5));
    EXPECT_EQ(put.toughness_pa, 3.14159e5);
    EXPECT_LE(put.curve.size(), 128u);
    Prediction modulus;
    modulus.modulus_pa = 1.0 / 3.0;
    store.put("E/a", modulus);
    store.put("T/failed", {});
  }
  const PredictionStore again(file);
  EXPECT_EQ(again.size(), 3u);
  ASSERT_NE(again.find("T/a"), nullptr);
  EXPECT_EQ(again.find("T/a")->toughness_pa, put.toughness_pa);
  EXPECT_EQ(again.find("T/a")->curve, put.curve);
  EXPECT_EQ(again.find("E/a")->modulus_pa, 1.0 / 3.0);
  EXPECT_FALSE(again.find("T/failed")->toughness_pa.has_value());
  EXPECT_EQ(again.find("unknown"), nullptr);
}

TEST(PredictionStore, ARecordCutOffByACrashIsDroppedAndTheRestKept) {
  const auto file = fresh_file("cut");
  {
    PredictionStore store(file);
    store.put("a", fracture(1e5));
    store.put("b", fracture(2e5));
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 10);
  {
    PredictionStore store(file);
    EXPECT_EQ(store.size(), 1u);
    store.put("c", fracture(3e5));
  }
  const PredictionStore again(file);
  EXPECT_EQ(again.size(), 2u);
  EXPECT_EQ(again.find("c")->toughness_pa, 3e5);
}

TEST(PredictionStore, AFileWhoseFirstLineWasCutOffStartsAnew) {
  for (const char* left : {"", "nacre pred"}) {
    const auto file = fresh_file("begun");
    write_file_atomically(file, left);
    PredictionStore(file).put("a", fracture(1e5));
    EXPECT_EQ(PredictionStore(file).size(), 1u) << left;
  }
}

TEST(PredictionStore, RefusesAFileOfSomethingElse) {
  const auto file = fresh_file("other");
  write_file_atomically(file, "measurements");
  EXPECT_THROW(PredictionStore{file}, InputError);
}

}  // namespace
}  // namespace nacre::sysid
