// Model-based searches: learned and its rivals.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>

#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"
#include "explore/batch_log.hpp"
#include "explore/learned.hpp"
#include "explore/predictors.hpp"
#include "explore/specimen_scatter.hpp"
#include "explore/surrogate_search.hpp"
#include "pattern/random_pattern.hpp"
#include "synthetic.hpp"

namespace nacre::explore {
namespace {

using ::testing::HasSubstr;

SearchSettings settings(const std::string& algorithm, std::uint64_t seed, int budget) {
  SearchSettings settings;
  settings.algorithm = algorithm;
  settings.budget = budget;
  settings.seed = seed;
  settings.learned.generations = 15;  // little, so that tests stay fast
  settings.learned.population = 40;
  settings.learned.barred_start = 0;
  settings.learned.barred_candidates = 100;
  return settings;
}

double hypervolume_of(const std::vector<Evaluated>& samples) {
  return optimize::hypervolume_staircase_gpa_mpa(performances_of(samples));
}

double hypervolume_after(const SearchSettings& chosen) {
  const auto search = make_search(chosen);
  run(*search);
  return hypervolume_of(search->evaluated());
}

TEST(Learned, ReachesWithAFewSamplesWhatEvolutionNeedsFourTimesAsManyFor) {
  // The stand-in's jitter, a fifth of the toughness from lowest to highest, cannot be learnt; the rest can.
  double learned = 0.0, evolution = 0.0;
  for (const std::uint64_t seed : {1, 3}) {
    SearchSettings whole = settings("learned", seed, 120);
    whole.learned = {};
    learned += hypervolume_after(whole);
    evolution += hypervolume_after(settings("nsga2-single-pixel", seed, 480));
  }
  EXPECT_GT(learned, evolution);
}

/// Whether three rows of the quarter are rigid throughout, as in every pattern drawn with bars.
bool has_bars(const pattern::Pattern& pattern) {
  int bars = 0;
  for (int row = 0; row < pattern::kQuarter; ++row) {
    bool is_bar = true;
    for (int column = 0; column < pattern::kQuarter; ++column) is_bar = is_bar && pattern.rigid(row, column);
    bars += is_bar;
  }
  return bars >= 3;
}

/// How many patterns of each batch have bars.
std::vector<int> barred_by_batch(const SearchSettings& chosen) {
  const auto search = make_search(chosen);
  std::vector<int> barred;
  for (auto batch = search->ask(); !batch.empty(); batch = search->ask()) {
    barred.push_back(0);
    std::vector<std::optional<optimize::Performance>> performances;
    for (const pattern::Pattern& pattern : batch) {
      barred.back() += has_bars(pattern);
      performances.push_back(synthetic_performance(pattern));
    }
    search->tell(performances);
  }
  return barred;
}

TEST(Learned, PatternsWithBarsFollowTheRandomOnes) {
  SearchSettings chosen = settings("learned", 6, 55);
  chosen.learned.barred_start = 25;
  EXPECT_THAT(barred_by_batch(chosen), ::testing::ElementsAre(0, 0, 10, 10, 5, ::testing::_));
  chosen.learned.barred_candidates = 0;
  RandomStream random(8, "test");
  for (int i = 0; i < 30; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    chosen.former.push_back({pattern, synthetic_performance(pattern)});
  }
  EXPECT_THAT(barred_by_batch(chosen), ::testing::Each(::testing::Lt(10))) << "who has former samples knows enough";
}

TEST(Learned, BatchesAreChosenFromPatternsWithBarsToo) {
  SearchSettings chosen = settings("learned", 6, 60);
  chosen.learned.generations = 1;
  const auto count = [&](int candidates) {
    chosen.learned.barred_candidates = candidates;
    const std::vector<int> barred = barred_by_batch(chosen);
    return std::accumulate(barred.begin(), barred.end(), 0);
  };
  EXPECT_GT(count(1000), count(0) + 5);
}

TEST(Predictors, HowBadABadPatternIsMattersNotToTheOthers) {
  RandomStream random(5, "test");
  std::vector<Evaluated> mild;
  std::vector<pattern::Pattern> others;
  for (int i = 0; i < 160; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    if (i < 120)
      mild.push_back({pattern, synthetic_performance(pattern)});
    else
      others.push_back(pattern);
  }
  // Every tenth specimen falls apart at once: at a third of the others' toughness, or at a thousandth.
  std::vector<Evaluated> harsh = mild;
  for (std::size_t i = 0; i < mild.size(); i += 10)
    mild[i].performance.toughness_pa /= 3.0, harsh[i].performance.toughness_pa /= 1000.0;
  const auto largest_change = [&](double floor_deviations) {
    SearchSettings chosen = settings("learned", 1, 300);
    chosen.learned.floor_deviations = floor_deviations;
    const auto a = fit_predictors(mild, chosen).toughness->predict(others),
               b = fit_predictors(harsh, chosen).toughness->predict(others);
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i].mean - b[i].mean));
    return largest;
  };
  EXPECT_LT(largest_change(0.5), 0.01);
  EXPECT_GT(largest_change(0.0), 0.5) << "without the floor they do";
}

