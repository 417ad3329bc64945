#include "laboratory/laboratory_file.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <toml++/toml.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "base/toml_file.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "material/criterion_strengths.hpp"
#include "material/parameter_file.hpp"
#include "measurement/limits.hpp"

namespace nacre::laboratory {
namespace {

constexpr std::string_view kDraw = "draw";
constexpr std::size_t kMostEffects = 2;

InputError fault_at(std::string_view source, const toml::node& node, std::string_view key,
                    const std::string& expected) {
  const std::string value = node.is_value() ? " = " + shown(node) : "";
  return InputError::format("{}: {}{}: expected {}", place(source, node), key, value, expected);
}

/// A table of which every key must be asked for, so that unknown ones are found.
class Section {
 public:
  Section(const toml::table& table, std::string_view source, std::string prefix)
      : table_(table), source_(source), prefix_(std::move(prefix)) {}

  const toml::node* find(std::string_view key) {
    if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
    return table_.get(key);
  }
  std::string name(std::string_view key) const { return prefix_ + std::string(key); }

  /// The number at `key`, or `otherwise` when the key is absent.
  double number(std::string_view key, double minimum, double maximum, double otherwise) {
    const toml::node* node = find(key);
    if (!node) return otherwise;
    const auto value = node->value<double>();
    if (!node->is_number() || !value || !std::isfinite(*value) || *value < minimum || *value > maximum) {
      throw fault_at(source_, *node, name(key), fmt::format("a number from {} to {}", minimum, maximum));
    }
    return *value;
  }

  std::int64_t integer(std::string_view key, std::int64_t minimum, std::int64_t maximum, std::int64_t otherwise) {
    const toml::node* node = find(key);
    if (!node) return otherwise;
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < minimum || *value > maximum) {
      throw fault_at(source_, *node, name(key), fmt::format("a whole number from {} to {}", minimum, maximum));
    }
    return *value;
  }

  std::string_view text(std::string_view key, std::string_view otherwise) {
    const toml::node* node = find(key);
    if (!node) return otherwise;
    const auto value = node->value_exact<std::string_view>();
    if (!value) throw fault_at(source_, *node, name(key), "text in quotes");
    return *value;
  }

  /// The sub-table at `key`, empty when absent.
  const toml::table& table(std::string_view key) {
    static const toml::table kEmpty;
    const toml::node* node = find(key);
    if (!node) return kEmpty;
    if (!node->is_table()) throw fault_at(source_, *node, name(key), "a table");
    return *node->as_table();
  }

  /// Throws for the first key that nobody asked for.
  void refuse_others() const {
    for (const auto& [key, node] : table_) {
      if (std::ranges::find(known_, key.str()) != known_.end()) continue;
      throw fault_at(source_, node, name(key.str()), fmt::format("one of {}", fmt::join(known_, ", ")));
    }
  }

 private:
  const toml::table& table_;
  std::string_view source_;
  std::string prefix_;
  std::vector<std::string> known_;
};

struct AllowedRange {
  double minimum, maximum;
};

/// Values that the benches can compute with.
AllowedRange range_of(std::string_view parameter) {
  if (parameter.starts_with("nu_")) return {0.0, 0.5};
  if (parameter.starts_with("gamma_")) return {1.0, 1e8};
  if (parameter.starts_with("e_")) return {measurement::kModulusPa.least, measurement::kModulusPa.most};
  return {1.0, 1e12};  // W in J/m^3
}

/// Keys present in the table replace the drawn constants.
template <class Vector>
Vector read_constants(Section& section, std::span<const std::string_view> names, Vector constants) {
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const AllowedRange range = range_of(names[i]);
    constants[i] = section.number(names[i], range.minimum, range.maximum, constants[i]);
  }
  return constants;
}

/// Criterion and variation of strength stand with eta, as in parameter files.
void read_failure(Section& section, const toml::table& table, std::string_view source, Truth& truth) {
  const toml::node* node = section.find("strength_cv");
  truth.strength_cv = section.number("strength_cv", 0.0, material::kLargestStrengthCv, truth.strength_cv);
  if (!material::is_strength_cv(truth.strength_cv))
    throw fault_at(source, *node, "toughness.strength_cv",
                   fmt::format("0 or {} to {}", material::kSmallestStrengthCv, material::kLargestStrengthCv));
  const auto kind = material::criterion_from_string(section.text("criterion", to_string(truth.criterion.kind)));
  if (!kind)
    throw fault_at(source, *section.find("criterion"), "toughness.criterion", "element, neighbourhood or crack_band");
  truth.criterion.kind = *kind;
  truth.criterion.radius_m = section.number("radius_m", 0.0, 1.0, truth.criterion.radius_m);
  truth.criterion.softening = section.number("softening", 0.0, 1e3, truth.criterion.softening);
  const std::string fault = material::criterion_fault(truth.criterion);
  if (!fault.empty()) throw InputError::format("{}: toughness: {}", place(source, table), fault);
}

