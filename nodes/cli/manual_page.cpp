#include "manual_page.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace nacre::cli {
namespace {

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n0 done, 1 the result is no or the disk is full, 2 wrong usage or bad input.\n";

/// Text for roff: backslashes and hyphens as they are typed, no line that begins with a control character.
std::string roff(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool begins_line = at == 0 || text[at - 1] == '\n';
    if (begins_line && (text[at] == '.' || text[at] == '\'')) result += "\\&";
    if (text[at] == '\\')
      result += "\\e";
    else if (text[at] == '-')
      result += "\\-";
    else
      result += text[at];
  }
  return result;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char letter) { return std::toupper(letter); });
  return text;
}

std::string head(const std::string& name, const std::string& description, const std::string& version) {
  return fmt::format(".TH {} 1 \"\" \"{}\" nacre\n.SH NAME\n{} \\- {}\n", roff(upper(name)), roff(version), roff(name),
                     roff(description));
}

/// One entry of a list: what is typed, what follows it (type, range, default), what it means.
std::string entry(const std::string& typed, const CLI::Option& option) {
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(typed), roff(CLI::Formatter().make_option_opts(&option)),
                     roff(option.get_description()));
}

std::string arguments_of(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) text += entry(option->get_name(true), *option);
  return text.empty() ? "" : ".SH ARGUMENTS\n" + text;
}

std::string options_of(const CLI::App& command) {
  std::string text = ".SH OPTIONS\n";
  for (const CLI::Option* option : command.get_options())
    if (option->nonpositional()) text += entry(option->get_name(false, true), *option);
  return text;
}

std::string usage_of(const CLI::App& command) {
  std::string usage = "[OPTIONS]";
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) usage += " " + CLI::Formatter().make_option_usage(option);
  return usage;
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& version) {
  std::string page = head(app.get_name(), app.get_description(), version);
  page += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR [OPTIONS] COMMAND\n", roff(app.get_name()));
  page += options_of(app) + ".SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands({}))
    page += fmt::format(".TP\n\\fB{0}\\-{1}\\fR(1)\n{2}\n", roff(app.get_name()), roff(command->get_name()),
                        roff(command->get_description()));
  return page + kExitStatus;
}

std::string manual_page(const CLI::App& app, const CLI::App& command, const std::string& version) {
  std::string page = head(app.get_name() + "-" + command.get_name(), command.get_description(), version);
  page += fmt::format(".SH SYNOPSIS\n\\fB{} {}\\fR {}\n", roff(app.get_name()), roff(command.get_name()),
                      roff(usage_of(command)));
  page += arguments_of(command) + options_of(command);
  if (!command.get_footer().empty()) page += fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", roff(command.get_footer()));
  return page + kExitStatus + fmt::format(".SH SEE ALSO\n\\fB{}\\fR(1)\n", roff(app.get_name()));
}

}  // namespace nacre::cli
