#include "material/effect_words.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace nacre::material {
namespace {

/// Names of forms that say the form and not the effect.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kForms = {
    {{"rate_power_law", "power-law rate dependence"},
     {"rate_prony", "two-branch rate dependence"},
     {"rate_by_phase", "rate dependence by phase"}}};

}  // namespace

std::string effect_in_words(std::string_view name) {
  std::string words(name);
  for (const auto& [form, in_words] : kForms)
    for (std::size_t at = words.find(form); at != std::string::npos; at = words.find(form, at + in_words.size()))
      words.replace(at, form.size(), in_words);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string unit_behind_number(std::string_view unit) { return unit == "1" ? "" : " " + std::string(unit); }

}  // namespace nacre::material
