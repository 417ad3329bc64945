#include "offline/ask_tell.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>

#include "base/files.hpp"
#include "base/hash.hpp"
#include "base/lines.hpp"
#include "base/parallel.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"
#include "explore/mechanics.hpp"
#include "material/parameter_file.hpp"
#include "offline/json_parts.hpp"
#include "pattern/pattern_key.hpp"
#include "store/kept_simulation.hpp"
#include "tester/strength_field.hpp"

namespace nacre::offline {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// The object in a line. Throws InputError.
json object_in(std::string_view line) {
  json object = json::parse(line, nullptr, false);
  if (!object.is_object()) throw InputError("it is no JSON object");
  return object;
}

/// Throws InputError for a member that has none of these names: a name that is misspelt must not be passed over.
void check_members(const json& object, const std::set<std::string>& names) {
  for (const auto& [name, value] : object.items())
    if (!names.contains(name))
      throw InputError::format("`{}`: no such member, expected {}", name, fmt::join(names, ", "));
}

const json& member(const json& object, const std::string& name) {
  const auto found = object.find(name);
  if (found == object.end()) throw InputError::format("no member `{}`", name);
  return *found;
}

pattern::Pattern pattern_in(const json& value) {
  const auto pattern = pattern::pattern_from_key(value.is_string() ? value.get<std::string>() : value.dump());
  if (!pattern) throw InputError(pattern.error().message);
  return *pattern;
}

/// Patterns of a list that is not empty, each once.
std::vector<pattern::Pattern> patterns_in(const json& list) {
  if (!list.is_array() || list.empty()) throw InputError("`patterns`: expected a list of keys");
  std::vector<pattern::Pattern> patterns;
  for (const json& each : list) {
    patterns.push_back(pattern_in(each));
    if (std::ranges::count(patterns, patterns.back()) > 1)
      throw InputError::format("pattern {}: expected once", patterns.back().key());
  }
  return patterns;
}

int whole_number(const json& object, const std::string& name, int otherwise, int least, int most) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_number_integer() || *found < least || *found > most)
    throw InputError::format("`{}` = {}: expected a whole number from {} to {}", name, found->dump(), least, most);
  return found->get<int>();
}

double quantity(const json& value, const std::string& name) {
  if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0.0)
    throw InputError::format("`{}` = {}: expected a number in Pa, not negative", name, value.dump());
  return value.get<double>();
}

/// A sample as it is told, and as `test` answers it; nothing in place of a performance where it has an `error`.
std::pair<pattern::Pattern, std::optional<explore::Evaluated>> sample_in(const json& sample) {
  if (!sample.is_object()) throw InputError("`samples`: expected a list of objects");
  check_members(sample, {"pattern", "modulus_pa", "toughness_pa", "toughness_se_pa", "toughness_sd_pa", "specimens",
                         "first_specimen", "error"});
  const pattern::Pattern pattern = pattern_in(member(sample, "pattern"));
  if (sample.contains("error")) return {pattern, std::nullopt};
  explore::Evaluated evaluated{
      pattern,
      {quantity(member(sample, "modulus_pa"), "modulus_pa"), quantity(member(sample, "toughness_pa"), "toughness_pa")}};
  constexpr int kMost = 1'000'000;
  evaluated.sampling.specimens = whole_number(sample, "specimens", 1, 1, kMost);
  if (const auto error = sample.find("toughness_se_pa"); error != sample.end() && !error->is_null())
    evaluated.sampling.toughness_se_pa = quantity(*error, "toughness_se_pa");
  return {pattern, evaluated};
}

ordered_json told_json(const pattern::Pattern& pattern, const std::optional<explore::Evaluated>& told) {
  if (!told) return {{"pattern", pattern.key()}, {"error", "no result"}};
  return {{"pattern", pattern.key()},
          {"modulus_pa", told->performance.modulus_pa},
          {"toughness_pa", told->performance.toughness_pa},
          {"specimens", told->sampling.specimens},
          {"toughness_se_pa", told->sampling.toughness_se_pa}};
}

ordered_json keys_of(const std::vector<pattern::Pattern>& patterns) {
  ordered_json keys = ordered_json::array();
  for (const pattern::Pattern& pattern : patterns) keys.push_back(pattern.key());
  return keys;
}

ExploreSettings with_mechanics(ExploreSettings settings) {
  settings.search.mechanics = explore::mechanics_by_tester(settings.parameters, settings.fidelity, 0);
  return settings;
}

}  // namespace

