#include "dashboard/entries.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/base64.hpp"
#include "base/csv.hpp"
#include "base/names.hpp"
#include "families/families_file.hpp"
#include "families/grouping.hpp"
#include "measurement/typed_specimen.hpp"
#include "pattern/design.hpp"
#include "pattern/pattern_key.hpp"

namespace nacre::dashboard {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestText = 500;
constexpr int kLastRound = 1'000'000;
constexpr int kDeepest = 4;

/// A value as it was typed, for errors; long ones cut.
std::string typed(const Json& value) {
  constexpr std::size_t kMostShown = 60;
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kMostShown ? text : text.substr(0, kMostShown) + "...";
}

/// The object in `text`; nested values are refused before they are built.
Result<Json> object_in(std::string_view text) {
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= kDeepest; };
  const Json document = Json::parse(text, shallow, false);
  if (!document.is_object()) return fail("the request is no JSON object");
  return document;
}

/// A short text without control characters; empty when the member is absent.
Result<std::string> text_of(const Json& object, const char* name, bool required = false) {
  const auto found = object.find(name);
  if (found == object.end() || found->is_null()) {
    if (required) return fail("{}: is missing, expected a text", name);
    return std::string();
  }
  if (!found->is_string()) return fail("{}: {}, expected a text", name, typed(*found));
  const auto& text = found->get_ref<const std::string&>();
  if (text.size() > kLongestText) return fail("{}: has {} bytes, expected at most {}", name, text.size(), kLongestText);
  if (std::ranges::any_of(text, is_control)) return fail("{}: holds a control character", name);
  if (required && text.find_first_not_of(' ') == std::string::npos) return fail("{}: is empty, expected a text", name);
  return text;
}

/// A text of several lines; empty when the member is absent.
Result<std::string> lines_of(const Json& object, const char* name, std::size_t most_bytes) {
  const auto found = object.find(name);
  if (found == object.end() || found->is_null()) return std::string();
  if (!found->is_string()) return fail("{}: {}, expected a text", name, typed(*found));
  const auto& text = found->get_ref<const std::string&>();
  if (text.size() > most_bytes) return fail("{}: has {} bytes, expected at most {}", name, text.size(), most_bytes);
  if (std::ranges::any_of(text, [](char letter) { return is_control(letter) && letter != '\n'; }))
    return fail("{}: holds a control character", name);
  return text;
}

/// The bytes of a photo; empty when there is none.
Result<std::string> photo_of(const Json& object) {
  const auto found = object.find("photo");
  if (found == object.end() || found->is_null()) return std::string();
  if (!found->is_string()) return fail("photo: {}, expected base64", typed(*found));
  auto bytes = bytes_of_base64(found->get_ref<const std::string&>());
  if (!bytes) return fail("photo: is no base64");
  if (bytes->empty()) return std::string();
  if (bytes->size() > kMostPhotoBytes)
    return fail("photo: has {} bytes, expected at most {}", bytes->size(), kMostPhotoBytes);
  if (const auto kind = picture_kind(*bytes); !kind) return fail("photo: {}", kind.error().message);
  return std::move(*bytes);
}

/// Why nothing can be written down about this; empty where it can.
std::string fault_in_subject(const std::string& about, const std::string& name) {
  if (about == "specimen") return "";
  if (about == "design") {
    const auto design = pattern::design_from_name(name);
    return design ? "" : "name: " + design.error().message;
  }
  if (about != "round") return fmt::format("about: '{}', expected specimen, design or round", about);
  const auto round = integer_from_text(name);
  return round && *round >= 0 && *round <= kLastRound ? "" : fmt::format("name: '{}', expected a round", name);
}

Result<bool> flag_of(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) return fail("{}: is missing, expected true or false", name);
  if (!found->is_boolean()) return fail("{}: {}, expected true or false", name, typed(*found));
  return found->get<bool>();
}

Result<int> round_of(const Json& object, int absent) {
  const auto found = object.find("round");
  if (found == object.end() || found->is_null()) return absent;
  if (!found->is_number_integer()) return fail("round: {}, expected a whole number", typed(*found));
  // A number beyond int64 is unsigned, and would wrap.
  if (found->is_number_unsigned() && found->get<std::uint64_t>() > static_cast<std::uint64_t>(kLastRound))
    return fail("round: {}, expected at most {}", found->get<std::uint64_t>(), kLastRound);
  const auto round = found->get<std::int64_t>();
  if (round < -1 || round > kLastRound) return fail("round: {}, expected -1 to {}", round, kLastRound);
  return static_cast<int>(round);
}

