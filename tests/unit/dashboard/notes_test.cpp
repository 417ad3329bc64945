#include "dashboard/notes.hpp"

#include <unistd.h>

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/base64.hpp"
#include "dashboard/dashboard.hpp"
#include "dashboard/entries.hpp"
#include "fake_desk.hpp"

namespace nacre::dashboard {
namespace {

using testing::HasSubstr;

const std::string kJpeg = "\xff\xd8\xff\xe0 a photo";

std::string note_json(const std::string& more) { return R"({"about":"specimen","name":"a-1","by":"Ada")" + more + "}"; }

std::string fault_of_note(const std::string& json) {
  const auto note = note_from_json(json);
  return note ? "none" : note.error().message;
}

/// A folder of notes, and the page of a run that has it.
class NotesOfARun : public testing::Test {
 protected:
  NotesOfARun() { std::filesystem::create_directories(run_); }
  ~NotesOfARun() override { std::filesystem::remove_all(run_); }

  Response get(const std::string& path, std::map<std::string, std::string> query = {}) {
    return dashboard_.handle({.method = "GET", .path = path, .query = std::move(query), .headers = {}, .body = ""});
  }
  DashboardSettings settings() const {
    DashboardSettings settings;
    settings.run_folder = run_;
    settings.family_folder = run_ / "families";
    settings.scenario.fidelity = tester::Fidelity::tiny;
    return settings;
  }

  std::filesystem::path run_ = std::filesystem::temp_directory_path() / fmt::format("nacre-notes-{}", ::getpid());
  NoteFolder folder_{run_ / "notes"};
  FakeDesk desk_;
  Dashboard dashboard_{settings(), desk_};
};

TEST(Base64, GivesBackWhatWentIn) {
  std::string bytes;
  for (int i = 0; i < 260; ++i) {
    EXPECT_EQ(bytes_of_base64(base64(bytes)), bytes) << i;
    bytes += static_cast<char>(i * 7);
  }
  EXPECT_EQ(base64("Man"), "TWFu");
  for (const char* text : {"TWF", "TWFu ", "TW=u", "====", "TWE*", "TWF="}) EXPECT_FALSE(bytes_of_base64(text)) << text;
}

TEST(Notes, APhotoIsKnownByItsContent) {
  const auto note = note_from_json(note_json(R"(,"photo":")" + base64(kJpeg) + "\""));
  ASSERT_TRUE(note) << note.error().message;
  EXPECT_EQ(note->photo, kJpeg);
  EXPECT_EQ(picture_kind("\x89PNG\r\n\x1a\n...")->media_type, "image/png");
  for (const char* harmful : {"<svg xmlns='http://www.w3.org/2000/svg'/>", "<html>", "GIF89a", "%PDF-1.4"})
    EXPECT_THAT(fault_of_note(note_json(R"(,"photo":")" + base64(harmful) + "\"")), HasSubstr("expected JPEG"))
        << harmful;
}

TEST(Notes, WhatIsWrongIsNamed) {
  EXPECT_EQ(fault_of_note(note_json(R"(,"text":"two\nlines")")), "none");
  EXPECT_THAT(fault_of_note(note_json("")), HasSubstr("expected a text or a photo"));
  EXPECT_THAT(fault_of_note(note_json(R"(,"text":"a\u0007")")), HasSubstr("control character"));
  EXPECT_THAT(fault_of_note(note_json(R"(,"text":")" + std::string(4001, 'x') + "\"")), HasSubstr("at most 4000"));
  EXPECT_THAT(fault_of_note(note_json(R"(,"photo":"?")")), HasSubstr("no base64"));
  EXPECT_THAT(fault_of_note(note_json(R"(,"photo":")" + base64(kJpeg + std::string(kMostPhotoBytes, ' ')) + "\"")),
              HasSubstr("at most 2900000"));
  EXPECT_THAT(fault_of_note(R"({"about":"round","name":"-1","by":"Ada","text":"x"})"), HasSubstr("expected a round"));
  EXPECT_THAT(fault_of_note(R"({"about":"design","name":"../x","by":"Ada","text":"x"})"), HasSubstr("name: "));
  EXPECT_THAT(fault_of_note(R"({"about":"run","name":"a","by":"Ada","text":"x"})"), HasSubstr("about: 'run'"));
}