TEST(Predictors, LearnFromOrdinarySamplesTooWhenThereAreTooMany) {
  std::vector<Evaluated> samples;
  RandomStream random(7, "test");
  for (int i = 0; i < 400; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    samples.push_back({pattern, synthetic_performance(pattern)});
  }
  const std::vector<Evaluated> learnt = learnt_samples(samples, 40), ordered = best_by_rank(samples, samples.size());
  const auto place = [&](const Evaluated& sample) { return std::ranges::find(ordered, sample) - ordered.begin(); };
  ASSERT_EQ(learnt.size(), 40u);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(place(learnt[i]), i < 20 ? i : 20 + 19 * (i - 20));
  EXPECT_THAT(learnt_samples(samples, 400), ::testing::UnorderedElementsAreArray(samples));
}

TEST(Learned, ChoosingByRankAsTheThesisDoesLearnsToo) {
  SearchSettings by_rank = settings("learned", 1, 120);
  by_rank.learned.choice = "rank";
  EXPECT_GT(hypervolume_after(by_rank), 1.05 * hypervolume_after(settings("random", 1, 120)));
}

TEST(Learned, TheModulusThatIsComputedDecidesAndNotTheOneBelieved) {
  SearchSettings chosen = settings("learned", 2, 40);
  std::vector<pattern::Pattern> asked;
  chosen.mechanics.modulus_of = [&](std::span<const pattern::Pattern> patterns) {
    std::vector<std::optional<double>> moduli;
    for (const pattern::Pattern& pattern : patterns) {
      asked.push_back(pattern);
      moduli.push_back(pattern.bits() % 3 == 0 ? 1e12 : 1.0);  // far beyond all that is known, or worthless
    }
    return moduli;
  };
  const auto search = make_search(chosen);
  while (!search->batch_request()) {
    std::vector<std::optional<optimize::Performance>> performances;
    for (const pattern::Pattern& pattern : search->ask()) performances.push_back(synthetic_performance(pattern));
    search->tell(performances);
  }
  const std::vector<pattern::Pattern> batch = search->ask();
  ASSERT_EQ(batch.size(), 10u);
  EXPECT_GT(asked.size(), 50u);
  for (const pattern::Pattern& pattern : batch) EXPECT_EQ(pattern.bits() % 3, 0u) << pattern.key();
}

/// The stand-in as a mean over specimens: each is tougher or less so by a log-normal factor.
class NoisyStandIn {
 public:
  std::vector<std::optional<optimize::Performance>> operator()(std::span<const pattern::Pattern> batch) {
    std::vector<std::optional<optimize::Performance>> performances;
    for (const pattern::Pattern& pattern : batch) {
      optimize::Performance performance = synthetic_performance(pattern);
      performance.toughness_pa *= std::exp(0.2 * random_.normal() - 0.02);
      performances.emplace_back(performance);
    }
    return performances;
  }

 private:
  RandomStream random_{17, "test"};
};

TEST(ModernRivals, BeatRandomSearchOnTheStandIn) {
  for (const char* algorithm : {"nehvi", "morbo", "egbo"})
    EXPECT_GT(hypervolume_after(settings(algorithm, 1, 120)), 1.05 * hypervolume_after(settings("random", 1, 120)))
        << algorithm;
}