/// The number of a round, as a number or as text, or the name of a family.
Result<std::string> model_of(const Json& object) {
  const auto found = object.find("model");
  if (found != object.end() && found->is_number_integer()) return found->dump();
  return text_of(object, "model", true);
}

Result<pattern::Design> design_of(const Json& object, const char* name) {
  const Result<std::string> text = text_of(object, name, true);
  if (!text) return tl::unexpected(text.error());
  const auto design = pattern::design_from_word(*text);
  if (!design) return fail("{}: {}", name, design.error().message);
  return *design;
}

/// A cell of a table: text as it is, numbers to the last bit.
Result<std::string> cell_of(const std::string& name, const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return std::string(value.get<bool>() ? "1" : "0");
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  if (value.is_null()) return std::string();
  return fail("{}: {}, expected a text or a number", name, typed(value));
}

}  // namespace

Result<measurement::SpecimenRecord> specimen_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  std::map<std::string, std::string> fields;
  std::string curve;
  for (const auto& [name, value] : object->items()) {
    Result<std::string> cell = cell_of(name, value);
    if (!cell) return tl::unexpected(cell.error());
    (name == "curve_csv" ? curve : fields[name]) = std::move(*cell);
  }
  auto specimen = measurement::specimen_from_fields(fields, curve);
  if (!specimen) {
    const measurement::RejectedRow& row = specimen.error();
    return fail("{}{}{}", row.column, row.column.empty() ? "" : ": ", row.reason);
  }
  return std::move(*specimen);
}

Result<SpecimenReview> specimen_review_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto specimen = text_of(*object, "specimen", true), by = text_of(*object, "by", true),
             why = text_of(*object, "why", true);
  const auto valid = flag_of(*object, "valid");
  for (const auto* each : {&specimen, &by, &why})
    if (!*each) return tl::unexpected(each->error());
  if (!valid) return tl::unexpected(valid.error());
  return SpecimenReview{*specimen, *valid, *by, *why};
}

Result<Approval> approval_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto design = design_of(*object, "design");
  const auto round = round_of(*object, -1);
  const auto approved = flag_of(*object, "approved");
  const auto by = text_of(*object, "by", true), why = text_of(*object, "why");
  if (!design) return tl::unexpected(design.error());
  if (!round) return tl::unexpected(round.error());
  if (!approved) return tl::unexpected(approved.error());
  if (!by) return tl::unexpected(by.error());
  if (!why) return tl::unexpected(why.error());
  if (*round < 0 && !*approved)
    return fail("approved: false, expected true: a design of your own is added, never rejected");
  return Approval{design->name(), *round, *approved, *by, *why};
}

Result<Amendment> amendment_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto specimen = text_of(*object, "specimen", true), by = text_of(*object, "by", true),
             why = text_of(*object, "why", true);
  for (const auto* each : {&specimen, &by, &why})
    if (!*each) return tl::unexpected(each->error());
  Amendment amendment{.specimen = *specimen, .changes = {}, .by = *by, .why = *why};
  for (const auto& [name, value] : object->items()) {
    if (name == "specimen" || name == "by" || name == "why") continue;
    Result<std::string> cell = cell_of(name, value);
    if (!cell) return tl::unexpected(cell.error());
    amendment.changes[name] = std::move(*cell);
  }
  if (amendment.changes.empty()) return fail("nothing is amended: expected columns with other values");
  return amendment;
}

Result<Withdrawal> withdrawal_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto withdrawn = flag_of(*object, "withdrawn");
  if (!withdrawn) return tl::unexpected(withdrawn.error());
  const auto order = text_of(*object, "order"), by = text_of(*object, "by", true),
             why = text_of(*object, "why", *withdrawn);
  for (const auto* each : {&order, &by, &why})
    if (!*each) return tl::unexpected(each->error());
  if (object->contains("design") != order->empty()) return fail("expected either order or design");
  if (!order->empty()) return Withdrawal{*order, "", *withdrawn, *by, *why};
  const auto design = design_of(*object, "design");
  if (!design) return tl::unexpected(design.error());
  return Withdrawal{"", design->name(), *withdrawn, *by, *why};
}