TEST_F(NotesOfARun, StayInPlainFilesAndAreServedAsWhatTheyAre) {
  const std::int64_t utime = 1'700'000'000'000'000;
  ASSERT_TRUE(folder_.keep({"specimen", "../a 1", "Ada", "broke\nat the grip", kJpeg}, utime));
  ASSERT_TRUE(folder_.keep({"round", "2", "Eve", "hot day", ""}, utime + 1'000'000));
  const NotesRow row = folder_.all();
  ASSERT_EQ(row.notes.size(), 2u);
  EXPECT_EQ(row.notes[0].name, "../a 1");
  EXPECT_EQ(row.notes[0].text, "broke\nat the grip");
  EXPECT_EQ(row.notes[0].when, "2023-11-14T22:13:20Z");
  EXPECT_EQ(row.notes[1].photo, "");
  EXPECT_TRUE(std::filesystem::exists(run_ / "notes" / row.notes[0].photo));
  EXPECT_EQ(Json::parse(get("/api/notes").body)["notes"][1]["text"], "hot day");

  const Response photo = get("/api/photo", {{"file", row.notes[0].photo}});
  EXPECT_EQ(photo.status, 200);
  EXPECT_EQ(photo.type, "image/jpeg");
  EXPECT_EQ(photo.body, kJpeg);
  EXPECT_THAT(photo.headers, testing::Contains(testing::Pair("Content-Security-Policy", HasSubstr("sandbox"))));
}

TEST_F(NotesOfARun, ANoteIsRemovedWithItsPhotoAndNothingElse) {
  ASSERT_TRUE(folder_.keep({"specimen", "a", "Ada", "first", kJpeg}, 1'000'000));
  ASSERT_TRUE(folder_.keep({"specimen", "a", "Ada", "second", kJpeg}, 2'000'000));
  std::ofstream(run_ / "secret.json") << "{}";
  const auto remove = [&](const std::string& id) {
    const std::string body = Json{{"id", id}}.dump();
    return dashboard_.handle({.method = "POST", .path = "/api/note_removal", .query = {}, .headers = {}, .body = body});
  };
  for (const char* id : {"../secret", "absent", "..", "a/b"}) EXPECT_EQ(remove(id).status, 404) << id;
  EXPECT_TRUE(std::filesystem::exists(run_ / "secret.json"));
  const NotesRow before = folder_.all();
  EXPECT_EQ(remove(before.notes[0].id).status, 200);
  const NotesRow after = folder_.all();
  ASSERT_EQ(after.notes.size(), 1u);
  EXPECT_EQ(after.notes[0].text, "second");
  EXPECT_FALSE(std::filesystem::exists(run_ / "notes" / before.notes[0].photo));
  EXPECT_TRUE(std::filesystem::exists(run_ / "notes" / after.notes[0].photo));
}

TEST_F(NotesOfARun, NoOtherFileIsServedAsAPhoto) {
  std::filesystem::create_directories(run_ / "notes");
  std::ofstream(run_ / "secret.jpg") << kJpeg;
  std::ofstream(run_ / "notes" / "page.jpg") << "<script>alert(1)</script>";
  std::filesystem::create_symlink(run_ / "secret.jpg", run_ / "notes" / "link.jpg");
  for (const char* file : {"../secret.jpg", "link.jpg", "page.jpg", "", ".jpg", "absent.png", "page.json"})
    EXPECT_EQ(get("/api/photo", {{"file", file}}).status, 404) << file;
}

TEST_F(NotesOfARun, AFullFolderTakesNoMore) {
  std::filesystem::create_directories(run_ / "notes");
  std::ofstream(run_ / "notes" / "large.jpg") << "";
  std::filesystem::resize_file(run_ / "notes" / "large.jpg", 512u << 20);  // sparse
  const auto kept = folder_.keep({"round", "1", "Ada", "x", kJpeg}, 0);
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, HasSubstr("512 MiB"));
}

TEST_F(NotesOfARun, ANoteReachesTheDesk) {
  const Response response = dashboard_.handle(
      {.method = "POST", .path = "/api/note", .query = {}, .headers = {}, .body = note_json(R"(,"text":"crooked")")});
  EXPECT_EQ(response.status, 200) << response.body;
  ASSERT_EQ(desk_.notes.size(), 1u);
  EXPECT_EQ(desk_.notes[0].text, "crooked");
  EXPECT_EQ(get("/api/note").status, 405);
}

TEST_F(NotesOfARun, BeforeTheFirstMessageASpecimenHasNoStory) {
  const Response story = get("/api/specimen", {{"specimen", "a-1"}});
  EXPECT_EQ(story.status, 200) << story.body;
  EXPECT_EQ(Json::parse(story.body)["reviews"], Json::array());
}

}  // namespace
}  // namespace nacre::dashboard
