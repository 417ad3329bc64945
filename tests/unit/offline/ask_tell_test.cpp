#include "offline/ask_tell.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/files.hpp"
#include "base/result.hpp"
#include "tester/expected_toughness.hpp"

namespace nacre::offline {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using ::testing::HasSubstr;

const std::string kPublishedA = "577fffe9fffdef";

class Conversation : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("nacre_ask_tell_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  AskTell begin(const std::string& algorithm, int budget) const {
    ExploreSettings settings;
    settings.search.algorithm = algorithm;
    settings.search.budget = budget;
    settings.search.population = 6;
    settings.search.batch = 4;
    settings.search.seed = 3;
    settings.parameters = material::default_parameters();
    settings.fidelity = tester::Fidelity::tiny;
    settings.batches = folder_ / "batches";
    return {settings, log(), {}};
  }
  fs::path log() const { return folder_ / "log"; }

  fs::path folder_;
};

ordered_json answer(AskTell& conversation, const ordered_json& request) {
  return conversation.respond(request.dump(), 1);
}

/// Of a tester of somebody's own.
ordered_json own_test(const std::string& key) {
  const std::uint64_t bits = std::stoull(key, nullptr, 16);
  if (bits % 7 == 0) return {{"pattern", key}, {"error", "broke in the grips"}};
  return {{"pattern", key},
          {"modulus_pa", 1e9 + static_cast<double>(bits % 1009)},
          {"toughness_pa", 1e5 + static_cast<double>(bits % 1013)},
          {"toughness_se_pa", 2e3}};
}

/// Asks and tells until the search has ended; what was asked for.
std::vector<std::string> driven(AskTell& conversation) {
  std::vector<std::string> asked;
  while (true) {
    const auto patterns = answer(conversation, {{"request", "ask"}})["patterns"];
    if (patterns.empty()) return asked;
    ordered_json samples = ordered_json::array();
    for (const std::string key : patterns) asked.push_back(key), samples.push_back(own_test(key));
    const auto told = answer(conversation, {{"request", "tell"}, {"samples", samples}});
    EXPECT_FALSE(told.contains("error")) << told;
  }
}

TEST_F(Conversation, DrivesASearchAsAProgramWould) {
  AskTell conversation = begin("nsga2", 30);
  const std::vector<std::string> asked = driven(conversation);
  explore::SearchSettings settings{.algorithm = "nsga2", .budget = 30, .population = 6, .batch = 4, .seed = 3};
  const auto search = explore::make_search(settings);
  std::vector<std::string> expected;
  for (auto batch = search->ask(); !batch.empty(); batch = search->ask()) {
    std::vector<std::optional<optimize::Performance>> performances;
    for (const pattern::Pattern& pattern : batch) {
      expected.push_back(pattern.key());
      const auto sample = own_test(pattern.key());
      performances.push_back(sample.contains("error")
                                 ? std::nullopt
                                 : std::optional(optimize::Performance{sample["modulus_pa"], sample["toughness_pa"]}));
    }
    search->tell(performances);
  }
  EXPECT_EQ(asked, expected);
  ASSERT_EQ(conversation.gamut().size(), search->evaluated().size());
  for (const explore::Evaluated& sample : conversation.gamut()) EXPECT_EQ(sample.sampling.toughness_se_pa, 2e3);
}

TEST_F(Conversation, GoesOnWhereItWasWhateverEndedIt) {
  std::vector<std::string> whole;
  {
    AskTell uninterrupted = begin("nsga2", 30);
    whole = driven(uninterrupted);
  }
  SetUp();
  std::vector<std::string> asked;
  for (const int told : {1, 0, 3, 4}) {  // of the batch of each conversation
    AskTell conversation = begin("nsga2", 30);
    const auto awaited = conversation.standing()["awaited"];
    const auto patterns = answer(conversation, {{"request", "ask"}})["patterns"];
    if (!awaited.empty()) EXPECT_EQ(patterns, awaited) << "asked again, the same";
    ordered_json samples = ordered_json::array();
    for (const std::string key : patterns) {
      if (static_cast<int>(samples.size()) == told) break;
      asked.push_back(key), samples.push_back(own_test(key));
    }
    answer(conversation, {{"request", "tell"}, {"samples", samples}});
    std::ofstream(log(), std::ios::app) << R"({"told": {"patt)";  // killed while it wrote
  }
  AskTell last = begin("nsga2", 30);
  for (const std::string& key : driven(last)) asked.push_back(key);
  EXPECT_EQ(asked, whole);
}

