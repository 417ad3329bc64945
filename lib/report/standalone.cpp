#include "report/standalone.hpp"

#include <map>
#include <string_view>

#include <fmt/format.h>

#include "report/page_style.hpp"

namespace nacre::report {
namespace {

constexpr std::string_view kVariable = "var(--";

/// Splits `text` at `end` and calls visit(piece) for what stands before each.
template <class Visit>
void for_each_piece(std::string_view text, char end, const Visit& visit) {
  for (std::size_t at = text.find(end); at != std::string_view::npos; at = text.find(end)) {
    visit(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \n"), last = text.find_last_not_of(" \n");
  return first == std::string_view::npos ? "" : text.substr(first, last - first + 1);
}

using Variables = std::map<std::string, std::string, std::less<>>;

/// Every `--name: value;`.
Variables variables_in(std::string_view declarations) {
  Variables variables;
  for_each_piece(declarations, ';', [&](std::string_view declaration) {
    const std::size_t name = declaration.find("--"), colon = declaration.find(':', name);
    if (name == std::string_view::npos || colon == std::string_view::npos) return;
    variables.emplace(declaration.substr(name + 2, colon - name - 2), trimmed(declaration.substr(colon + 1)));
  });
  return variables;
}

std::string written_out(std::string_view text, const Variables& variables) {
  std::string result;
  for (std::size_t at = text.find(kVariable); at != std::string_view::npos; at = text.find(kVariable)) {
    const std::size_t end = text.find(')', at);
    const auto value = variables.find(text.substr(at + kVariable.size(), end - at - kVariable.size()));
    result += text.substr(0, at);
    result += value != variables.end() ? value->second : "none";
    text.remove_prefix(end + 1);
  }
  return result + std::string(text);
}

/// The rules of kFigureStyle in light colours. One that colours by ink (`--c`) stands once for every ink, `.sim` and so
/// on, whose rule says nothing else.
std::string light_style() {
  Variables colours = variables_in(kLightColours);
  colours.merge(variables_in(phase_colours()));
  std::map<std::string, Variables> inks;
  std::string style;
  for_each_piece(kFigureStyle, '}', [&](std::string_view rule) {
    const std::size_t brace = rule.find('{');
    if (brace == std::string_view::npos) return;  // the end of @media
    const std::string_view selector = trimmed(rule.substr(0, brace)), body = trimmed(rule.substr(brace + 1));
    if (selector.starts_with('@')) return;  // dark
    if (body.starts_with("--c:")) {
      inks[std::string(selector)] = variables_in(written_out(body, colours));
    } else if (body.find("var(--c)") == std::string_view::npos) {
      style += fmt::format("{} {{ {} }}\n", selector, written_out(body, colours));
    } else {
      for (const auto& [ink, colour] : inks) {
        Variables known = colours;
        known.insert(colour.begin(), colour.end());
        style += fmt::format("{}{} {{ {} }}\n", selector, ink, written_out(body, known));
      }
    }
  });
  return style;
}

}  // namespace

std::string standalone(const std::string& svg) {
  static const std::string style = light_style();
  const std::size_t end = svg.find('>');
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg.substr(0, end) +
         " xmlns=\"http://www.w3.org/2000/svg\" style=\"background: #fff; font-family: Helvetica, Arial, "
         "sans-serif\">\n<style>\n" +
         style + "</style>" + svg.substr(end + 1);
}

}  // namespace nacre::report
