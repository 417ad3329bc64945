// nacre as it is installed, under a prefix that was moved, with neither the sources nor the build in sight.

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

#include "base/files.hpp"
#include "program_test.hpp"
#include "short_game.hpp"
#include "tester/modulus.hpp"
#include "tester/toughness.hpp"

namespace nacre {
namespace {

using runtime::ChildProcess;

const fs::path kSources = NACRE_SOURCE_DIR, kBuild = fs::path(NACRE_BINARY_DIR).parent_path();

/// Runs a command in a folder, with empty folders in place of the sources and the build.
std::vector<std::string> hidden(const fs::path& folder, const std::vector<std::string>& words) {
  std::vector<std::string> all = {"unshare",
                                  "--mount",
                                  "sh",
                                  "-c",
                                  "cd \"$0\" && mount -t tmpfs none \"$1\" && mount -t tmpfs none \"$2\" && shift 2 && "
                                  "exec \"$@\"",
                                  folder.string(),
                                  kBuild.string(),
                                  kSources.string()};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

class Installed : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("installed");
    const fs::path first = folder_ / "first";
    const auto installed =
        runtime::ask_program({NACRE_CMAKE, "--install", kBuild.string(), "--prefix", first.string()});
    ASSERT_TRUE(installed.end.orderly()) << installed.output;
    fs::create_directories(prefix().parent_path());
    fs::rename(first, prefix());
    fs::create_directories(work());
  }
  void SetUp() override {
    const auto tried = runtime::ask_program(hidden(work(), {"sh", "-c", "test ! -e \"$0\"/CMakeLists.txt", kSources}));
    if (!tried.end.orderly()) GTEST_SKIP() << "nothing can be mounted here: " << tried.output;
  }
  static fs::path prefix() { return folder_ / "moved" / "here"; }
  static fs::path work() { return folder_ / "work"; }
  static std::vector<std::string> nacre(std::vector<std::string> words) {
    words.insert(words.begin(), (prefix() / "bin/nacre").string());
    return hidden(work(), words);
  }
  /// All that it prints; the exit status is demanded.
  static std::string said_by(const std::vector<std::string>& words, int status = 0) {
    return said_by_program(nacre(words), status);
  }
  static std::string said_by_program(const std::vector<std::string>& words, int status = 0) {
    ChildProcess process(words);
    std::string said;
    const runtime::ProcessEnd end = wait_for_end(process, said, kPatienceS);
    EXPECT_EQ(end.exit_status, status) << said;
    EXPECT_EQ(end.signal, 0) << said;
    return said;
  }

