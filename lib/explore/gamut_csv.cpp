#include "explore/gamut_csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/lines.hpp"
#include "base/result.hpp"
#include "pattern/pattern_key.hpp"

namespace nacre::explore {
namespace {

constexpr std::string_view kHeader = "index,pattern,rigid_fraction,modulus_pa,toughness_pa";
/// Behind them where T is the mean over specimens.
constexpr std::string_view kSamplingHeader = ",toughness_se_pa,specimens";
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// The line that is read, for error messages.
struct CsvPlace {
  std::string_view source;
  std::size_t line = 0;
  InputError error(std::size_t field, std::string_view name, std::string_view found, std::string_view expected) const {
    return InputError::format("{}: line {}, column {} ({}): \"{}\", expected {}", source, line, field + 1, name, found,
                              expected);
  }
};

/// Fields of a line. No field of a gamut holds a comma or a quote, so quotes may only surround a whole field.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (bool more = true; more;) {
    const std::size_t comma = line.find(',');
    std::string_view field = line.substr(0, comma);
    more = comma != std::string_view::npos;
    if (more) line.remove_prefix(comma + 1);
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    fields.push_back(field);
  }
  return fields;
}

/// Positions of the columns that are read.
struct GamutColumns {
  std::size_t count = 0, pattern = 0, modulus = 0, toughness = 0;
  std::optional<std::size_t> toughness_se = {}, specimens = {};
};

GamutColumns columns_of(std::string_view header, std::string_view source) {
  const std::vector<std::string_view> names = fields_of(header);
  const auto position = [&](std::string_view name) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != name) continue;
      if (found) throw InputError::format("{}: line 1, column {}: a second column {}", source, i + 1, name);
      found = i;
    }
    return found;
  };
  const auto required = [&](std::string_view name) {
    const std::optional<std::size_t> found = position(name);
    if (!found)
      throw InputError::format("{}: line 1: no column {}, expected {}{}", source, name, kHeader,
                               other_separator(header));
    return *found;
  };
  return {names.size(),
          required("pattern"),
          required("modulus_pa"),
          required("toughness_pa"),
          position("toughness_se_pa"),
          position("specimens")};
}

double quantity(const std::vector<std::string_view>& fields, std::size_t column, std::string_view name,
                const CsvPlace& place) {
  const std::string_view text = fields[column];
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value) || value < 0.0) {
    throw place.error(column, name, text, "a finite number, not negative");
  }
  return value;
}

Sampling sampling_of(const std::vector<std::string_view>& fields, const GamutColumns& columns, const CsvPlace& place) {
  Sampling sampling;
  if (columns.toughness_se)
    sampling.toughness_se_pa = quantity(fields, *columns.toughness_se, "toughness_se_pa", place);
  if (!columns.specimens) return sampling;
  const std::string_view text = fields[*columns.specimens];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), sampling.specimens);
  if (error != std::errc{} || end != text.data() + text.size() || sampling.specimens < 1)
    throw place.error(*columns.specimens, "specimens", text, "a whole number from 1");
  return sampling;
}

pattern::Pattern pattern_of(const std::vector<std::string_view>& fields, std::size_t column, const CsvPlace& place) {
  const Result<pattern::Pattern> pattern = pattern::pattern_from_key(fields[column]);
  if (!pattern) throw place.error(column, "pattern", fields[column], "the key of a pattern, 14 lower-case hex digits");
  return *pattern;
}

}  // namespace

std::string to_csv(std::span<const Evaluated> gamut) {
  const bool has_sampling =
      std::ranges::any_of(gamut, [](const Evaluated& sample) { return sample.sampling != Sampling{}; });
  std::string csv = fmt::format("{}{}\n", kHeader, has_sampling ? kSamplingHeader : "");
  for (std::size_t i = 0; i < gamut.size(); ++i) {
    const auto& [pattern, performance, sampling] = gamut[i];
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{}", i, pattern.key(), pattern.rigid_fraction(),
                   performance.modulus_pa, performance.toughness_pa);
    if (has_sampling) fmt::format_to(std::back_inserter(csv), ",{},{}", sampling.toughness_se_pa, sampling.specimens);
    csv += '\n';
  }
  return csv;
}

void write_gamut_csv(const std::filesystem::path& path, std::span<const Evaluated> gamut) {
  write_file_atomically(path, to_csv(gamut));
}

std::vector<Evaluated> read_gamut_csv(const std::filesystem::path& path) {
  return gamut_from_csv(read_file(path), path.string());
}

std::vector<Evaluated> gamut_from_csv(std::string_view text, std::string_view source) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.empty()) throw InputError::format("{}: line 1: the file is empty, expected {}", source, kHeader);
  const GamutColumns columns = columns_of(take_line(text), source);
  std::vector<Evaluated> gamut;
  std::unordered_map<std::uint64_t, std::size_t> line_of_pattern;
  for (CsvPlace place{source, 2}; !text.empty(); ++place.line) {
    const std::string_view line = take_line(text);
    if (line.empty()) continue;
    const std::vector<std::string_view> fields = fields_of(line);
    if (fields.size() != columns.count) {
      throw InputError::format("{}: line {}, column {}: the row has {} fields, expected {}", source, place.line,
                               std::min(fields.size(), columns.count) + 1, fields.size(), columns.count);
    }
    const pattern::Pattern pattern = pattern_of(fields, columns.pattern, place);
    const auto [earlier, is_new] = line_of_pattern.emplace(pattern.bits(), place.line);
    if (!is_new) {
      throw place.error(columns.pattern, "pattern", pattern.key(),
                        fmt::format("each pattern once: it stands in line {} already", earlier->second));
    }
    gamut.push_back({pattern,
                     {quantity(fields, columns.modulus, "modulus_pa", place),
                      quantity(fields, columns.toughness, "toughness_pa", place)},
                     sampling_of(fields, columns, place)});
  }
  return gamut;
}

}  // namespace nacre::explore
