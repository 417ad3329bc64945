#include "dashboard/imports.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_desk.hpp"

namespace nacre::dashboard {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

std::vector<Part> two_files() { return {{"sheet", "specimens.csv", "file,specimen\n"}, {"export", "a.csv", "1,2\n"}}; }

std::vector<Part> with(std::vector<Part> parts, Part further) {
  parts.push_back(std::move(further));
  return parts;
}

std::string fault(std::vector<Part> parts) {
  const auto upload = upload_from_parts(std::move(parts));
  return upload ? "none" : upload.error().message;
}

TEST(Upload, IsASheetAndExportsAndWhatIsChosen) {
  const auto upload = upload_from_parts(with(two_files(), {"choice", "", R"({"enter":["a","b"],"confirmed":["b"]})"}));
  ASSERT_TRUE(upload) << upload.error().message;
  EXPECT_EQ(upload->sheet.name, "specimens.csv");
  ASSERT_EQ(upload->exports.size(), 1u);
  EXPECT_EQ(upload->exports[0].bytes, "1,2\n");
  EXPECT_THAT(upload->enter, ElementsAre("a", "b"));
  EXPECT_THAT(upload->confirmed, ElementsAre("b"));
  EXPECT_FALSE(upload->keeps_toe);
  EXPECT_TRUE(upload_from_parts(with(two_files(), {"choice", "", R"({"toe":"keep"})"}))->keeps_toe);
}

TEST(Upload, NamesLeadNowhere) {
  for (const std::string name : {"../a.csv", "/etc/passwd", "a/b.csv", "..\\a.csv", ".hidden", "..", "", "a\nb"})
    EXPECT_THAT(fault(with(two_files(), {"export", name, ""})), HasSubstr("without a path")) << name;
  EXPECT_THAT(fault(with(two_files(), {"export", std::string(201, 'a'), ""})), HasSubstr("at most 200 bytes"));
  EXPECT_EQ(fault(with(two_files(), {"export", "-20 °C, Probe 1.csv", ""})), "none");
}

TEST(Upload, EachFileIsThereOnceAndNoneIsMissing) {
  EXPECT_THAT(fault(with(two_files(), {"export", "specimens.csv", ""})), HasSubstr("given twice"));
  EXPECT_THAT(fault(with(two_files(), {"sheet", "other.csv", ""})), HasSubstr("two sheets"));
  EXPECT_THAT(fault({two_files()[0]}), HasSubstr("no export"));
  EXPECT_THAT(fault({two_files()[1]}), HasSubstr("sheet is missing"));
  EXPECT_THAT(fault(with(two_files(), {"pattern", "a", ""})), HasSubstr("expected sheet, export or choice"));
}

TEST(Upload, IsLimited) {
  std::vector<Part> many = two_files();
  while (many.size() <= kMostParts) many.push_back({"export", std::to_string(many.size()), ""});
  EXPECT_THAT(fault(many), HasSubstr("at most 500 files"));
  EXPECT_THAT(fault(with(two_files(), {"export", "b.csv", std::string(kMostExportBytes + 1, '1')})),
              HasSubstr("at most 32 MB"));
}

TEST(Upload, AChoiceIsTwoListsOfNames) {
  for (const char* choice :
       {"", "[]", R"({"enter":"a"})", R"({"enter":[1]})", R"({"confirmed":[["a"]]})", R"({"toe":1})", "{\"enter\":["})
    EXPECT_THAT(fault(with(two_files(), {"choice", "", choice})), HasSubstr("choice: ")) << choice;
}

/// Stands for `nacre import`: a measurement set of a, doubted, and b, and the document that goes with it.
constexpr const char* kReader = R"(
for argument; do case $argument in --out=*) set=${argument#--out=};; esac; done
mkdir "$set"
printf 'specimen,pattern,test,modulus_pa\na,soft,modulus,1e6\nb,rigid,modulus,2e9\n' > "$set/measurements.csv"
printf '{"specimens":[{"specimen":"a","doubts":[{"of_scale":true,"text":"is it mm?"}]},
{"specimen":"b","doubts":[{"of_scale":false,"text":"noisy"}]}],"rejected":[],"warnings":[]}')";

ImportReader shell(const std::string& script) { return {.command = {"/bin/sh", "-c", script, "reader"}}; }

class ImportOfFiles : public testing::Test {
 protected:
  Response respond(const std::string& script, std::set<std::string> enter = {}, std::set<std::string> confirmed = {}) {
    reader_.command = shell(script).command;
    Upload upload = *upload_from_parts(two_files());
    upload.enter = std::move(enter);
    upload.confirmed = std::move(confirmed);
    const ReadUpload read(upload, reader_);
    folder_ = read.folder();
    return import_response(upload, read, desk_);
  }
  /// What became of the specimens that were to be entered, by name.
  std::map<std::string, std::string> answers(const Response& response) {
    const Json document = Json::parse(response.body);
    std::map<std::string, std::string> answers;
    for (const Json& each : document.at("answers")) answers[each.at("specimen")] = each.at("answer");
    return answers;
  }
  ImportReader reader_;
  FakeDesk desk_;
  std::filesystem::path folder_;
};