Result<std::vector<families::SeedFamily>> grouping_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto listed = object->find("families");
  if (listed == object->end()) return fail("families: is missing, expected a list");
  if (!listed->is_array() || listed->empty())
    return fail("families: {}, expected a list of one family at least", typed(*listed));
  std::vector<families::SeedFamily> families;
  for (const Json& each : *listed) {
    if (!each.is_object()) return fail("families: {}, expected objects with name and seeds", typed(each));
    const auto name = text_of(each, "name", true);
    if (!name) return tl::unexpected(name.error());
    if (!families::is_family_name(*name))
      return fail("name: '{}', expected at most {} letters, digits, - and _, not digits alone", *name,
                  families::kLongestFamilyName);
    families::SeedFamily& family = families.emplace_back(families::SeedFamily{.name = *name, .seeds = {}});
    const auto seeds = each.find("seeds");
    if (seeds == each.end() || !seeds->is_array())
      return fail("family {}: seeds: expected a list of pattern keys", *name);
    for (const Json& seed : *seeds) {
      const auto pattern = seed.is_string() ? pattern::pattern_from_key(seed.get<std::string>()) : fail("not a text");
      if (!pattern) return fail("family {}: seeds: {}, expected a key of 14 hex digits", *name, typed(seed));
      family.seeds.push_back(*pattern);
    }
  }
  try {
    return families::parse_families(families::to_toml(families), "families");  // the same rules as for the file
  } catch (const InputError& error) {
    return fail("{}", error.what());
  }
}

Result<Note> note_from_json(std::string_view text) {
  constexpr std::size_t kMostNoteBytes = 4000;
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto about = text_of(*object, "about", true), name = text_of(*object, "name", true),
             by = text_of(*object, "by", true), words = lines_of(*object, "text", kMostNoteBytes);
  auto photo = photo_of(*object);
  for (const auto* each : {&about, &name, &by, &words})
    if (!*each) return tl::unexpected(each->error());
  if (!photo) return tl::unexpected(photo.error());
  if (const std::string fault = fault_in_subject(*about, *name); !fault.empty()) return fail("{}", fault);
  if (words->find_first_not_of(" \n") == std::string::npos && photo->empty())
    return fail("text: is empty, expected a text or a photo");
  return Note{*about, *name, *by, *words, std::move(*photo)};
}

Result<std::string> note_id_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  return text_of(*object, "id", true);
}

Result<PrintJobWish> print_job_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto name = text_of(*object, "name"), printer = text_of(*object, "printer");
  for (const auto* each : {&name, &printer})
    if (!*each) return tl::unexpected(each->error());
  PrintJobWish wish{.name = *name, .printer = *printer};
  if (object->contains("tray_stacks")) {
    const auto stacks = flag_of(*object, "tray_stacks");
    if (!stacks) return tl::unexpected(stacks.error());
    wish.tray_stacks = *stacks;
  }
  const auto tray = object->find("tray_mm");
  if (tray == object->end() || tray->is_null()) return wish;
  const bool are_two = tray->is_array() && tray->size() == 2 && tray->at(0).is_number() && tray->at(1).is_number();
  if (!are_two) return fail("tray_mm: {}, expected two numbers", typed(*tray));
  wish.tray_mm = {tray->at(0).get<double>(), tray->at(1).get<double>()};
  return wish;
}

Result<PrintedTray> printed_tray_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto job = text_of(*object, "job", true), by = text_of(*object, "by", true);
  const auto printed = flag_of(*object, "printed");
  for (const auto* each : {&job, &by})
    if (!*each) return tl::unexpected(each->error());
  if (!printed) return tl::unexpected(printed.error());
  const auto tray = object->find("tray");
  constexpr std::int64_t kMostTrays = 10'000;
  if (tray == object->end() || !tray->is_number_integer() || tray->get<std::int64_t>() < 1 ||
      tray->get<std::int64_t>() > kMostTrays)
    return fail("tray: {}, expected 1 to {}", tray == object->end() ? "is missing" : typed(*tray), kMostTrays);
  return PrintedTray{*job, tray->get<int>(), *printed, *by};
}

Result<std::string> job_name_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  return text_of(*object, "job", true);
}

bool is_model_name(std::string_view name) { return is_plain_name(name, families::kLongestFamilyName); }

Result<SimulationRequest> simulation_request_from_json(std::string_view text) {
  const Result<Json> object = object_in(text);
  if (!object) return tl::unexpected(object.error());
  const auto design = design_of(*object, "design");
  const auto model = model_of(*object);
  if (!design) return tl::unexpected(design.error());
  if (!model) return tl::unexpected(model.error());
  if (!is_model_name(*model))
    return fail("model: `{}`, expected the number of a round or the name of a family", *model);
  return SimulationRequest{*design, *model};
}

}  // namespace nacre::dashboard
