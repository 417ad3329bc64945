// Golden games: every node still sends what it sent when the game was written down, to the last bit.

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "base/result.hpp"
#include "golden_game.hpp"
#include "program.hpp"
#include "reword.hpp"
#include "transcript.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

const fs::path kGames = fs::path(NACRE_SOURCE_DIR) / "tests/replay/games";

nlohmann::json replayed(const fs::path& run, const std::string& node) {
  const Outcome replay = run_nacre({"replay", run.string(), "--node", node, "--json"});
  const auto report = nlohmann::json::parse(replay.out, nullptr, false);
  if (report.is_discarded()) return {{"equal", false}, {"difference", replay.err}};
  return report;
}

class GoldenGame : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { run_ = fresh_folder(GetParam()); }
  static fs::path game() { return kGames / GetParam(); }
  fs::path run_;
};

TEST_P(GoldenGame, ReadsAsItsTranscript) {
  golden::unpack_golden_game(game(), run_);
  const std::vector<std::string> transcript = golden::read_transcript(game());
  EXPECT_GT(transcript.size(), 100U);
  EXPECT_EQ(golden::difference(transcript, golden::recorded_lines(run_)), "") << "game.jsonl is another game";
  EXPECT_EQ(golden::difference(transcript, golden::lines_of_now(run_, fresh_folder("now"))), "")
      << "If this change is meant, record the games again: tests/replay/README.md.";
}

/// Exact where the transcript is rounded.
TEST_P(GoldenGame, IsSentAgainByEveryNode) {
  golden::unpack_golden_game(game(), run_);
  const std::vector<std::string> nodes = golden::nodes_of(run_);
  EXPECT_THAT(nodes, IsSupersetOf({"validation_agent", "proposal_agent", "analyser"}));
  for (const std::string& node : nodes) {
    const auto report = replayed(run_, node);
    EXPECT_TRUE(report["equal"]) << node << ": " << report["difference"].get<std::string>()
                                 << "\nIf this change is meant, record the games again: tests/replay/README.md.";
    EXPECT_GT(report["inputs"], 2) << node;
    EXPECT_GT(report["outputs"].get<int>() + report["computes"].get<int>(), 2) << node;
    EXPECT_EQ(report["unfinished"], 0) << node;
  }
}

/// The first number behind `key` in a line, made another one.
std::string with_another(const std::string& line, const std::string& key) {
  const std::regex number("(\"" + key + "\":)(-?[0-9.e+-]+)");
  std::smatch found;
  if (!std::regex_search(line, found, number)) throw InputError("no " + key + " in " + line);
  return found.prefix().str() + found[1].str() + fmt::format("{}", 1.5 * std::stod(found[2].str()) + 1.0) +
         found.suffix().str();
}

/// A golden game's lines with one changed: the first that contains `mark`.
void alter(const fs::path& file, const std::string& mark, const std::string& key) {
  std::istringstream lines(read_file(file));
  std::string altered;
  bool is_altered = false;
  for (std::string line; std::getline(lines, line);) {
    const bool meant = !is_altered && line.find(mark) != std::string::npos;
    altered += (meant ? with_another(line, key) : line) + "\n";
    is_altered = is_altered || meant;
  }
  ASSERT_TRUE(is_altered) << mark;
  write_file_atomically(file, altered);
}

struct Alteration {
  std::string line;   // a part of the line that is changed
  std::string key;    // its member
  std::string node;   // who sends it
  std::string where;  // how the difference is named
};

TEST_P(GoldenGame, WithAnAlteredFieldIsNoticedAndTheFieldNamed) {
  const Alteration alterations[] = {
      {R"("on":"ROUND")", "signed_gap", "validation_agent", "~out/ROUND): recorded against now: signed_gap: "},
      {R"("on":"GAMUT")", "round", "proposal_agent", "~out/GAMUT): recorded against now: round: "},
      {R"("on":"SIMULATED")", "modulus_pa", "simulator_farm", "modulus_pa: "},
      {R"("is":{"request_id":"simulator_farm/question")", "thickness_mm", "simulator_farm",
       "spec differs: conditions.thickness_mm: "}};
  golden::unpack_golden_game(game(), run_);
  for (const Alteration& alteration : alterations) {
    if (!fs::exists(run_ / "nodes" / alteration.node)) continue;
    const fs::path copy = fresh_folder("altered"), run = fresh_folder("altered_run");
    fs::copy(game(), copy, fs::copy_options::recursive);
    alter(copy / "game.jsonl", alteration.line, alteration.key);
    golden::unpack_golden_game(copy, run);
    const auto report = replayed(run, alteration.node);
    EXPECT_FALSE(report["equal"]) << alteration.line;
    EXPECT_THAT(report["difference"].get<std::string>(), HasSubstr(alteration.where));
  }
}