TEST_F(ImportOfFiles, TheReaderFindsThemInAFolderThatGoes) {
  const Response response = respond(
      R"(echo "{\"specimens\":[],\"rejected\":[],\"warnings\":[\"$(cat specimens.csv a.csv | tr '\n' ' ')$5 $6\"]}")");
  EXPECT_EQ(Json::parse(response.body).at("warnings").at(0), "file,specimen 1,2 -- a.csv");
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

TEST_F(ImportOfFiles, DoubtsOfTheRunStandBesideThoseOfTheFile) {
  desk_.run_doubts = {{"b", true, "ten times the model's"}};
  const Json specimens = Json::parse(respond(kReader).body).at("specimens");
  EXPECT_EQ(specimens.at(0).at("doubts").size(), 1u);
  EXPECT_EQ(specimens.at(1).at("doubts").at(1).at("text"), "ten times the model's");
  EXPECT_TRUE(desk_.specimens.empty()) << "nothing was to be entered";
  EXPECT_TRUE(desk_.kept.empty());
}

TEST_F(ImportOfFiles, ADoubtOfScaleIsSettledBeforeTheSpecimenCounts) {
  EXPECT_EQ(answers(respond(kReader, {"a", "b", "c"})),
            (std::map<std::string, std::string>{{"a", "doubted"}, {"b", "accepted"}, {"c", "absent"}}));
  ASSERT_EQ(desk_.specimens.size(), 1u);
  EXPECT_EQ(desk_.specimens[0].specimen, "b");
  EXPECT_DOUBLE_EQ(*desk_.specimens[0].modulus_pa, 2e9);
  EXPECT_EQ(answers(respond(kReader, {"a"}, {"a"})), (std::map<std::string, std::string>{{"a", "accepted"}}));
  ASSERT_EQ(desk_.kept.size(), 2u);
  EXPECT_EQ(desk_.kept[0], desk_.kept[1]) << "the same files have the same name";
}

TEST_F(ImportOfFiles, FilesOfSpecimensThatTheRunDoesNotTakeAreNotKept) {
  desk_.answer = {Delivery::conflicting, "another measurement of this name"};
  const Response response = respond(kReader, {"b"});
  EXPECT_EQ(Json::parse(response.body).at("answers").at(0).at("error"), "another measurement of this name");
  EXPECT_TRUE(desk_.kept.empty());
}

TEST_F(ImportOfFiles, WhyNothingCanBeReadIsTheReadersSentence) {
  const Response response =
      respond("echo 'warning: odd' >&2; echo 'nacre: specimens.csv:1: column `pattern` is missing' >&2; exit 2");
  EXPECT_EQ(response.status, 400);
  EXPECT_EQ(Json::parse(response.body).at("error"), "specimens.csv:1: column `pattern` is missing");
}

TEST_F(ImportOfFiles, AReaderThatCannotBeStartedLeavesNothingBehind) {
  const auto own = std::filesystem::temp_directory_path() / fmt::format("nacre-imports-test-{}", ::getpid());
  std::filesystem::create_directory(own);
  ::setenv("TMPDIR", own.c_str(), 1);
  EXPECT_THROW(ReadUpload(*upload_from_parts(two_files()), {.command = {"/nowhere/reader"}}), InputError);
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(own));
  std::filesystem::remove_all(own);
}

TEST_F(ImportOfFiles, WhatNeedsMoreMemoryThanItMaySaysSo) {
  const Response response = respond("echo 'nacre: unexpected: std::bad_alloc' >&2; exit 2");
  EXPECT_THAT(response.body, HasSubstr("more memory than they may"));
}

TEST_F(ImportOfFiles, AReaderThatDoesNotEndIsEnded) {
  reader_.patience_s = 0.3;
  EXPECT_THAT(respond("sleep 60 & wait").body, HasSubstr("takes more than 0.3 s"));
  reader_.patience_s = 60;
  reader_.processor_s = 1;
  EXPECT_THAT(respond("while :; do :; done").body, HasSubstr("takes more than it may"));
}

TEST_F(ImportOfFiles, AReaderThatFloodsTheDiskIsEnded) {
  reader_.file_bytes = 1u << 16;
  for (const char* script : {"exec yes", "exec yes >&2"})
    EXPECT_THAT(respond(script).body, HasSubstr("takes more than it may")) << script;
}

TEST_F(ImportOfFiles, ADocumentOfAnotherKindIsRefused) {
  for (const char* script : {"echo '[]'", "echo '{}'", "echo nonsense", "true"})
    EXPECT_GE(respond(script).status, 400) << script;
}

}  // namespace
}  // namespace nacre::dashboard