std::string effect_names() {
  std::vector<std::string_view> names = {kDraw};
  for (const EffectKind& kind : effect_kinds()) names.push_back(kind.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The numbers of an effect that has two.
void read_numbers(const toml::array& numbers, std::string_view source, const EffectKind& kind, HiddenEffects& effects) {
  const auto number = [&](std::size_t i, double minimum, double maximum) {
    const auto value = numbers.get(i) ? numbers.get(i)->value<double>() : std::nullopt;
    if (!value || !(*value >= minimum && *value <= maximum))
      throw fault_at(source, numbers, "effect.value", fmt::format("a number from {} to {}", minimum, maximum));
    return *value;
  };
  if (kind.second.value == nullptr || numbers.size() != 2)
    throw fault_at(source, numbers, "effect.value", kind.second.value ? "two numbers" : "one number");
  effects.*kind.value = number(0, kind.minimum, kind.maximum);
  effects.*kind.second.value = number(1, kind.second.minimum, kind.second.maximum);
}

/// One [[effect]]: a name, and a value, which is drawn when absent or "draw".
void read_effect(const toml::table& table, std::string_view source, std::uint64_t seed, HiddenEffects& effects) {
  Section section(table, source, "effect.");
  const std::string_view name = section.text("name", "");
  const toml::node* value = section.find("value");
  section.refuse_others();
  const auto kind = std::ranges::find(effect_kinds(), name, &EffectKind::name);
  if (name == kDraw && !value) {
    effects = draw_effects(seed);
    return;
  }
  if (kind == effect_kinds().end()) {
    const toml::node* given = table.get("name");
    throw fault_at(source, given ? *given : static_cast<const toml::node&>(table), "effect.name",
                   name == kDraw ? "no value with the name \"draw\"" : "one of " + effect_names());
  }
  const bool drawn = !value || value->value_exact<std::string_view>() == kDraw;
  if (kind->second.value != nullptr) effects.*kind->second.value = draw_second_value(seed, *kind);
  if (const toml::array* numbers = value ? value->as_array() : nullptr) {
    read_numbers(*numbers, source, *kind, effects);
  } else {
    effects.*kind->value =
        drawn ? draw_effect_value(seed, *kind) : section.number("value", kind->minimum, kind->maximum, 0.0);
  }
}

HiddenEffects read_effects(const toml::node* node, std::string_view source, std::uint64_t seed) {
  HiddenEffects effects;
  if (!node) return effects;
  const toml::array* array = node->as_array();
  const bool tables = array && std::ranges::all_of(*array, [](const toml::node& entry) { return entry.is_table(); });
  if (!tables || array->size() > kMostEffects) throw fault_at(source, *node, "effect", "at most two tables [[effect]]");
  std::vector<std::string> seen;
  for (const toml::node& entry : *array) {
    const toml::table& table = *entry.as_table();
    const std::string name = table["name"].value_or(std::string());
    if (std::ranges::find(seen, name) != seen.end() || (name == kDraw && array->size() > 1)) {
      throw fault_at(source, entry, "effect.name", "each effect once, and \"draw\" alone");
    }
    seen.push_back(name);
    read_effect(table, source, seed, effects);
  }
  return effects;
}

template <class Vector>
std::string constants_toml(std::string_view table, std::span<const std::string_view> names, const Vector& constants) {
  std::string text = fmt::format("\n[{}]\n", table);
  for (std::size_t i = 0; i < constants.size(); ++i) text += fmt::format("{} = {}\n", names[i], constants[i]);
  return text;
}

}  // namespace

Truth parse_laboratory(std::string_view text, std::string_view source, std::uint64_t seed) {
  const toml::table document = read_toml(text, source);
  Section top(document, source, "");
  Truth truth;
  truth.seed = static_cast<std::uint64_t>(top.integer("seed", 0, INT64_MAX, seed));
  const std::string_view fidelity_name = top.text("fidelity", "full");
  const Result<tester::Fidelity> fidelity = tester::fidelity_from_string(fidelity_name);
  if (!fidelity) throw fault_at(source, *document.get("fidelity"), "fidelity", "tiny, preview, full or fine");
  truth.fidelity = *fidelity;
  truth.replicates = top.integer("replicates", 1, 1000, truth.replicates);
  Section noise(top.table("noise"), source, "noise.");
  truth.noise.modulus = noise.number("modulus", 0.0, 0.5, truth.noise.modulus);
  truth.noise.toughness = noise.number("toughness", 0.0, 0.5, truth.noise.toughness);
  truth.noise.strain = noise.number("strain", 0.0, 0.5, truth.noise.strain);
  noise.refuse_others();
  truth.effects = read_effects(top.find("effect"), source, truth.seed);
  Section modulus(top.table("modulus"), source, "modulus."), toughness(top.table("toughness"), source, "toughness.");
  truth.modulus = material::modulus_from_vector(read_constants(
      modulus, material::modulus_parameter_names(), material::to_vector(draw_modulus_parameters(truth.seed))));
  modulus.refuse_others();
  Section coupons(top.table("coupons"), source, "coupons.");
  truth.coupons = {.soft = coupons.number("soft", 0.1, 10.0, 1.0),
                   .rigid = coupons.number("rigid", 0.1, 10.0, 1.0),
                   .interface = coupons.number("interface", 0.1, 10.0, 1.0)};
  coupons.refuse_others();
  truth.criterion = material::base_criterion();
  truth.strength_cv = draw_strength_cv(truth.seed);
  read_failure(toughness, top.table("toughness"), source, truth);
  const material::ToughnessParameters drawn =
      material::with_strengths(draw_toughness_parameters(truth.seed), material::strength_ratio(truth.criterion));
  truth.toughness = material::toughness_from_vector(
      read_constants(toughness, material::toughness_parameter_names(), material::to_vector(drawn)));
  toughness.refuse_others();
  top.refuse_others();
  return truth;
}

Truth read_laboratory(const std::filesystem::path& path, std::uint64_t seed) {
  return parse_laboratory(read_file(path), path.string(), seed);
}

std::string to_toml(const Truth& truth) {
  std::string text = fmt::format("seed = {}\nfidelity = \"{}\"\nreplicates = {}\n", truth.seed,
                                 tester::to_string(truth.fidelity), truth.replicates);
  text += fmt::format("\n[noise]  # relative standard deviations\nmodulus = {}\ntoughness = {}\nstrain = {}\n",
                      truth.noise.modulus, truth.noise.toughness, truth.noise.strain);
  for (const EffectKind& kind : effect_kinds()) {
    if (truth.effects.*kind.value == 0.0) continue;
    const std::string value = kind.second.value
                                  ? fmt::format("[{}, {}]  # {}, {}", truth.effects.*kind.value,
                                                truth.effects.*kind.second.value, kind.unit, kind.second.unit)
                                  : fmt::format("{}  # {}", truth.effects.*kind.value, kind.unit);
    text += fmt::format("\n[[effect]]  # {}{}\nname = \"{}\"\nvalue = {}\n", kind.meaning,
                        kind.in_library       ? ""
                        : kind.family.empty() ? "; outside the library of the diagnosis"
                                              : "; another form of an effect of the library",
                        kind.name, value);
  }
  text += constants_toml("modulus", material::modulus_parameter_names(), material::to_vector(truth.modulus));
  if (truth.coupons != CouponRatios{})
    text += fmt::format(
        "\n[coupons]  # E of homogeneous specimens over E in layouts\nsoft = {}\nrigid = {}\ninterface = {}\n",
        truth.coupons.soft, truth.coupons.rigid, truth.coupons.interface);
  text += constants_toml("toughness", material::toughness_parameter_names(), material::to_vector(truth.toughness));
  text += material::failure_toml(truth.criterion, truth.strength_cv);
  return text;
}

void write_sealed(const std::filesystem::path& path, const Truth& truth) {
  write_file_atomically(
      path, "# The hidden truth of a virtual laboratory. Sealed: only the laboratory and the scoring read it.\n" +
                to_toml(truth));
  if (::chmod(path.c_str(), 0400) != 0) throw InputError::format("{}: cannot be sealed (mode 0400)", path.string());
}

}  // namespace nacre::laboratory
