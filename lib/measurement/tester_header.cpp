#include "measurement/tester_header.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/csv.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {

bool is_mts_793(std::span<const std::string_view> lines) { return !lines.empty() && lines[0].starts_with("MTS793"); }

std::string maker_of(std::span<const std::string_view> lines, char delimiter) {
  if (is_mts_793(lines)) return "MTS";
  bool bluehill = false, zwick = false, mts = false;
  for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 60); ++i) {
    const std::string words = plain_words(lines[i]);
    const auto holds = [&](std::string_view word) { return words.find(word) != std::string::npos; };
    bluehill = bluehill || holds("bluehill") || holds("results table") || holds("instron") || holds("raw data");
    zwick = zwick || holds("testxpert") || holds("standardkraft") || holds("standard force") || holds("zwick");
    mts = mts || holds("testsuite") || holds("testworks") || holds("mts ") || holds("axial force") ||
          holds("running time");
  }
  // Bluehill's own mark: a row of nothing but units in parentheses.
  for (std::size_t i = 1; i < std::min<std::size_t>(lines.size(), kMostHeaderLines) && !bluehill; ++i) {
    const std::vector<std::string> here = cells_of(lines[i], delimiter);
    bluehill = here.size() > 1 &&
               std::all_of(here.begin(), here.end(),
                           [](const std::string& cell) {
                             return cell.empty() || (cell.front() == '(' && cell.back() == ')');
                           }) &&
               std::any_of(here.begin(), here.end(), [](const auto& cell) { return !cell.empty(); });
  }
  return zwick ? "ZwickRoell testXpert" : mts ? "MTS" : bluehill ? "Instron Bluehill" : "table";
}

std::map<std::string, std::string> header_of(std::span<const std::string_view> lines, char delimiter) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kKeys = {{
      {"date", "date"},
      {"test date", "date"},
      {"datum", "date"},
      {"pruefdatum", "date"},
      {"test run date", "date"},
      {"start date", "date"},
      {"date/time", "date"},
      {"test start time", "date"},
      {"operator", "operator"},
      {"operator id", "operator"},
      {"operator name", "operator"},
      {"pruefer", "operator"},
      {"tester", "operator"},
      {"bediener", "operator"},
      {"operateur", "operator"},
      {"machine", "machine"},
      {"test machine", "machine"},
      {"pruefmaschine", "machine"},
      {"system id", "machine"},
      {"system", "machine"},
      {"frame", "machine"},
  }};
  std::map<std::string, std::string> header;
  for (const std::string_view line : lines) {
    const std::vector<std::string> here = cells_of(line, delimiter);
    std::string key = here[0], value;
    const std::size_t colon = key.find(':');
    if (colon != std::string::npos && !trimmed(std::string_view(key).substr(colon + 1)).empty()) {
      value = std::string(trimmed(std::string_view(key).substr(colon + 1)));
    } else {
      for (std::size_t k = 1; k < here.size() && value.empty(); ++k) value = here[k];
    }
    const std::string words = plain_words(key);
    const std::string_view name = trimmed(std::string_view(words).substr(0, words.find(':')));
    const auto known = std::find_if(kKeys.begin(), kKeys.end(), [&](const auto& each) { return each.first == name; });
    if (known != kKeys.end() && !value.empty()) header.try_emplace(std::string(known->second), value);
  }
  return header;
}

}  // namespace nacre::measurement