TEST(Learned, TestsFurtherSpecimensWhereTheyDecide) {
  SearchSettings chosen = settings("learned", 5, 160);
  chosen.learned.specimens = 4;
  const auto search = make_search(chosen);
  NoisyStandIn tested;
  std::map<pattern::Pattern, int> specimens;
  int tests = 0;
  for (auto batch = search->ask(); !batch.empty(); batch = search->ask()) {
    for (const pattern::Pattern& pattern : batch) ++specimens[pattern], ++tests;
    search->tell(tested(batch));
  }
  EXPECT_EQ(tests, 160);
  ASSERT_EQ(search->evaluated().size(), specimens.size());
  int again = 0;
  for (const Evaluated& sample : search->evaluated()) {
    EXPECT_EQ(sample.sampling.specimens, specimens.at(sample.pattern));
    EXPECT_LE(sample.sampling.specimens, 4);
    EXPECT_EQ(sample.sampling.toughness_se_pa > 0.0, sample.sampling.specimens > 1);
    again += sample.sampling.specimens - 1;
  }
  EXPECT_GT(again, 5);
  EXPECT_LT(again, 100) << "most tests are of new patterns";
}

TEST(Learned, ABatchIsChosenFromPatternsThatAreApart) {
  const auto nearest_in_batches = [](int apart) {
    SearchSettings chosen = settings("learned", 4, 80);
    chosen.learned.apart = apart;
    const auto search = make_search(chosen);
    int nearest = pattern::kFreePixels;
    for (const auto& batch : run(*search))
      for (std::size_t i = 0; i < batch.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          nearest = std::min(nearest, std::popcount(batch[i].bits() ^ batch[j].bits()));
    return nearest;
  };
  EXPECT_GE(nearest_in_batches(4), 4);
  EXPECT_LT(nearest_in_batches(1), 4);
}

TEST(Estimated, TheFrontIsFreeOfSelectionBias) {
  const auto random = make_search(settings("random", 6, 300));
  NoisyStandIn tested;
  for (auto batch = random->ask(); !batch.empty(); batch = random->ask()) {
    const auto performances = tested(batch);
    std::vector<Sampling> samplings;
    for (const auto& performance : performances) samplings.push_back({1, 0.2 * performance->toughness_pa});
    random->tell(performances, samplings);
  }
  const std::vector<Evaluated>& samples = random->evaluated();
  const SearchSettings chosen = settings("learned", 1, 300);
  const auto estimates = estimated(fit_predictors(samples, chosen), samples, chosen.learned);
  const auto log_excess = [](const std::vector<Evaluated>& claimed) {
    std::vector<double> logs;
    for (const Evaluated& sample : best_by_rank(claimed, 20))
      logs.push_back(std::log(sample.performance.toughness_pa / synthetic_performance(sample.pattern).toughness_pa));
    return mean(logs);
  };
  EXPECT_GT(log_excess(samples), 0.1);
  EXPECT_LT(std::abs(log_excess(estimates)), 0.05);
  for (const Evaluated& estimate : best_by_rank(estimates, 20)) EXPECT_GT(estimate.sampling.toughness_se_pa, 0.0);
}

TEST(SpecimenScatter, IsThatOfDesignsAlikeOnceTheyWereTestedTwice) {
  RandomStream random(3, "test");
  std::vector<Evaluated> samples;
  for (int i = 0; i < 200; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(i % 2 == 0 ? 55 : 80, random);
    const double scatter = i % 2 == 0 ? 0.05 : 0.2, apart = scatter * (random.normal() - random.normal());
    samples.push_back({pattern, {1e9, 1e6}, {2, 0.5e6 * std::abs(apart)}});
  }
  const SpecimenScatter none({}), known(samples);
  const pattern::Pattern soft = pattern::random_pattern(55, random), stiff = pattern::random_pattern(80, random);
  EXPECT_DOUBLE_EQ(none.variance_at(soft), kPriorScatter * kPriorScatter);
  EXPECT_NEAR(std::sqrt(known.variance_at(soft)), 0.05, 0.01);
  EXPECT_NEAR(std::sqrt(known.variance_at(stiff)), 0.2, 0.03);
  EXPECT_DOUBLE_EQ(known.noise_of({soft, {1e9, 1e6}, {4, 0.0}}), known.variance_at(soft) / 4.0);
  EXPECT_DOUBLE_EQ(known.noise_of({soft, {1e9, 1e6}, {1, 3e4}}), 9e-4) << "as told";
}

TEST(Predictors, AFormerModelThatMisleadsIsNotBuiltUpon) {
  RandomStream random(11, "test");
  std::vector<Evaluated> samples, former;
  std::vector<pattern::Pattern> others;
  for (int i = 0; i < 300; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    if (i < 80) samples.push_back({pattern, synthetic_performance(pattern)});
    if (i >= 80 && i < 250) former.push_back({pattern, synthetic_performance(pattern)});
    if (i >= 250) others.push_back(pattern);
  }
  // Toughness of other patterns in place of their own: what is learnt from it has nothing to do with the truth.
  std::vector<Evaluated> misleading = former;
  for (std::size_t i = 0; i < former.size(); ++i)
    misleading[i].performance.toughness_pa = former[(i * 7 + 3) % former.size()].performance.toughness_pa;
  const SearchSettings chosen = settings("learned", 1, 300);
  const auto upon = [&](const std::vector<Evaluated>& base) {
    return fit_predictors(samples, chosen, fit_predictors(base, chosen)).toughness->means(others);
  };
  const std::vector<double> alone = fit_predictors(samples, chosen).toughness->means(others);
  EXPECT_EQ(upon(misleading), alone);
  EXPECT_NE(upon(former), alone) << "a former model that agrees is of use";
}

TEST(Learned, FormerSamplesOfAnotherModelAreAHeadStart) {
  const auto earlier = make_search(settings("nsga2", 9, 400));
  run(*earlier);
  SearchSettings with = settings("learned", 3, 40);
  for (Evaluated sample : earlier->evaluated()) {  // another model: half as stiff, and tougher where rigid
    sample.performance.modulus_pa *= 0.5;
    sample.performance.toughness_pa *= 0.5 + sample.pattern.rigid_fraction();
    with.former.push_back(sample);
  }
  const double head_start = hypervolume_after(with), without = hypervolume_after(settings("learned", 3, 40));
  EXPECT_GT(head_start, 1.05 * without);
}

class EveryModelSearch : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryModelSearch, BatchesForItsRequestsAreThoseThatItAsks) {
  const auto search = make_search(settings(GetParam(), 4, 40)), other = make_search(settings(GetParam(), 4, 40));
  int batch_requests = 0;
  while (true) {
    const auto batch_request = search->batch_request();
    batch_requests += batch_request.has_value();
    const auto batch = search->ask();
    const auto same = batch_request ? other->ask_with(batch_for(*batch_request)) : other->ask();
    ASSERT_EQ(batch, same);
    if (batch.empty()) break;
    EXPECT_FALSE(search->batch_request()) << "a request while a batch is out";
    std::vector<std::optional<optimize::Performance>> performances;
    for (const pattern::Pattern& pattern : batch) {
      performances.push_back(pattern.bits() % 5 == 0 ? std::nullopt : std::optional(synthetic_performance(pattern)));
    }
    search->tell(performances);
    other->tell(performances);
  }
  EXPECT_EQ(batch_requests, 2);
}

