#include "material/parameter_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/toml_file.hpp"
#include "material/criterion_strengths.hpp"
#include "material/effect_library.hpp"

namespace nacre::material {
namespace {

/// Errors that name the place in the file.
struct FilePlace {
  std::string file;
  [[nodiscard]] InputError error(const toml::node& node, std::string_view key, std::string_view expected) const {
    const std::string value = node.is_value() ? " = " + shown(node) : "";
    return InputError::format("{}: {}{}: {}", place(file, node), key, value, expected);
  }
};

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

double positive_number(const FilePlace& place, const toml::node& node, const std::string& key, bool is_poisson) {
  const std::optional<double> value = node.value<double>();
  const bool usable = value && std::isfinite(*value) && (is_poisson ? *value >= 0.0 && *value <= 0.5 : *value > 0.0);
  if (!usable)
    throw place.error(node, key, is_poisson ? "expected a number from 0 to 0.5" : "expected a positive finite number");
  return *value;
}

/// Overwrites the values that the table names. `also`: keys of the table that were read before, for errors.
template <class Vector>
void read_values(const FilePlace& place, const toml::node& node, std::string_view table_name,
                 std::span<const std::string_view> names, Vector& vector, std::string_view also = "") {
  const toml::table* table = node.as_table();
  if (table == nullptr) throw place.error(node, table_name, "expected a table");
  for (const auto& [key, value] : *table) {
    const auto found = std::find(names.begin(), names.end(), key.str());
    const std::string path = fmt::format("{}.{}", table_name, key.str());
    if (found == names.end())
      throw place.error(value, path, fmt::format("unknown key, expected one of {}{}", joined(names), also));
    vector[found - names.begin()] = positive_number(place, value, path, key.str().starts_with("nu_"));
  }
}

std::vector<double> extension_values(const FilePlace& place, const toml::node& node, const std::string& path,
                                     const Effect& effect) {
  std::vector<const toml::node*> entries;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& entry : *array) entries.push_back(&entry);
  } else {
    entries.push_back(&node);
  }
  if (!effect.takes(entries.size()))
    throw place.error(node, path, fmt::format("expected {} number(s)", effect.parameters.size()));
  std::vector<double> values;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const EffectParameter& parameter = effect.parameter(i);
    const std::optional<double> value = entries[i]->value<double>();
    if (!value || !parameter.allows(*value))
      throw place.error(*entries[i], path, fmt::format("expected {} ({})", parameter.range(), parameter.unit));
    values.push_back(*value);
  }
  return values;
}

void read_extensions(const FilePlace& place, const toml::node& node, Extensions& extensions) {
  const toml::table* table = node.as_table();
  if (table == nullptr) throw place.error(node, "extension", "expected tables [extension.NAME]");
  for (const auto& [name, content] : *table) {
    const std::string path = fmt::format("extension.{}", name.str());
    const Effect* effect = find_effect(name.str());
    if (effect == nullptr) {
      std::vector<std::string_view> known;
      for (const Effect& entry : effect_library()) known.push_back(entry.name);
      throw place.error(content, path, fmt::format("unknown extension, expected one of {}", joined(known)));
    }
    const toml::table* values = content.as_table();
    if (values == nullptr || !values->contains("value"))
      throw place.error(content, path, "expected a table with the key value");
    for (const auto& [key, value] : *values) {
      if (key.str() != "value")
        throw place.error(value, path + "." + std::string(key.str()), "unknown key, expected value");
      extensions[std::string(name.str())] = extension_values(place, value, path + ".value", *effect);
    }
  }
}

/// The keys of [toughness] that are none of eta.
struct FailureKeys {
  FailureCriterion criterion;
  double strength_cv = 0.0;
};
constexpr std::string_view kFailureKeys[] = {"strength_cv", "criterion", "radius_m", "softening"};