AskTell::AskTell(const ExploreSettings& settings, const std::filesystem::path& log, std::function<bool()> stopped)
    : settings_(with_mechanics(settings)),
      stopped_(std::move(stopped)),
      search_(explore::make_search(settings_.search)),
      batches_(settings_.batches, settings_.search, model_identity(settings_)) {
  if (!settings_.cache.empty()) cache_ = std::make_unique<store::SimulationCache>(settings_.cache);
  if (std::filesystem::exists(log)) read_log(log);
  log_.open(log, std::ios::app);
  if (!log_) throw InputError::format("{}: cannot be written", log.string());
  if (batch_.empty() && batches_.left() > 0) ask_search();
}

ordered_json AskTell::standing() const {
  return {
      {"evaluated", search_->evaluated().size()},
      {"asks_left", settings_.search.budget - asked_},
      {"tests_left", settings_.search.budget - static_cast<int>(tests_.size())},
      {"awaited", keys_of(awaited())},
      {"hypervolume_gpa_mpa", optimize::hypervolume_staircase_gpa_mpa(explore::performances_of(search_->evaluated()))}};
}

ordered_json AskTell::respond(std::string_view line, std::size_t number) {
  try {
    const json request = object_in(line);
    const json& kind = member(request, "request");
    if (kind == "ask") {
      check_members(request, {"request"});
      return ask();
    }
    if (kind == "tell") return tell(request);
    if (kind == "test") return test(request);
    throw InputError::format("`request` = {}: expected \"ask\", \"tell\" or \"test\"", kind.dump());
  } catch (const InputError& error) {
    return {{"error", fmt::format("line {}: {}", number, error.what())}};
  }
}

ordered_json AskTell::ask() {
  if (batch_.empty()) ask_search();
  return {{"patterns", keys_of(awaited())}};
}

ordered_json AskTell::tell(const json& request) {
  check_members(request, {"request", "samples"});
  const json& samples = member(request, "samples");
  if (!samples.is_array()) throw InputError("`samples`: expected a list");
  std::map<pattern::Pattern, Told> told;
  for (const json& each : samples) {
    const auto [pattern, sample] = sample_in(each);
    if (!awaits(pattern)) throw InputError::format("pattern {}: is not awaited, expected one asked for", pattern.key());
    if (!told.emplace(pattern, sample).second) throw InputError::format("pattern {}: expected once", pattern.key());
  }
  for (const auto& [pattern, sample] : told) {
    keep({{"told", told_json(pattern, sample)}});
    take(pattern, sample);
  }
  return standing();
}

ordered_json AskTell::test(const json& request) {
  check_members(request, {"request", "patterns", "specimens", "first_specimen"});
  const std::vector<pattern::Pattern> patterns = patterns_in(member(request, "patterns"));
  constexpr int kMost = 1'000'000;
  const int count = whole_number(request, "specimens", 1, 1, kMost);
  const int first = whole_number(request, "first_specimen", 0, 0, kMost);
  if (first + count > 1 && !tester::specimens_differ(settings_.parameters))
    throw InputError("`specimens`: without strength_cv all are alike, expected the first alone");
  std::vector<Specimen> wanted;
  for (const pattern::Pattern& pattern : patterns)
    for (int number = first; number < first + count; ++number)
      if (!tests_.contains({pattern, number})) wanted.emplace_back(pattern, number);
  const auto left = settings_.search.budget - static_cast<int>(tests_.size());
  if (static_cast<int>(wanted.size()) > left)
    throw InputError::format("{} fracture tests wanted, {} are left of the budget", wanted.size(), left);
  test_specimens(wanted);
  ordered_json samples = ordered_json::array();
  if (!stopped_ || !stopped_())
    for (const pattern::Pattern& pattern : patterns) samples.push_back(sample_of(pattern, first, count));
  return {{"samples", samples}, {"tests_left", settings_.search.budget - static_cast<int>(tests_.size())}};
}

void AskTell::test_specimens(const std::vector<Specimen>& wanted) {
  parallel_for(static_cast<int>(wanted.size()), [&](int i) {
    if (stopped_ && stopped_()) return;
    const auto& [pattern, number] = wanted[static_cast<std::size_t>(i)];
    const auto performance = store::kept_performance({.design = pattern,
                                                      .parameters = settings_.parameters,
                                                      .conditions = {},
                                                      .fidelity = settings_.fidelity,
                                                      .specimen = number},
                                                     cache_.get());
    ordered_json line{{"pattern", pattern.key()}, {"specimen", number}};
    if (performance) {
      line["modulus_pa"] = performance->modulus_pa;
      line["toughness_pa"] = performance->toughness_pa;
    }
    const std::lock_guard lock(mutex_);
    tests_[{pattern, number}] = performance;
    keep({{"tested", line}});
  });
}