TEST_P(EveryModelSearch, AnInterruptedSearchComputesNoBatchTwice) {
  const std::string path = ::testing::TempDir() + "/nacre_batches_" + GetParam() + ".txt";
  std::filesystem::remove(path);
  const SearchSettings whole = settings(GetParam(), 5, 40);
  const auto play = [&](int batches, std::size_t expected_left) {
    const auto search = make_search(whole);
    BatchLog log(path, whole);
    EXPECT_EQ(log.left(), expected_left);
    for (int i = 0; i < batches; ++i) {
      const auto batch = log.ask(*search);
      std::vector<std::optional<optimize::Performance>> performances;
      for (const pattern::Pattern& pattern : batch) performances.push_back(synthetic_performance(pattern));
      if (!batch.empty()) search->tell(performances);
    }
    return search->evaluated();
  };
  play(3, 0);
  std::ofstream(path, std::ios::app) << "577fffe9fff";  // killed while it wrote
  const auto resumed = play(4, 3);
  const auto uninterrupted = make_search(whole);
  run(*uninterrupted);
  EXPECT_EQ(resumed, uninterrupted->evaluated());
  std::filesystem::remove(path);
}

INSTANTIATE_TEST_SUITE_P(Algorithms, EveryModelSearch,
                         ::testing::Values("learned", "tsemo", "dgemo", "nehvi", "morbo", "egbo"),
                         [](const auto& algorithm) { return algorithm.param; });

