#include "dashboard/upload.hpp"

#include <algorithm>
#include <string_view>

#include "base/names.hpp"
#include "measurement/limits.hpp"

namespace nacre::dashboard {
namespace {

using Json = nlohmann::json;

/// What is wrong with a file's name: on this machine it must lead nowhere.
Result<void> check_name(const std::string& name) {
  constexpr std::size_t kLongestFileName = 200;
  const bool is_plain = !name.empty() && name.size() <= kLongestFileName && name.front() != '.' &&
                        name.find_first_of("/\\") == std::string::npos && !std::ranges::any_of(name, is_control);
  if (is_plain) return {};
  return fail("file `{}`: expected a name of at most {} bytes, without a path and without a dot at its beginning",
              name.substr(0, kLongestFileName), kLongestFileName);
}

Result<UploadedFile> file_of(Part part) {
  if (const auto named = check_name(part.file_name); !named) return tl::unexpected(named.error());
  if (part.content.size() > kMostExportBytes)
    return fail("file {}: has {} bytes, expected at most {} MB", part.file_name, part.content.size(),
                kMostExportBytes >> 20);
  return UploadedFile{std::move(part.file_name), std::move(part.content)};
}

Result<std::set<std::string>> names_of(const Json& object, const char* member) {
  std::set<std::string> names;
  const auto list = object.find(member);
  if (list == object.end()) return names;
  if (!list->is_array()) return fail("choice: {}: expected a list of specimens' names", member);
  for (const Json& name : *list) {
    if (!name.is_string() || name.get_ref<const std::string&>().size() > measurement::kLongestName)
      return fail("choice: {}: expected names of at most {} bytes", member, measurement::kLongestName);
    names.insert(name.get<std::string>());
  }
  return names;
}

Result<void> take_choice(std::string_view text, Upload& upload) {
  constexpr int kDeepest = 2;
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= kDeepest; };
  const Json object = Json::parse(text, shallow, false);
  if (!object.is_object()) return fail("choice: expected a JSON object with enter, confirmed, toe");
  auto enter = names_of(object, "enter"), confirmed = names_of(object, "confirmed");
  for (const auto* each : {&enter, &confirmed})
    if (!*each) return tl::unexpected(each->error());
  upload.enter = std::move(*enter);
  upload.confirmed = std::move(*confirmed);
  const Json toe = object.value("toe", Json("compensate"));
  if (toe != "keep" && toe != "compensate") return fail("choice: toe: expected keep or compensate");
  upload.keeps_toe = toe == "keep";
  return {};
}

}  // namespace

Result<Upload> upload_from_parts(std::vector<Part> parts) {
  if (parts.size() > kMostParts) return fail("expected at most {} files", kMostExports);
  Upload upload;
  std::set<std::string> names;
  for (Part& part : parts) {
    if (part.name == "choice") {
      if (const auto taken = take_choice(part.content, upload); !taken) return tl::unexpected(taken.error());
      continue;
    }
    const bool is_sheet = part.name == "sheet";
    if (!is_sheet && part.name != "export")
      return fail("a part is called `{}`, expected sheet, export or choice", part.name.substr(0, 40));
    if (is_sheet && !upload.sheet.name.empty()) return fail("there are two sheets, expected one");
    auto file = file_of(std::move(part));
    if (!file) return tl::unexpected(file.error());
    if (!names.insert(file->name).second) return fail("file {}: is given twice, expected each name once", file->name);
    (is_sheet ? upload.sheet : upload.exports.emplace_back()) = std::move(*file);
  }
  if (upload.sheet.name.empty()) return fail("the specimens' sheet is missing: it says which file is which specimen");
  if (upload.exports.empty()) return fail("no export of a testing machine is given, expected one at least");
  return upload;
}

}  // namespace nacre::dashboard
