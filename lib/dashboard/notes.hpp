#pragma once
// What people write down about specimens, designs and rounds, with photos: plain files in RUN/notes, a JSON file per
// note and its photo under the same name. The dashboard alone writes them.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "dashboard/page_fields.hpp"

namespace nacre::dashboard {

struct Note {
  std::string about;  ///< `specimen`, `design` or `round`
  std::string name;   ///< of the specimen or the design, or the number of the round
  std::string by;
  std::string text;   ///< may be empty where there is a photo; lines end with LF
  std::string photo;  ///< bytes of a JPEG, PNG or WebP; empty: none
};

/// Most bytes of a photo: in base64 it fits a request.
inline constexpr std::size_t kMostPhotoBytes = 2'900'000;

/// A kind of picture, told by its first bytes.
struct PictureKind {
  std::string_view ending;      ///< of its file's name, with the dot
  std::string_view media_type;  ///< `image/png`, ...
};
/// The error names the kinds that are taken.
Result<PictureKind> picture_kind(std::string_view bytes);

struct NoteRow {
  static constexpr std::string_view kPageName = "Note";
  std::string id;  ///< by which it is removed
  std::string about, name, by, when, text;
  std::string photo;  ///< name of its file; empty: none

  static void fields(auto& field, auto& m) {
    field("id", m.id);
    field("about", m.about);
    field("name", m.name);
    field("by", m.by);
    field("when", m.when);
    field("text", m.text);
    field("photo", m.photo);
  }
};

struct NotesRow {
  static constexpr std::string_view kPageName = "Notes";
  std::vector<NoteRow> notes;  ///< the oldest first

  static void fields(auto& field, auto& m) { field("notes", m.notes); }
};

/// RUN/notes, which need not exist.
class NoteFolder {
 public:
  explicit NoteFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Files that are no notes are left out.
  NotesRow all() const;
  /// Bytes of a photo, by the name of its file. The error says that there is none.
  Result<std::string> photo(const std::string& file) const;
  /// Removes a note and its photo. The error says that there is none, or why it stays.
  Result<void> remove(const std::string& id) const;
  /// Writes the note, dated `utime`, in microseconds since 1970. The error says why the folder takes no more. Throws
  /// InputError where the disk does not.
  Result<void> keep(const Note& note, std::int64_t utime) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace nacre::dashboard