// The last batch of a small budget is shorter than the one that a larger budget asks for.
TEST(BatchLog, ASearchGoesOnWithALargerBudget) {
  const std::string path = ::testing::TempDir() + "/nacre_larger_budget.txt";
  for (const char* algorithm : {"nsga2", "nsga2-single-pixel", "nsga2-rollback", "random"}) {
    std::filesystem::remove(path);
    const auto play = [&](int budget) {
      const SearchSettings wanted = settings(algorithm, 3, budget);
      const auto search = make_search(wanted);
      BatchLog log(path, wanted);
      for (auto batch = log.ask(*search); !batch.empty(); batch = log.ask(*search)) {
        std::vector<std::optional<optimize::Performance>> performances;
        for (const pattern::Pattern& pattern : batch) performances.push_back(synthetic_performance(pattern));
        search->tell(performances);
      }
      return search->evaluated();
    };
    play(27);
    const auto uninterrupted = make_search(settings(algorithm, 3, 45));
    run(*uninterrupted);
    EXPECT_EQ(play(45), uninterrupted->evaluated()) << algorithm;
    EXPECT_EQ(play(45), uninterrupted->evaluated()) << algorithm;
    EXPECT_EQ(play(13).size(), 13u) << algorithm;
  }
  std::filesystem::remove(path);
}

TEST(BatchLog, RefusesTheBatchesOfAnotherModel) {
  const std::string path = ::testing::TempDir() + "/nacre_other_model.txt";
  std::filesystem::remove(path);
  BatchLog(path, settings("nsga2", 1, 40), "stiff");
  EXPECT_NO_THROW(BatchLog(path, settings("nsga2", 1, 40), "stiff"));
  EXPECT_THROW(BatchLog(path, settings("nsga2", 1, 40), "soft"), InputError);
  std::filesystem::remove(path);
}

TEST(BatchLog, ALineWithoutPatternsIsNotTakenForTheEnd) {
  const std::string path = ::testing::TempDir() + "/nacre_blank_batch.txt";
  std::filesystem::remove(path);
  BatchLog(path, settings("nsga2", 1, 40));
  std::ofstream(path, std::ios::app) << "\n";
  EXPECT_THROW(BatchLog(path, settings("nsga2", 1, 40)), InputError);
  std::filesystem::remove(path);
}

TEST(BatchLog, RefusesTheBatchesOfAnotherSearch) {
  const std::string path = ::testing::TempDir() + "/nacre_other_batches.txt";
  std::filesystem::remove(path);
  BatchLog(path, settings("nsga2", 1, 40));
  BatchLog(path, settings("nsga2", 1, 80));  // a larger budget is the same search
  const auto message = [&](const SearchSettings& other) -> std::string {
    try {
      BatchLog(path, other);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(settings("nsga2", 2, 40)), HasSubstr("line 1: it is \"batches of nsga2 seed=1"));
  const std::string before = read_file(path);
  std::ofstream(path, std::ios::app) << "cut off by a cra";
  EXPECT_THAT(message(settings("nsga2", 2, 40)), HasSubstr("line 1"));
  EXPECT_EQ(read_file(path), before + "cut off by a cra") << "a file that is refused stays as it is";
  std::ofstream(path) << "a note without an end of line";
  EXPECT_THAT(message(settings("nsga2", 1, 40)), HasSubstr("line 1: it is \"a note without"));
  EXPECT_EQ(read_file(path), "a note without an end of line");
  std::ofstream(path) << before.substr(0, 20);  // a crash while it was begun
  EXPECT_EQ(message(settings("nsga2", 1, 40)), "no error");
  EXPECT_EQ(read_file(path), before);
  std::ofstream(path, std::ios::app) << "577fffe9fffdef xyz\n";
  EXPECT_THAT(message(settings("nsga2", 1, 40)), HasSubstr("line 2: \"xyz\", expected the key of a pattern"));
  std::filesystem::remove(path);
}

TEST(Predictors, RankUnseenPatternsOfTheStandIn) {
  const auto random = make_search(settings("random", 6, 300));
  run(*random);
  const std::span<const Evaluated> all(random->evaluated());
  const Predictors predictors = fit_predictors(all.first(200), settings("learned", 1, 300));
  std::vector<pattern::Pattern> unseen;
  std::vector<double> modulus, toughness;
  for (const Evaluated& sample : all.subspan(200)) {
    unseen.push_back(sample.pattern);
    modulus.push_back(sample.performance.modulus_pa);
    toughness.push_back(sample.performance.toughness_pa);
  }
  EXPECT_GT(rank_correlation(predictors.modulus->means(unseen), modulus), 0.98);
  EXPECT_GT(rank_correlation(predictors.toughness->means(unseen), toughness), 0.9);
}

}  // namespace
}  // namespace nacre::explore