TEST_F(Conversation, TestsAreMeansOverSpecimensAndAreDoneOnce) {
  const tester::Simulation simulation{.design = *pattern::Pattern::from_layout(*pattern::layout_from_key(kPublishedA)),
                                      .parameters = material::default_parameters(),
                                      .conditions = {},
                                      .fidelity = tester::Fidelity::tiny};
  const auto expected = tester::expected_toughness(simulation, 3);
  const ordered_json request{{"request", "test"}, {"patterns", {kPublishedA}}, {"specimens", 3}};
  ordered_json first;
  {
    AskTell conversation = begin("random", 5);
    first = answer(conversation, request);
    const auto sample = first["samples"][0];
    EXPECT_DOUBLE_EQ(sample["toughness_pa"], expected->toughness_pa);
    EXPECT_DOUBLE_EQ(sample["toughness_se_pa"], *expected->toughness_se_pa);
    EXPECT_GT(sample["modulus_pa"].get<double>(), 0.0);
    EXPECT_EQ(first["tests_left"], 2);
  }
  AskTell conversation = begin("random", 5);
  EXPECT_EQ(answer(conversation, request), first) << "from the log";
  const auto more =
      answer(conversation, {{"request", "test"}, {"patterns", {kPublishedA}}, {"specimens", 2}, {"first_specimen", 2}});
  EXPECT_EQ(more["tests_left"], 1) << "one of the two is known";
  const auto gamut = conversation.gamut();
  ASSERT_EQ(gamut.size(), 1u);
  EXPECT_EQ(gamut[0].sampling.specimens, 4);
  EXPECT_GT(gamut[0].sampling.toughness_se_pa, 0.0);
  const auto refused =
      answer(conversation, {{"request", "test"}, {"patterns", {kPublishedA}}, {"specimens", 2}, {"first_specimen", 4}});
  EXPECT_THAT(refused.value("error", ""), HasSubstr("2 fracture tests wanted, 1 are left"));
}

TEST_F(Conversation, WhatIsTestedCanBeTold) {
  AskTell conversation = begin("random", 12);
  const auto patterns = answer(conversation, {{"request", "ask"}})["patterns"];
  const auto samples = answer(conversation, {{"request", "test"}, {"patterns", patterns}, {"specimens", 2}})["samples"];
  const auto told = answer(conversation, {{"request", "tell"}, {"samples", samples}});
  EXPECT_EQ(told["evaluated"], 4);
  EXPECT_EQ(told["asks_left"], 8);
  EXPECT_EQ(told["tests_left"], 4);
  EXPECT_GT(told["hypervolume_gpa_mpa"].get<double>(), 0.0);
}

TEST_F(Conversation, WhatCannotBeUnderstoodNamesItsLineAndChangesNothing) {
  AskTell conversation = begin("random", 8);
  const std::string key = answer(conversation, {{"request", "ask"}})["patterns"][0];
  const ordered_json before = conversation.standing();
  const std::string log_before = read_file(log());
  const auto sample = [&](const std::string& members) {
    return R"({"request": "tell", "samples": [{"pattern": ")" + key + "\"" + members + "}]}";
  };
  for (const auto& [line, expected] :
       {std::pair<std::string, std::string>{"ask", "no JSON object"},
        {"[]", "no JSON object"},
        {"{}", "no member `request`"},
        {R"({"request": "stop"})", "expected \"ask\", \"tell\" or \"test\""},
        {R"({"request": "ask", "count": 3})", "`count`: no such member"},
        {R"({"request": "tell"})", "no member `samples`"},
        {R"({"request": "tell", "samples": [{"pattern": "577fffe9fffdef", "modulus_pa": 1, "toughness_pa": 1}]})",
         "is not awaited"},
        {sample(R"(, "modulus_pa": 1)"), "no member `toughness_pa`"},
        {sample(R"(, "modulus_pa": 1, "toughness_pa": -1)"), "`toughness_pa` = -1: expected a number in Pa"},
        {sample(R"(, "modulus_pa": 1, "toughness_pa": "1")"), "`toughness_pa` = \"1\""},
        {sample(R"(, "modulus_pa": 1, "toughness_pa": 1, "toughness_se": 1)"), "`toughness_se`: no such member"},
        {R"({"request": "test", "patterns": []})", "`patterns`: expected a list of keys"},
        {R"({"request": "test", "patterns": ["577"]})", "577"},
        {R"({"request": "test", "patterns": ["577fffe9fffdef", "577fffe9fffdef"]})", "expected once"},
        {R"({"request": "test", "patterns": ["577fffe9fffdef"], "specimens": 0})", "`specimens` = 0: expected a whole"},
        {R"({"request": "test", "patterns": ["577fffe9fffdef"], "specimens": 9})", "8 are left"}}) {
    const ordered_json response = conversation.respond(line, 12);
    EXPECT_THAT(response.value("error", "no error"), AllOf(HasSubstr("line 12: "), HasSubstr(expected))) << line;
    EXPECT_EQ(conversation.standing(), before) << line;
  }
  EXPECT_EQ(read_file(log()), log_before);
}

TEST_F(Conversation, AFaultyLogIsRefusedWithItsLine) {
  std::ofstream(log()) << R"({"tested": {"pattern": "577fffe9fffdef", "specimen": 0}})"
                       << "\nnonsense\n";
  try {
    begin("random", 8);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("log: line 2"), HasSubstr("no JSON object")));
  }
}

}  // namespace
}  // namespace nacre::offline
