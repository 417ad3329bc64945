#include "dashboard/notes.hpp"

#include <algorithm>

#include <fmt/chrono.h>

#include "base/files.hpp"
#include "base/names.hpp"
#include "dashboard/guard.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::string_view kNoteEnding = ".json";
constexpr std::size_t kMostNoteFileBytes = 16u << 10;
constexpr std::size_t kMostNotes = 2000;
constexpr std::uintmax_t kMostFolderBytes = 512u << 20;
constexpr std::size_t kLongestStem = 100;

constexpr PictureKind kKinds[] = {{".jpg", "image/jpeg"}, {".png", "image/png"}, {".webp", "image/webp"}};

/// A link could lead anywhere.
bool is_regular(const std::filesystem::path& file) {
  std::error_code unreadable;
  return std::filesystem::symlink_status(file, unreadable).type() == std::filesystem::file_type::regular;
}

/// `STEM.ending` with a plain stem, as keep() names its files.
bool is_file_name(std::string_view name, std::string_view ending) {
  return name.ends_with(ending) && is_plain_name(name.substr(0, name.size() - ending.size()), kLongestStem);
}

/// The letters of a name that every file's name may have, for people who look into the folder.
std::string plain_part(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  std::string part;
  for (const char letter : name.substr(0, kLongest)) part += is_plain_name({&letter, 1}, 1) ? letter : '_';
  return part;
}

std::string text_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The note in a file; nothing where it is none.
std::optional<NoteRow> read_note(const std::filesystem::path& file) {
  try {
    const Json object = Json::parse(read_file_up_to(file, kMostNoteFileBytes), nullptr, false);
    if (!object.is_object()) return std::nullopt;
    const auto text = [&](const char* name) { return text_in(object, name); };
    return NoteRow{file.stem().string(), text("about"), text("name"), text("by"),
                   text("when"),         text("text"),  text("photo")};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The files of the folder, by name; none where it is not there.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable))
    if (is_regular(entry.path())) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

Result<PictureKind> picture_kind(std::string_view bytes) {
  if (bytes.starts_with("\xff\xd8\xff")) return kKinds[0];
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return kKinds[1];
  if (bytes.size() > 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP") return kKinds[2];
  return fail("is no picture that a browser shows safely, expected JPEG, PNG or WebP");
}

NotesRow NoteFolder::all() const {
  NotesRow row;
  for (const std::filesystem::path& file : files_in(folder_)) {
    if (!is_file_name(file.filename().string(), kNoteEnding)) continue;
    if (auto note = read_note(file)) row.notes.push_back(std::move(*note));
  }
  return row;
}

Result<std::string> NoteFolder::photo(const std::string& file) const {
  const bool is_named =
      std::ranges::any_of(kKinds, [&](const PictureKind& kind) { return is_file_name(file, kind.ending); });
  if (!is_named || !is_regular(folder_ / file)) return fail("there is no photo `{}`", file.substr(0, kLongestStem));
  try {
    return read_file_up_to(folder_ / file, kMostPhotoBytes);
  } catch (const InputError& error) {
    return fail("{}", error.what());
  }
}

Result<void> NoteFolder::remove(const std::string& id) const {
  const std::filesystem::path file = folder_ / (id + std::string(kNoteEnding));
  if (!is_file_name(file.filename().string(), kNoteEnding) || id.find('/') != std::string::npos || !is_regular(file))
    return fail("there is no note `{}`", id.substr(0, kLongestStem));
  std::error_code failure;
  for (const PictureKind& kind : kKinds) {
    const std::filesystem::path photo = folder_ / (id + std::string(kind.ending));
    if (is_regular(photo)) std::filesystem::remove(photo, failure);
  }
  if (!failure) std::filesystem::remove(file, failure);
  if (failure) return fail("{}: cannot be removed: {}", file.string(), failure.message());
  return {};
}

Result<void> NoteFolder::keep(const Note& note, std::int64_t utime) const {
  std::size_t notes = 0;
  std::uintmax_t bytes = note.photo.size();
  for (const std::filesystem::path& file : files_in(folder_)) {
    std::error_code gone;
    if (const auto size = std::filesystem::file_size(file, gone); !gone) bytes += size;
    notes += file.extension() == kNoteEnding;
  }
  if (notes >= kMostNotes) return fail("the run has {} notes, and takes no more", notes);
  if (bytes > kMostFolderBytes) return fail("the run's notes and photos take {} MiB already", kMostFolderBytes >> 20);
  const std::tm utc = fmt::gmtime(static_cast<std::time_t>(utime / 1'000'000));
  // By date; notes of one second are told apart by chance.
  const std::string stem =
      fmt::format("{:%Y%m%dT%H%M%SZ}-{}-{}-{}", utc, note.about, plain_part(note.name), random_token().substr(0, 8));
  make_folder(folder_);
  std::string photo;
  if (!note.photo.empty()) {
    const auto kind = picture_kind(note.photo);
    if (!kind) return tl::unexpected(kind.error());
    photo = stem + std::string(kind->ending);
    write_file_atomically(folder_ / photo, note.photo);
  }
  const Json object = {{"about", note.about}, {"name", note.name},
                       {"by", note.by},       {"when", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc)},
                       {"text", note.text},   {"photo", photo}};
  write_file_atomically(folder_ / (stem + std::string(kNoteEnding)),
                        object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return {};
}

}  // namespace nacre::dashboard
