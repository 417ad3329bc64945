#include "film/film.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "film/film_file.hpp"
#include "material/parameters.hpp"
#include "tester/film_strains.hpp"

namespace nacre::film {
namespace {

using testing::HasSubstr;

const tester::Simulation& simulation() {
  static const tester::Simulation instance{
      pattern::Pattern(0x577fffe9fffdef), material::thesis_parameters(), {}, tester::Fidelity::tiny};
  return instance;
}

const tester::ToughnessResult& filmed() {
  static const auto result = tester::test_toughness(simulation(), {.frame_count = 12}).value();
  return result;
}

const Film& sample() {
  static const Film film = film_of(simulation(), filmed());
  return film;
}

TEST(Film, ComesBackFromItsBytes) {
  const Result<Film> again = decode(encode(sample()));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, sample());
}

TEST(Film, EqualTestsGiveEqualBytes) {
  EXPECT_EQ(encode(film_of(simulation(), filmed())), encode(sample()));
  EXPECT_EQ(encode(record_film(simulation(), filmed(), 12).value()), encode(sample())) << "one pull or two";
}

TEST(Film, EnergiesAreRightToALevelWhereTheyAreInTheScale) {
  const double step = std::pow(10.0, kEnergyDecades / (kEnergyLevels - 1));
  int seen = 0;
  for (std::size_t i = 0; i < sample().frames.size(); ++i)
    for (std::size_t e = 0; e < 1600; ++e) {
      const double exact = filmed().frames[i].energy_j_per_m3[e];
      if (exact < sample().energy_j_per_m3(2)) continue;
      ++seen;
      const double shown = sample().energy_j_per_m3(sample().frames[i].energy_level[e]);
      ASSERT_LT(std::abs(std::log(shown / exact)), std::log(step) * 0.76);
    }
  EXPECT_GT(seen, 3000);
}

TEST(Film, DisplacementsAreRightToAStepWhereMaterialStands) {
  const double step_m = kDisplacementStep * sample().element_size_m * 1.01;
  const auto& exact = filmed().frames.back();
  const FilmFrame& frame = sample().frames.back();
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) {
      if (exact.material[row * 40 + column] == 3) continue;
      const int node = row * 41 + column;
      ASSERT_NEAR(sample().displacement_x_m(frame, node), exact.displacement_m[2 * static_cast<std::size_t>(node)],
                  step_m);
      ASSERT_NEAR(sample().displacement_y_m(frame, node), exact.displacement_m[2 * static_cast<std::size_t>(node) + 1],
                  step_m);
    }
}

TEST(Film, FailedElementsAreThoseOfTheFrame) {
  for (std::size_t i = 0; i < sample().frames.size(); ++i) {
    std::vector<std::uint8_t> state = sample().material;
    for (int k = 0; k < sample().frames[i].broken; ++k) state[sample().crack.order[k].element] = 3;
    EXPECT_EQ(state, filmed().frames[i].material) << "frame " << i;
  }
  EXPECT_GT(sample().frames.back().broken, 10);
}

TEST(Film, IsSmall) {
  // 12 frames of 1600 energies and 3362 displacements, 9 bytes each without quantisation and compression.
  EXPECT_LT(encode(sample()).size(), 30'000u);
}

TEST(Film, DamageIsNamed) {
  const std::string bytes = encode(sample());
  EXPECT_THAT(decode("GIF89a and more of it").error().message, HasSubstr("NACREFLM"));
  std::string version = bytes;
  version[8] = 9;
  EXPECT_THAT(decode(version).error().message, HasSubstr("version 9"));
  EXPECT_THAT(decode(bytes.substr(0, 40)).error().message, HasSubstr("cut off"));
  EXPECT_THAT(decode(bytes.substr(0, bytes.size() - 20)).error().message, HasSubstr("displacement"));
  std::string flipped = bytes;
  flipped[bytes.size() - 40] = static_cast<char>(flipped[bytes.size() - 40] ^ 0x55);
  EXPECT_FALSE(decode(flipped)) << "zlib's checksum";
  const std::size_t at = bytes.find("\"columns\":40");
  std::string columns = bytes;
  columns.replace(at, 12, "\"columns\":-1");
  EXPECT_THAT(decode(columns).error().message, HasSubstr("columns: -1, expected"));
}

// The crack is drawn along these elements.
TEST(Film, BreaksThatCannotBeAreRefused) {
  Film film = sample();
  film.crack.order[1] = film.crack.order[0];
  EXPECT_THAT(decode(encode(film)).error().message, HasSubstr("fails twice"));
  film = sample();
  const auto empty = std::find(film.material.begin(), film.material.end(), 3) - film.material.begin();
  film.crack.order[0].element = static_cast<int>(empty);
  EXPECT_THAT(decode(encode(film)).error().message, HasSubstr("is empty and cannot fail"));
}

TEST(Film, NumbersThatNoTestHasAreRefused) {
  Film film = sample();
  film.failure_strain = 1e307;
  EXPECT_THAT(decode(encode(film)).error().message, HasSubstr("a failure strain of 1e+307, expected 0 to 100"));
  film = sample();
  film.curve.stress_pa.back() = 1e300;
  EXPECT_THAT(decode(encode(film)).error().message, HasSubstr("1e+300 Pa"));
}

TEST(Film, AnotherScaleOfEnergiesIsRefused) {
  std::string bytes = encode(sample());
  const std::size_t at = bytes.find("\"decades\":") + 10;
  bytes[at] = bytes[at] == '9' ? '8' : '9';
  EXPECT_THAT(decode(bytes).error().message, HasSubstr("energies over"));
}

TEST(Film, NoBytesMakeTheReaderFail) {
  const std::string bytes = encode(sample());
  for (std::size_t i = 0; i < bytes.size(); i += 1 + i / 40) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] + 1);
    (void)decode(damaged);  // an error or a film, never a crash
    (void)decode(bytes.substr(0, i));
  }
}

}  // namespace
}  // namespace nacre::film
