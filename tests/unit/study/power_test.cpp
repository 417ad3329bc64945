#include "blind_trials/power.hpp"

#include <gtest/gtest.h>

namespace nacre::blind_trials {
namespace {

Score score_at(const std::string& kind, const std::string& effect, double snr, const std::string& verdict) {
  Score score{.trial = {.name = {}, .kind = kind, .seed = 1, .large = true, .noisy = false, .hidden = {effect}},
              .diagnosis = {.commit = {}, .verdict = verdict, .hidden = {{.size = 1.0, .snr = snr}}}};
  score.right_name = verdict == "named";
  return score;
}

const std::vector<Score> kScores = {
    score_at("power", "droplet_mixing", 3.0, "base_sufficient"),
    score_at("power", "droplet_mixing", 3.1, "unexplained"),
    score_at("effect", "droplet_mixing", 12.0, "named"),
    score_at("power", "plane_strain", 3.0, "named"),
    score_at("effect", "plane_strain", 40.0, "named"),
    score_at("outside", "edge_layer", 12.0, "unexplained"),
};

TEST(Power, CountsNamedAndNoticedByEffectAndSignal) {
  const std::string table = power_table(kScores);
  EXPECT_NE(table.find("| droplet_mixing | 0, 1, 2 | | | | 1, 1, 1 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| plane_strain | 1, 1, 1 | | | | |"), std::string::npos) << "40 is no faint signal\n" << table;
  EXPECT_NE(table.find("| all effects | 1, 2, 3 |"), std::string::npos) << table;
  EXPECT_EQ(table.find("edge_layer"), std::string::npos) << "no known effect";
}

TEST(Power, IsDrawnBesideItsLimit) {
  const std::string figure = power_figure(kScores);
  EXPECT_NE(figure.find("likelihood-ratio test"), std::string::npos);
  EXPECT_NE(figure.find("droplet_mixing"), std::string::npos);
  EXPECT_EQ(power_figure({}).find("all, named"), std::string::npos);
}

}  // namespace
}  // namespace nacre::blind_trials