/// Takes these keys out of the table: what is left is eta.
FailureKeys take_failure_keys(const FilePlace& place, toml::table& table, FailureKeys keys) {
  const auto number = [&](std::string_view key, double& value) {
    const toml::node* node = table.get(key);
    if (node == nullptr) return;
    const std::optional<double> given = node->value<double>();
    if (!given) throw place.error(*node, fmt::format("toughness.{}", key), "expected a number");
    value = *given;
  };
  number("strength_cv", keys.strength_cv);
  number("radius_m", keys.criterion.radius_m);
  number("softening", keys.criterion.softening);
  if (!is_strength_cv(keys.strength_cv))
    throw place.error(*table.get("strength_cv"), "toughness.strength_cv",
                      fmt::format("expected 0 or {} to {}", kSmallestStrengthCv, kLargestStrengthCv));
  if (const toml::node* node = table.get("criterion")) {
    const auto kind = criterion_from_string(node->value_or(std::string()));
    if (!kind) throw place.error(*node, "toughness", kind.error().message);
    keys.criterion.kind = *kind;
  }
  if (const std::string fault = criterion_fault(keys.criterion); !fault.empty())
    throw place.error(table, "toughness", fault);
  for (const std::string_view key : kFailureKeys) table.erase(key);
  return keys;
}

template <class Vector>
std::string table_text(std::string_view name, std::span<const std::string_view> names, const Vector& vector) {
  std::string text = fmt::format("[{}]\n", name);
  for (std::size_t i = 0; i < vector.size(); ++i) text += fmt::format("{} = {}\n", names[i], vector[i]);
  return text;
}

}  // namespace

ParameterSet read_parameters(const std::filesystem::path& path, const ParameterSet& start) {
  return parameters_from_toml(read_file(path), path.string(), start);
}

ParameterSet parameters_from_toml(std::string_view text, std::string_view source, const ParameterSet& start) {
  const FilePlace place{std::string(source)};
  toml::table file = read_toml(text, source);
  ModulusVector modulus = to_vector(start.modulus);
  Extensions extensions = start.extensions;
  FailureKeys failure{start.criterion, start.strength_cv};
  if (toml::table* table = file["toughness"].as_table()) failure = take_failure_keys(place, *table, failure);
  const double strengths = strength_ratio(failure.criterion) / strength_ratio(start.criterion);
  ToughnessVector toughness = to_vector(with_strengths(start.toughness, strengths));
  for (const auto& [key, node] : file) {
    if (key.str() == "modulus")
      read_values(place, node, "modulus", modulus_parameter_names(), modulus);
    else if (key.str() == "toughness")
      read_values(place, node, "toughness", toughness_parameter_names(), toughness, ", " + joined(kFailureKeys));
    else if (key.str() == "extension")
      read_extensions(place, node, extensions);
    else
      throw place.error(node, key.str(), "unknown table, expected modulus, toughness or extension.NAME");
  }
  return {.modulus = modulus_from_vector(modulus),
          .toughness = toughness_from_vector(toughness),
          .extensions = extensions,
          .criterion = failure.criterion,
          .strength_cv = failure.strength_cv};
}

std::string failure_toml(const FailureCriterion& criterion, double strength_cv) {
  std::string text = fmt::format("strength_cv = {}\ncriterion = \"{}\"\n", strength_cv, to_string(criterion.kind));
  if (criterion.kind == CriterionKind::neighbourhood) text += fmt::format("radius_m = {}\n", criterion.radius_m);
  if (criterion.kind == CriterionKind::crack_band) text += fmt::format("softening = {}\n", criterion.softening);
  return text;
}

std::string to_toml(const ParameterSet& parameters) {
  std::string text = table_text("modulus", modulus_parameter_names(), to_vector(parameters.modulus)) + "\n" +
                     table_text("toughness", toughness_parameter_names(), to_vector(parameters.toughness)) +
                     failure_toml(parameters.criterion, parameters.strength_cv);
  for (const auto& [name, values] : parameters.extensions) {
    text += fmt::format("\n[extension.{}]\n", name);
    text += values.size() == 1 ? fmt::format("value = {}\n", values[0])
                               : fmt::format("value = [{}]\n", fmt::join(values, ", "));
  }
  return text;
}

}  // namespace nacre::material
