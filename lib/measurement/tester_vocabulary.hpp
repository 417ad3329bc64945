#pragma once
// Words of headings as testing machines write them in English, German, French, Spanish, Italian, Japanese and Chinese,
// and units. Names are plain_words(): lower case, accents spelt out.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

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

/// Words after which a column is no measurement of the test's course (`maximum`, `rate`, `date`).
std::span<const std::string_view> other_words();
/// Words of each role; those that end or begin a compound word (Kraftsollwert) count, too.
std::span<const std::string_view> set_point_words();
std::span<const std::string_view> raw_words();
std::span<const std::string_view> lateral_words();
/// Words that name what was measured (`Istwert`, `actual`), or the specimen's axis.
std::span<const std::string_view> preferred_words();
/// Names of a column that tells which specimen a row belongs to.
std::span<const std::string_view> specimen_words();

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