TEST_P(GoldenGame, WithAnAlteredFieldShowsTheLineInItsTranscript) {
  const fs::path copy = fresh_folder("altered");
  fs::copy(game(), copy, fs::copy_options::recursive);
  alter(copy / "game.jsonl", R"("on":"ROUND")", "signed_gap");
  golden::unpack_golden_game(copy, run_);
  const std::string shown =
      golden::difference(golden::recorded_lines(run_), golden::lines_of_now(run_, fresh_folder("now")));
  EXPECT_THAT(shown, HasSubstr("\n- validation_agent says ROUND "));
  EXPECT_THAT(shown, HasSubstr("\n+ validation_agent says ROUND "));
  EXPECT_THAT(shown, Not(HasSubstr(" hears ROUND "))) << "what others hear is recorded";
}

TEST(Transcript, SaysWhatWasAndWhatIsBehindTheLineBefore) {
  EXPECT_EQ(golden::difference({"a", "b", "c"}, {"a", "b", "c"}), "");
  EXPECT_EQ(golden::difference({"a", "b", "c"}, {"a", "x", "c", "d"}), "  a\n- b\n+ x\n  c\n+ d\n");
  EXPECT_EQ(golden::difference({"a", "b"}, {}, 1), "  the beginning\n- a\nand 1 lines more\n");
}

TEST_P(GoldenGame, WrittenDownAgainIsTheSameText) {
  golden::unpack_golden_game(game(), run_);
  const fs::path again = fresh_folder("again");
  golden::write_golden_game(run_, again);
  EXPECT_TRUE(read_file(again / "game.jsonl") == read_file(game() / "game.jsonl"));
}

void replace_once(const fs::path& file, const std::string& before, const std::string& now) {
  std::string text = read_file(file);
  const std::size_t place = text.find(before);
  ASSERT_NE(place, std::string::npos) << before;
  write_file_atomically(file, text.replace(place, before.size(), now));
}

/// What refuses the rewording of a game in this folder; empty when nothing does.
std::string refusal_of(const fs::path& folder) {
  try {
    golden::reword_golden_game(folder, fresh_folder("rewording"));
    return "";
  } catch (const InputError& refusal) {
    return refusal.what();
  }
}

TEST_P(GoldenGame, RewordedHasTheSentencesOfNowWhereverTheMessageStands) {
  const fs::path copy = fresh_folder("reworded");
  fs::copy(game(), copy, fs::copy_options::recursive);
  replace_once(copy / "game.jsonl", "nothing has been measured yet", "an older sentence");
  replace_once(copy / "game.jsonl", R"("reason":"near )", R"("reason":"as before, near )");
  const golden::Rewording rewording = golden::reword_golden_game(copy, run_);
  EXPECT_EQ(rewording.fields.at("round_summary_t.decided_by").changed, 1);
  EXPECT_EQ(rewording.fields.at("proposal_t.designs[].reason").changed, 1);
  EXPECT_EQ(rewording.ids, 0) << "those in the text are of the sentences of now";
  EXPECT_TRUE(read_file(copy / "game.jsonl") == read_file(game() / "game.jsonl"));
}

TEST_P(GoldenGame, RewordingRefusesAnotherNumber) {
  const Alteration alterations[] = {
      {R"("on":"ROUND")", "signed_gap", "validation_agent", "~out/ROUND): signed_gap: "},
      {R"("on":"PROPOSAL")", "simulations", "proposal_agent", "simulations: "},
      // The validation agent receives it first, and waits for the right round.
      {R"("on":"GAMUT")", "round", "proposal_agent", "the core does not send this any more"}};
  for (const Alteration& alteration : alterations) {
    const fs::path copy = fresh_folder("altered");
    fs::copy(game(), copy, fs::copy_options::recursive);
    alter(copy / "game.jsonl", alteration.line, alteration.key);
    const std::string altered = read_file(copy / "game.jsonl");
    EXPECT_THAT(refusal_of(copy), HasSubstr(alteration.where)) << alteration.line;
    EXPECT_TRUE(read_file(copy / "game.jsonl") == altered) << "left as it was";
  }
}

TEST_P(GoldenGame, RewordingRefusesAMissingMessageAndASentenceThatIsNone) {
  const fs::path copy = fresh_folder("altered");
  fs::copy(game(), copy, fs::copy_options::recursive);
  replace_once(copy / "game.jsonl", "nothing has been measured yet", "");
  EXPECT_THAT(refusal_of(copy), HasSubstr("decided_by: \"\" against \"...\""));
  const std::string text = read_file(game() / "game.jsonl");
  const std::size_t begin = text.find(R"({"node":"validation_agent","says":"ROUND")"), end = text.find('\n', begin) + 1;
  write_file_atomically(copy / "game.jsonl", text.substr(0, begin) + text.substr(end));
  EXPECT_THAT(refusal_of(copy), HasSubstr("the core sends ROUND instead"));
}

INSTANTIATE_TEST_SUITE_P(Games, GoldenGame, testing::Values("laboratory", "person"),
                         [](const auto& game) { return std::string(game.param); });

}  // namespace
}  // namespace nacre
