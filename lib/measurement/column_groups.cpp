// Part of the third stage of reading an export (tester_parts.hpp): specimens whose columns stand beside each other.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "base/csv.hpp"
#include "measurement/tester_parts.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

bool is_curve_quantity(const ColumnName& name) {
  return (name.quantity == Quantity::extension || name.quantity == Quantity::force ||
          name.quantity == Quantity::time) &&
         name.role == ColumnRole::measured;
}

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  std::string word;
  for (const char letter : std::string(name) + " ") {
    const bool ends = letter == ' ' || letter == '(' || letter == ')' || letter == '[' || letter == ']' ||
                      letter == ':' || letter == ',' || letter == '.' || letter == '-';
    if (!ends) {
      word += letter;
    } else if (!word.empty()) {
      words.push_back(word);
      word.clear();
    }
  }
  return words;
}

/// A number, a letter or `#3`.
bool is_label(std::string_view word) {
  if (word.starts_with('#')) word.remove_prefix(1);
  if (word.empty() || word.size() > 3) return false;
  const bool digits = word.find_first_not_of("0123456789") == std::string_view::npos;
  const bool letter_and_digits =
      word.size() > 1 && word.substr(1).find_first_not_of("0123456789") == std::string_view::npos;
  return digits || word.size() == 1 || letter_and_digits;
}

bool is_specimen_word(std::string_view word) {
  const auto words = specimen_words().words();
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// `probe1`: a specimen's name and number in one word.
bool names_specimen(std::string_view word) {
  const std::size_t digits = word.find_first_of("0123456789");
  return digits != std::string_view::npos && digits > 0 && word.size() - digits <= 3 &&
         word.find_first_not_of("0123456789", digits) == std::string_view::npos &&
         is_specimen_word(word.substr(0, digits));
}

/// Without the number that a spreadsheet gives a heading that occurs again: `travel .1`.
std::string_view without_count(std::string_view name) {
  const std::size_t point = name.rfind('.');
  if (point == std::string_view::npos || point == 0 || point + 1 == name.size() || name.size() - point > 4) return name;
  if (name.find_first_not_of("0123456789", point + 1) != std::string_view::npos) return name;
  return trimmed(name.substr(0, point));
}

struct Labelled {
  std::string base, label;  ///< without the label; empty label: none
};

std::string joined(std::vector<std::string> words) {
  return std::accumulate(
      words.begin(), words.end(), std::string(),
      [](const std::string& all, const std::string& word) { return all.empty() ? word : all + " " + word; });
}

/// Takes a label off the end or the beginning of a name: `force run #1`, `2 force`, `specimen a force`.
Labelled labelled(const std::string& name, bool at_the_end) {
  std::vector<std::string> words = words_of(name);
  if (!at_the_end) std::reverse(words.begin(), words.end());
  if (words.size() < 2) return {name, ""};
  std::string label;
  if (is_label(words.back()) || names_specimen(words.back())) {
    label = words.back();
    words.pop_back();
    if (words.size() > 1 && at_the_end && is_specimen_word(words.back())) {
      label = words.back() + " " + label;
      words.pop_back();
    }
  }
  if (!at_the_end && !label.empty() && words.size() > 1 && is_specimen_word(words.back())) return {name, ""};
  if (!at_the_end && label.empty() && words.size() > 2 && is_specimen_word(words.back()) &&
      is_label(words[words.size() - 2])) {
    label = words.back() + " " + words[words.size() - 2];
    words.resize(words.size() - 2);
  }
  if (!at_the_end) std::reverse(words.begin(), words.end());
  return label.empty() ? Labelled{name, ""} : Labelled{joined(words), label};
}

/// `probe 1`, `probe1`; not the number of a load cell.
bool is_specimen_label(std::string_view label) {
  return names_specimen(label) || is_specimen_word(label.substr(0, label.find(' ')));
}

/// Groups by a label in the headings: extension and force must share at least two, but specimens may have one extension
/// for all of their forces.
std::vector<ColumnGroup> groups_by_label(const TableBlock& block, bool at_the_end) {
  std::map<std::string, std::set<Quantity>> quantities;
  std::vector<std::string> order, labels(block.columns.size());
  bool has_shared_extension = false;
  for (std::size_t i = 0; i < block.columns.size(); ++i) {
    if (!is_curve_quantity(block.columns[i])) continue;
    labels[i] = labelled(block.columns[i].name, at_the_end).label;
    if (labels[i].empty()) {
      has_shared_extension = has_shared_extension || block.columns[i].quantity == Quantity::extension;
      continue;
    }
    if (!quantities.contains(labels[i])) order.push_back(labels[i]);
    quantities[labels[i]].insert(*block.columns[i].quantity);
  }
  std::vector<ColumnGroup> groups;
  for (const std::string& label : order) {
    const auto& held = quantities[label];
    const bool shares = !held.contains(Quantity::extension) && has_shared_extension && is_specimen_label(label);
    if ((!held.contains(Quantity::extension) && !shares) || !held.contains(Quantity::force)) continue;
    ColumnGroup group{label, {}, shares};
    for (std::size_t i = 0; i < block.columns.size(); ++i) {
      if (labels[i] == label || labels[i].empty()) group.columns.push_back(i);
    }
    groups.push_back(std::move(group));
  }
  return groups.size() > 1 ? groups : std::vector<ColumnGroup>{};
}

/// What a heading shares with its like in another group.
std::string key_of(const ColumnName& name) {
  return std::string(without_count(name.name)) + "|" + bare_unit(name.unit);
}

/// Groups by headings that occur again, named by the labels in a line above.
std::vector<ColumnGroup> groups_by_occurrence(const TableBlock& block) {
  std::map<std::string, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < block.columns.size(); ++i) {
    if (is_curve_quantity(block.columns[i])) places[key_of(block.columns[i])].push_back(i);
  }
  std::size_t of_extension = 1, of_force = 1;
  for (const auto& [name, columns] : places) {
    const Quantity quantity = *block.columns[columns.front()].quantity;
    if (quantity == Quantity::extension) of_extension = std::max(of_extension, columns.size());
    if (quantity == Quantity::force) of_force = std::max(of_force, columns.size());
  }
  const std::size_t count = std::min(of_extension, of_force);
  if (count < 2 || of_extension != of_force) return {};
  std::vector<ColumnGroup> groups(count);
  for (const auto& [name, columns] : places) {
    for (std::size_t g = 0; g < count; ++g) {
      if (columns.size() == count) groups[g].columns.push_back(columns[g]);
      if (columns.size() == 1) groups[g].columns.push_back(columns[0]);
    }
  }
  for (std::size_t g = 0; g < count; ++g) {
    std::sort(groups[g].columns.begin(), groups[g].columns.end());
    groups[g].name = std::to_string(g + 1);
    std::size_t first = block.columns.size();  // of the columns that are this group's alone
    for (const std::size_t column : groups[g].columns) {
      if (places[key_of(block.columns[column])].size() == count) first = std::min(first, column);
    }
    for (std::size_t i = std::min(first, block.labels.size() - !block.labels.empty()) + 1;
         i-- > 0 && !block.labels.empty();) {
      if (block.labels[i].empty()) continue;
      groups[g].name = block.labels[i];
      break;
    }
  }
  std::set<std::string> names;
  for (const ColumnGroup& group : groups) names.insert(group.name);
  if (names.size() == count) return groups;
  for (std::size_t g = 0; g < count; ++g) groups[g].name = std::to_string(g + 1);
  return groups;
}

