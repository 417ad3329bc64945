#include "dashboard/imports.hpp"

#include <algorithm>

#include "base/hash.hpp"

namespace nacre::dashboard {
namespace {

using Json = nlohmann::ordered_json;
using measurement::SpecimenRecord;

/// Adds what the run's model, orders and replicates say about the specimens.
void add_doubts_of_run(const std::vector<SpecimenDoubt>& doubts, Json& specimens) {
  for (const SpecimenDoubt& doubt : doubts)
    for (Json& specimen : specimens)
      if (specimen.at("specimen") == doubt.specimen)
        specimen.at("doubts").push_back({{"of_scale", doubt.is_of_scale}, {"text", doubt.text}});
}

/// Names of specimens with a doubt of scale that nobody has confirmed.
std::set<std::string> open_doubts(const Json& specimens, const std::set<std::string>& confirmed) {
  std::set<std::string> open;
  for (const Json& specimen : specimens) {
    const auto name = specimen.at("specimen").get<std::string>();
    const auto is_of_scale = [](const Json& doubt) { return doubt.at("of_scale").get<bool>(); };
    if (!confirmed.contains(name) && std::ranges::any_of(specimen.at("doubts"), is_of_scale)) open.insert(name);
  }
  return open;
}

Json answer_json(const std::string& specimen, std::string_view answer, const std::string& error) {
  Json json = {{"specimen", specimen}, {"answer", answer}};
  if (!error.empty()) json["error"] = error;
  return json;
}

std::string content_of(const Upload& upload) {
  std::string content = upload.sheet.name + '\n' + content_hash(upload.sheet.bytes) + (upload.keeps_toe ? "\ntoe" : "");
  for (const UploadedFile& file : upload.exports) content += '\n' + file.name + '\n' + content_hash(file.bytes);
  return content_hash(content);
}

/// Enters what is wanted and settled; returns what became of each specimen that is wanted.
Json enter(const Upload& upload, const std::vector<SpecimenRecord>& specimens, const Json& listed, Desk& desk) {
  const std::set<std::string> open = open_doubts(listed, upload.confirmed);
  Json answers = Json::array();
  std::vector<SpecimenRecord> wanted;
  std::set<std::string> missing = upload.enter;
  for (const SpecimenRecord& specimen : specimens) {
    if (missing.erase(specimen.specimen) == 0) continue;
    if (!open.contains(specimen.specimen)) {
      wanted.push_back(specimen);
      continue;
    }
    answers.push_back(answer_json(specimen.specimen, "doubted", "a doubt about its unit or size is not settled"));
  }
  for (const std::string& name : missing)
    answers.push_back(answer_json(name, "absent", "the files hold no usable specimen of this name"));
  const std::vector<Answer> given = desk.enter_all(wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    answers.push_back(answer_json(wanted[i].specimen, to_string(given[i].delivery), given[i].refusal));
  return answers;
}

/// Keeps the files of specimens that the run has; what is in the way is said, the specimens are in the run all the
/// same.
void keep(const Upload& upload, const ReadUpload& read, Desk& desk, Json& response) {
  const auto is_in_run = [](const Json& each) {
    return each.at("answer") == to_string(Delivery::accepted) || each.at("answer") == to_string(Delivery::repeated);
  };
  if (std::ranges::none_of(response.at("answers"), is_in_run)) return;
  try {
    desk.keep_import(read.folder(), content_of(upload));
  } catch (const InputError& error) {
    response.at("warnings").push_back(error.what());
  }
}

}  // namespace

Response import_response(const Upload& upload, const ReadUpload& read, Desk& desk) {
  Result<Json> document = read.document();
  if (!document) return error_response(400, document.error().message);
  try {
    const std::vector<SpecimenRecord> specimens = read.specimens();
    Json response = {{"specimens", document->at("specimens")},
                     {"rejected", document->at("rejected")},
                     {"warnings", document->at("warnings")}};
    add_doubts_of_run(desk.doubts_of(specimens), response["specimens"]);
    if (!upload.enter.empty()) {
      response["answers"] = enter(upload, specimens, response["specimens"], desk);
      keep(upload, read, desk, response);
    }
    return json_response(response);
  } catch (const Json::exception&) {
    return error_response(500, "the reader's document is not that of `nacre import --json`");
  }
}

}  // namespace nacre::dashboard
