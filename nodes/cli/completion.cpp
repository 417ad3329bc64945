#include "completion.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace nacre::cli {
namespace {

/// `--name`, or the short name where there is no long one.
std::string typed_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? "-" + option.get_snames().front() : "--" + option.get_lnames().front();
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// The values among which one chooses, with blanks between: the type of such an option is TEXT:{a,b}.
std::string choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return "";
  std::string choices = type.substr(begin + 1, end - begin - 1);
  std::ranges::replace(choices, ',', ' ');
  return choices;
}

/// Rows of the table that bash reads: `COMMAND`, then `COMMAND OPTION [VALUES]`.
std::string bash_rows(const CLI::App& command) {
  std::string rows = command.get_name() + "\n";
  for (const CLI::Option* option : command.get_options()) {
    if (!option->nonpositional()) continue;
    const std::string choices = choices_of(*option);
    rows += fmt::format("{} {}{}{}\n", command.get_name(), typed_name(*option), choices.empty() ? "" : " ", choices);
  }
  return rows;
}

/// Text in single quotes inside zsh's _arguments and _describe, where brackets and colons mean something.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\'')
      result += "'\\''";
    else if (letter == '[' || letter == ']' || letter == ':' || letter == '\\')
      result += std::string("\\") + letter;
    else
      result += letter == '\n' ? ' ' : letter;
  }
  return result;
}

/// What zsh offers as a value: the choices, else files.
std::string zsh_value(const CLI::Option& option) {
  const std::string choices = choices_of(option);
  return choices.empty() ? "_files" : fmt::format("({})", choices);
}

/// A specification of _arguments as a line.
std::string zsh_option(const CLI::Option& option) {
  const bool repeats = option.get_expected_max() > 1;
  const std::string type = option.get_type_name(), kind = type.substr(0, type.find_first_of(": "));
  const std::string value = takes_value(option) ? fmt::format(":{}:{}", zsh_text(kind), zsh_value(option)) : "";
  return fmt::format("        '{}{}{}[{}]{}' \\\n", repeats ? "*" : "", typed_name(option),
                     takes_value(option) ? "=" : "", zsh_text(option.get_description()), value);
}

std::string zsh_command(const CLI::App& command) {
  std::string lines;
  for (const CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) lines += zsh_option(*option);
    if (option->get_positional())
      lines += fmt::format("        '{}:{}:_files' \\\n", option->get_expected_max() > 1 ? "*" : "",
                           zsh_text(option->get_name(true)));
  }
  return fmt::format("    ({})\n      _arguments \\\n{}        && ret=0 ;;\n", command.get_name(), lines);
}

constexpr const char* kBashHead = R"sh(# Completion of nacre in bash; written by `nacre manual`.
# Rows: COMMAND, then COMMAND OPTION [VALUES].
_nacre_rows='
)sh";

constexpr const char* kBashFunction = R"sh('

_nacre() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} asked=${COMP_WORDS[1]}
  local command option values words= chosen=
  if [ "$word" = = ]; then
    word=
  elif [ "$before" = = ]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  while read -r command option values; do
    if [ "$COMP_CWORD" = 1 ]; then
      [ -n "$command" ] && [ -z "$option" ] && words+=" $command"
    elif [ "$command" = "$asked" ] && [ -n "$option" ]; then
      words+=" $option"
      [ "$option" = "$before" ] && chosen=$values
    fi
  done <<<"$_nacre_rows"
  COMPREPLY=()
  if [ -n "$chosen" ]; then
    COMPREPLY=($(compgen -W "$chosen" -- "$word"))
  elif [ "$COMP_CWORD" = 1 ] || [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
  fi
}
complete -o default -F _nacre nacre
)sh";

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string script = kBashHead;
  for (const CLI::App* command : app.get_subcommands({})) script += bash_rows(*command);
  return script + kBashFunction;
}

std::string zsh_completion(const CLI::App& app) {
  std::string commands, options;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands += fmt::format("    '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
    options += zsh_command(*command);
  }
  std::string own;
  for (const CLI::Option* option : app.get_options()) own += zsh_option(*option);
  return fmt::format(
      "#compdef nacre\n# Completion of nacre in zsh; written by `nacre manual`.\n"
      "local curcontext=$curcontext state line ret=1\nlocal -a commands\n"
      "_arguments -C \\\n{}        '1: :->command' '*:: :->options' && ret=0\n"
      "case $state in\n  (command)\n  commands=(\n{}  )\n  _describe command commands && ret=0 ;;\n"
      "  (options)\n  case $words[1] in\n{}  esac ;;\nesac\nreturn ret\n",
      own, commands, options);
}

}  // namespace nacre::cli