ordered_json AskTell::sample_of(const pattern::Pattern& pattern, int first, int count) const {
  double modulus_pa = 0.0;
  std::vector<double> toughness_pa;
  for (int number = first; number < first + count; ++number) {
    const auto& performance = tests_.at({pattern, number});
    if (!performance) return {{"pattern", pattern.key()}, {"error", fmt::format("specimen {}: no result", number)}};
    modulus_pa = performance->modulus_pa;
    toughness_pa.push_back(performance->toughness_pa);
  }
  std::optional<double> sd_pa, se_pa;
  if (count > 1) sd_pa = standard_deviation(toughness_pa), se_pa = *sd_pa / std::sqrt(static_cast<double>(count));
  return {{"pattern", pattern.key()},
          {"modulus_pa", modulus_pa},
          {"toughness_pa", mean(toughness_pa)},
          {"toughness_sd_pa", or_null(sd_pa)},
          {"toughness_se_pa", or_null(se_pa)},
          {"specimens", count},
          {"first_specimen", first}};
}

void AskTell::ask_search() {
  batch_ = batches_.ask(*search_);
  asked_ += static_cast<int>(batch_.size());
}

void AskTell::take(const pattern::Pattern& pattern, const Told& told) {
  told_[pattern] = told;
  if (told_.size() < batch_.size()) return;
  std::vector<std::optional<optimize::Performance>> performances;
  std::vector<explore::Sampling> samplings;
  for (const pattern::Pattern& each : batch_) {
    const Told& sample = told_.at(each);
    performances.push_back(sample ? std::optional(sample->performance) : std::nullopt);
    samplings.push_back(sample ? sample->sampling : explore::Sampling{});
  }
  search_->tell(performances, samplings);
  batch_.clear();
  told_.clear();
}

bool AskTell::awaits(const pattern::Pattern& pattern) const {
  return std::ranges::count(batch_, pattern) > 0 && !told_.contains(pattern);
}

std::vector<pattern::Pattern> AskTell::awaited() const {
  std::vector<pattern::Pattern> patterns;
  std::ranges::copy_if(batch_, std::back_inserter(patterns), [this](const auto& each) { return awaits(each); });
  return patterns;
}

void AskTell::read_log(const std::filesystem::path& log) {
  std::string text = read_file(log);
  if (!text.ends_with('\n')) {  // cut off by a crash
    text.resize(text.rfind('\n') + 1);
    write_file_atomically(log, text);
  }
  std::size_t number = 0;
  for (const std::string_view line : lines_in(text)) {
    ++number;
    try {
      const json object = object_in(line);
      if (object.contains("tested")) {
        const json& test = object["tested"];
        const Specimen specimen{pattern_in(member(test, "pattern")), whole_number(test, "specimen", 0, 0, 1 << 30)};
        tests_[specimen] = std::nullopt;
        if (test.contains("toughness_pa"))
          tests_[specimen] = optimize::Performance{quantity(member(test, "modulus_pa"), "modulus_pa"),
                                                   quantity(test["toughness_pa"], "toughness_pa")};
        continue;
      }
      if (batch_.empty()) ask_search();
      const auto [pattern, sample] = sample_in(member(object, "told"));
      if (!awaits(pattern)) throw InputError::format("pattern {}: was not asked for", pattern.key());
      take(pattern, sample);
    } catch (const InputError& error) {
      throw InputError::format("{}: line {}: {}", log.string(), number, error.what());
    }
  }
}

void AskTell::keep(const ordered_json& line) {
  log_ << line.dump() << '\n' << std::flush;
  if (!log_) throw InputError("the log of the conversation cannot be written");
}

std::vector<explore::Evaluated> AskTell::gamut() const {
  std::vector<explore::Evaluated> gamut = search_->evaluated();
  std::set<pattern::Pattern> known;
  for (const explore::Evaluated& sample : gamut) known.insert(sample.pattern);
  std::map<pattern::Pattern, std::vector<optimize::Performance>> tested;
  for (const auto& [specimen, performance] : tests_)
    if (performance && !known.contains(specimen.first)) tested[specimen.first].push_back(*performance);
  for (const auto& [pattern, specimens] : tested) {
    std::vector<double> toughness_pa;
    for (const optimize::Performance& each : specimens) toughness_pa.push_back(each.toughness_pa);
    const auto count = static_cast<int>(specimens.size());
    gamut.push_back({pattern,
                     {specimens.front().modulus_pa, mean(toughness_pa)},
                     {count, standard_deviation(toughness_pa) / std::sqrt(static_cast<double>(count))}});
  }
  return gamut;
}

}  // namespace nacre::offline
