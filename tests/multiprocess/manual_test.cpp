// Manual pages and completion against what the commands' own --help says.

#include <regex>
#include <sstream>

#include "base/files.hpp"
#include "program_test.hpp"

namespace nacre {
namespace {

using testing::Contains;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string help_of(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  words.push_back("--help");
  const Outcome outcome = run_nacre(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

std::vector<std::string> commands() {
  const std::string help = help_of({});
  std::vector<std::string> names;
  for (const std::string& line : lines_of(help.substr(help.find("Subcommands:")))) {
    std::smatch name;
    if (std::regex_search(line, name, std::regex("^  ([a-z]+) "))) names.push_back(name[1]);
  }
  return names;
}

/// The long options of a command: --help, --out, ...
std::vector<std::string> options_of(const std::string& command) {
  std::vector<std::string> options;
  for (const std::string& line : lines_of(help_of({command}))) {
    std::smatch name;
    if (std::regex_search(line, name, std::regex("^  (?:-[a-zA-Z],)?(--[a-z0-9-]+)"))) options.push_back(name[1]);
  }
  return options;
}

class Manual : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("manual");
    const Outcome outcome = run_nacre({"manual", folder_.string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  static std::string page(const std::string& name) { return read_file(folder_ / "man/man1" / (name + ".1")); }
  static fs::path bash_file() { return folder_ / "bash-completion/completions/nacre"; }
  static fs::path zsh_file() { return folder_ / "zsh/site-functions/_nacre"; }
  /// What bash offers for a line whose last word is being typed.
  static std::string offered(const std::string& line) {
    const std::string script = ". " + shell_word(bash_file()) + "; COMP_WORDS=(" + line +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _nacre; echo \"${COMPREPLY[*]}\"";
    return runtime::ask_program({"bash", "-c", script}).output;
  }

  inline static fs::path folder_;
};

/// As roff wants hyphens that are typed.
std::string in_roff(const std::string& option) { return std::regex_replace(option, std::regex("-"), "\\-"); }

TEST_F(Manual, EveryCommandHasItsPageAndItsLine) {
  ASSERT_THAT(commands(), AllOf(Contains("simulate"), Contains("launch"), Contains("manual")));
  const std::string all = page("nacre"), zsh = read_file(zsh_file());
  const std::vector<std::string> bash = lines_of(read_file(bash_file()));
  for (const std::string& command : commands()) {
    EXPECT_THAT(all, HasSubstr("\\fBnacre\\-" + command + "\\fR(1)\n"));
    EXPECT_THAT(page("nacre-" + command), HasSubstr(".SH SYNOPSIS\n\\fBnacre " + command + "\\fR"));
    EXPECT_THAT(bash, Contains(command));
    EXPECT_THAT(zsh, AllOf(HasSubstr("    '" + command + ":"), HasSubstr("    (" + command + ")\n")));
  }
}

TEST_F(Manual, EveryOptionHasItsLine) {
  const std::string zsh = read_file(zsh_file());
  const std::vector<std::string> bash = lines_of(read_file(bash_file()));
  std::size_t count = 0;
  for (const std::string& command : commands()) {
    const std::string own_page = page("nacre-" + command);
    const std::size_t begin = zsh.find("    (" + command + ")\n");
    const std::vector<std::string> own_zsh = lines_of(zsh.substr(begin, zsh.find(";;", begin) - begin));
    for (const std::string& option : options_of(command)) {
      ++count;
      EXPECT_THAT(own_page, HasSubstr(in_roff(option) + "\\fR")) << command << " " << option;
      EXPECT_THAT(bash, Contains(testing::MatchesRegex(command + " " + option + "( .*)?"))) << command << " " << option;
      EXPECT_THAT(own_zsh, Contains(testing::ContainsRegex("'[*]?" + option + "=?\\["))) << command << " " << option;
    }
  }
  EXPECT_GT(count, 100U);
}

TEST_F(Manual, BashOffersCommandsOptionsAndTheValuesOfAChoice) {
  EXPECT_EQ(offered("nacre sim"), "simulate\n");
  EXPECT_EQ(offered("nacre simulate --film"), "--film --film-width\n");
  EXPECT_EQ(offered("nacre simulate --test ''"), "modulus toughness both\n");
  EXPECT_EQ(offered("nacre simulate --test = mod"), "modulus\n");  // as bash splits --test=mod
  EXPECT_EQ(offered("nacre simulate dat"), "\n") << "files are left to bash";
}

TEST_F(Manual, ZshReadsItsScript) {
  if (runtime::ask_program({"zsh", "--version"}).end.exit_status == runtime::kProgramNotFound)
    GTEST_SKIP() << "zsh is not installed";
  const auto read = runtime::ask_program({"zsh", "-n", zsh_file().string()});
  EXPECT_TRUE(read.end.orderly()) << read.output;
}

TEST_F(Manual, ManReadsItsPagesWithoutAWarning) {
  if (runtime::ask_program({"man", "--version"}).end.exit_status == runtime::kProgramNotFound)
    GTEST_SKIP() << "man is not installed";
  for (const auto& each : fs::directory_iterator(folder_ / "man/man1")) {
    const std::string command = "man --warnings -E UTF-8 -l -Tutf8 " + shell_word(each.path()) + " 2>&1 >/dev/null";
    EXPECT_EQ(runtime::ask_program({"sh", "-c", command}).output, "") << each.path();
  }
}

}  // namespace
}  // namespace nacre