  static constexpr double kPatienceS = 400.0;  ///< a game takes 30 s of a fast core
  inline static fs::path folder_;
};

TEST_F(Installed, TheVersionNamesTheCommitThatWasBuiltAndTheKernel) {
  const std::string commit = read_file(prefix() / "share/nacre/commit");
  const std::string said = said_by({"--version"});
  EXPECT_THAT(said, testing::MatchesRegex("nacre [0-9.]+, commit (unknown|[0-9a-f]{12}(\\+changes)?), kernel [0-9]+, "
                                          "messages [0-9]+\n"));
  EXPECT_THAT(said, HasSubstr("commit " + commit.substr(0, std::min<std::size_t>(12, commit.find('\n')))));
}

TEST_F(Installed, APublishedPatternBreaks) {
  EXPECT_THAT(said_by({"show", "--fidelity", "tiny"}), HasSubstr("page: show/577fffe9fffdef.html"));
  EXPECT_GT(fs::file_size(work() / "show/577fffe9fffdef.gif"), 10'000U);
  EXPECT_THAT(read_file(work() / "show/577fffe9fffdef.html"), HasSubstr("data:image/gif;base64,R0lGODlh"));
}

TEST_F(Installed, AScenarioIsCalledByItsName) {
  EXPECT_THAT(said_by({"launch", "dmeo"}, 2), AllOf(HasSubstr("no such scenario"), HasSubstr("demo, families")));
  EXPECT_THAT(said_by({"doctor", "--scenario", "dmeo"}, 2), HasSubstr("no such scenario"));
}

TEST_F(Installed, AGameIsPlayedToItsEndReportedAndShown) {
  std::ofstream(work() / "short.toml") << short_game("short", 1);
  EXPECT_THAT(said_by({"launch", "short.toml", "--run", "game"}), HasSubstr("the game is over"));
  const fs::path run = work() / "logs/game";
  EXPECT_THAT(read_file(run / "manifest.json"),
              HasSubstr("\"commit\": \"" + read_file(prefix() / "share/nacre/commit").substr(0, 7)));
  EXPECT_THAT(said_by({"report", "logs/game"}), Not(HasSubstr("was not found"))) << "the thesis' tables";

  ChildProcess dashboard(nacre({"dashboard", "logs/game", "--port", "0"}));
  std::string said;
  ASSERT_TRUE(wait_until_said(dashboard, "shows game", said)) << said;
  const std::string port = said.substr(said.find("127.0.0.1:") + 10, said.find("/\n") - said.find("127.0.0.1:") - 10);
  const auto answer = runtime::ask_program(
      {"bash", "-c",
       "exec 3<>/dev/tcp/127.0.0.1/$0; printf 'GET / HTTP/1.0\\r\\nHost: 127.0.0.1:'$0'\\r\\n\\r\\n' >&3; cat <&3",
       port});
  const bool has_page = fs::exists(prefix() / "share/nacre/web/index.html");
  EXPECT_EQ(has_page, fs::exists(kBuild / "web/index.html"));
  EXPECT_THAT(answer.output, has_page ? AllOf(HasSubstr(" 200 "), HasSubstr("page.js"))
                                      : AllOf(HasSubstr(" 503 "), HasSubstr("not built")));
  dashboard.signal_group(SIGINT);
  EXPECT_EQ(wait_for_end(dashboard, said).exit_status, 0);
}

TEST_F(Installed, DataMessagesManualAndCompletionAreThere) {
  for (const char* file : {"share/nacre/data/examples/round1/measurements.csv", "share/nacre/launch/demo.toml",
                           "share/nacre/lcmtypes/header_t.lcm", "share/man/man1/nacre.1", "share/man/man1/nacre-show.1",
                           "share/bash-completion/completions/nacre", "share/zsh/site-functions/_nacre"})
    EXPECT_TRUE(fs::is_regular_file(prefix() / file)) << file;
}

/// What the testers of this program say of a pattern, as examples/simulate says it.
std::string simulated_here(const std::string& design) {
  tester::Simulation simulation;
  simulation.design = pattern::design_from_argument(design);
  simulation.parameters = material::default_parameters();
  std::ostringstream said;
  said << "E " << 1e-9 * tester::test_modulus(simulation).value().modulus_pa << " GPa, T "
       << 1e-6 * tester::test_toughness(simulation).value().toughness_pa << " MPa\n";
  return said.str();
}

TEST_F(Installed, ProgramsOfOnesOwnLinkToTesterAndClient) {
  const auto said = [](const std::vector<std::string>& words, int status = 0) {
    return said_by_program(hidden(work(), words), status);
  };
  for (const std::string example : {"simulate", "laboratory"}) {
    fs::copy(kSources / "examples" / example, work() / example);
    const std::string build = example + "/build";
    said({NACRE_CMAKE, "-S", example, "-B", build, "-DCMAKE_PREFIX_PATH=" + prefix().string()});
    said({NACRE_CMAKE, "--build", build});
  }
  EXPECT_EQ(said({"simulate/build/simulate", "577fffe9fffdef"}), simulated_here("577fffe9fffdef"));
  EXPECT_THAT(said({"simulate/build/simulate", "577"}, 2), HasSubstr("577"));
  EXPECT_THAT(said({"laboratory/build/laboratory", "no_run"}, 2), HasSubstr("no_run"));
}

TEST(Subdirectory, OfAnotherProjectGivesTheSameTargets) {
  const fs::path folder = fresh_folder("subdirectory");
  std::ofstream list(folder / "CMakeLists.txt");
  list << "cmake_minimum_required(VERSION 3.25)\nproject(own LANGUAGES C CXX)\n";
  for (const std::string part : {"", "/examples/simulate", "/examples/laboratory"})
    list << "add_subdirectory(" << kSources.string() << part << " part" << part << ")\n";
  list.close();
  const auto configured = runtime::ask_program({NACRE_CMAKE, "-S", folder, "-B", folder / "build", "-DNACRE_CUDA=OFF"});
  EXPECT_TRUE(configured.end.orderly()) << configured.output;
  EXPECT_FALSE(fs::exists(folder / "build/part/tests")) << "tests are the developers' own";
}

/// Names in a list "a (>= 1), b", without what is in brackets.
std::set<std::string> names_in(const std::string& list) {
  std::set<std::string> names;
  std::istringstream words(list);
  for (std::string each; std::getline(words, each, ',');) {
    const std::size_t begin = each.find_first_not_of(' ');
    if (begin != std::string::npos) names.insert(each.substr(begin, each.find_first_of(" \n", begin) - begin));
  }
  return names;
}

/// Of each library that the built programs name: its package, and what that package provides.
std::vector<std::set<std::string>> packages_of_libraries() {
  constexpr const char* kScript = R"sh(
for program in "$0"/nacre "$0"/nacre_*; do readelf -d "$program"; done |
  sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | sort -u |
  while read -r library; do dpkg -S "*/$(dpkg-architecture -qDEB_HOST_MULTIARCH)/$library"; done |
  cut -d: -f1 | sort -u | xargs dpkg-query -W -f '${Package}, ${Provides}\n' | sort -u)sh";
  std::vector<std::set<std::string>> packages;
  std::istringstream lines(runtime::ask_program({"sh", "-c", kScript, NACRE_BINARY_DIR}).output);
  for (std::string line; std::getline(lines, line);) packages.push_back(names_in(line));
  return packages;
}

TEST(Package, DependsOnThePackagesOfTheLibrariesThatProgramsName) {
  if (runtime::ask_program({"dpkg-shlibdeps", "--version"}).end.exit_status == runtime::kProgramNotFound)
    GTEST_SKIP() << "dpkg-dev is not installed";
  const fs::path folder = fresh_folder("package");
  const auto packed = runtime::ask_program({fs::path(NACRE_CMAKE).replace_filename("cpack"), "-G", "DEB", "-B", folder,
                                            "--config", kBuild / "CPackConfig.cmake"});
  ASSERT_TRUE(packed.end.orderly()) << packed.output;
  const auto name = runtime::ask_program({"sh", "-c", "cd \"$0\" && ls *.deb", folder});
  EXPECT_THAT(name.output, testing::MatchesRegex("nacre_[0-9.]+_[a-z0-9]+\\.deb\n"));
  const auto depends = runtime::ask_program({"sh", "-c", "dpkg-deb -f \"$0\"/*.deb Depends", folder});
  EXPECT_THAT(depends.output, HasSubstr("liblcm1"));
  const std::set<std::string> named = names_in(depends.output);
  const std::vector<std::set<std::string>> packages = packages_of_libraries();
  EXPECT_EQ(named.size(), packages.size()) << depends.output;
  for (const std::set<std::string>& package : packages)
    EXPECT_TRUE(std::ranges::any_of(package, [&](const auto& each) { return named.contains(each); }))
        << *package.begin() << " in " << depends.output;
}

}  // namespace
}  // namespace nacre
