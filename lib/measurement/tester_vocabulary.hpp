#pragma once
// Words of headings as testing machines write them in English, German, French, Spanish, Italian, Japanese and Chinese,
// and units. Names are plain_words(): lower case, accents spelt out.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "measurement/word_finder.hpp"

namespace nacre::measurement {

enum class Quantity { time, extension, force, strain, stress };
inline constexpr std::size_t kQuantities = 5;
std::string_view to_string(Quantity quantity);

/// What a column of a quantity holds.
enum class ColumnRole {
  measured,
  raw,        ///< counts or volts, not calibrated
  set_point,  ///< what the controller asked for
  lateral,    ///< across the specimen
};

/// A name of a quantity: a heading is it, or holds it as whole words.
struct NamedQuantity {
  Quantity quantity;
  std::string_view word;
  int rank;  ///< among columns of one quantity the smallest is preferred
};

std::span<const NamedQuantity> quantity_names();

/// A name of a quantity in a heading, and the byte where it begins.
struct FoundQuantity {
  const NamedQuantity* name = nullptr;
  std::size_t begin = 0;
};
std::vector<FoundQuantity> quantities_in(std::string_view name);

/// Words after which a column is no measurement of the test's course (`maximum`, `rate`, `date`).
const WordFinder& other_words();
/// Words of each role; those that end or begin a compound word (Kraftsollwert) count, too.
const WordFinder& set_point_words();
const WordFinder& raw_words();
const WordFinder& lateral_words();
/// Words that name what was measured (`Istwert`, `actual`), or the specimen's axis.
const WordFinder& preferred_words();
/// Names of a column that tells which specimen a row belongs to.
const WordFinder& specimen_words();

/// Words beside a quantity's name that leave its meaning (`channel`, `total`): any other word is a qualifier.
const WordFinder& harmless_words();
/// Whether a cell is the name of a statistic over specimens or rows (`Mean`, `SD`).
bool is_statistic(std::string_view words);

/// Whether `text` holds `word` between letters that are no Latin ones; Japanese and Chinese words stand anywhere.
bool holds_word(std::string_view text, std::string_view word);

/// Factor from a unit in plain words to s, mm, N, 1 (strain) or Pa; nothing when the quantity has no such unit.
std::optional<double> named_unit(Quantity quantity, std::string_view unit);
/// Whether it is a unit of any quantity, or of a signal that is not calibrated (V, counts).
bool is_unit(std::string_view unit);
bool is_raw_unit(std::string_view unit);

/// How many Japanese or Chinese words of headings `text` holds.
std::size_t east_asian_words(std::string_view text);

}  // namespace nacre::measurement