/// Groups of columns whose names repeat in one order, whatever their units: `Time;Load;Time;Load`.
std::vector<ColumnGroup> groups_by_period(const TableBlock& block) {
  std::vector<std::size_t> named;
  for (std::size_t i = 0; i < block.columns.size(); ++i) {
    if (!block.columns[i].heading.empty()) named.push_back(i);
  }
  const auto name_of = [&](std::size_t place) { return without_count(block.columns[named[place]].name); };
  for (std::size_t period = 2; 2 * period <= named.size(); ++period) {
    if (named.size() % period != 0) continue;
    bool repeats = true, has_extension = false, has_force = false;
    for (std::size_t i = 0; i < named.size() && repeats; ++i) repeats = name_of(i) == name_of(i % period);
    for (std::size_t i = 0; i < period; ++i) {
      has_extension = has_extension || block.columns[named[i]].quantity == Quantity::extension;
      has_force = has_force || block.columns[named[i]].quantity == Quantity::force;
    }
    if (!repeats || !has_extension || !has_force) continue;
    std::vector<ColumnGroup> groups;
    for (std::size_t first = 0; first < named.size(); first += period) {
      const std::size_t label = named[first];
      const bool labelled = label < block.labels.size() && !block.labels[label].empty();
      groups.push_back({labelled ? block.labels[label] : std::to_string(groups.size() + 1),
                        {named.begin() + static_cast<std::ptrdiff_t>(first),
                         named.begin() + static_cast<std::ptrdiff_t>(first + period)}});
    }
    return groups;
  }
  return {};
}

}  // namespace

std::vector<ColumnGroup> column_groups(const TableBlock& block, const ColumnChoice& choice) {
  ColumnGroup all{"", std::vector<std::size_t>(block.columns.size())};
  std::iota(all.columns.begin(), all.columns.end(), std::size_t{0});
  const auto is_exact = [&](Quantity quantity) {
    const std::string& wanted = choice.of(quantity);
    return std::count_if(block.columns.begin(), block.columns.end(),
                         [&](const ColumnName& name) { return match(name.heading, name.name, wanted) >= 2; }) == 1;
  };
  // Who names both columns exactly has chosen the specimen.
  if (is_exact(Quantity::extension) && is_exact(Quantity::force)) return {all};
  if (auto groups = groups_by_occurrence(block); !groups.empty()) return groups;
  if (auto groups = groups_by_period(block); !groups.empty()) return groups;
  for (const bool at_the_end : {true, false}) {
    if (auto groups = groups_by_label(block, at_the_end); !groups.empty()) return groups;
  }
  return {all};
}

}  // namespace nacre::measurement
