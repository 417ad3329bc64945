// Part of the dashboard of one run: the story of a specimen, notes and photos.

#include "dashboard/dashboard.hpp"
#include "dashboard/entries.hpp"
#include "dashboard/request_parts.hpp"
#include "dashboard/specimen_view.hpp"

namespace nacre::dashboard {

Response Dashboard::specimen(const Request& request) {
  return row_response(specimen_story(run_, parameter(request, "specimen")));
}

Response Dashboard::notes(const Request&) { return row_response(note_folder_.all()); }

Response Dashboard::photo(const Request& request) {
  auto bytes = note_folder_.photo(parameter(request, "file"));
  if (!bytes) return error_response(404, bytes.error().message);
  const auto kind = picture_kind(*bytes);  // somebody may have put another file there
  if (!kind) return error_response(404, kind.error().message);
  return {.type = std::string(kind->media_type),
          .body = std::move(*bytes),
          .headers = {{"Content-Security-Policy", "sandbox; default-src 'none'"}, {"Content-Disposition", "inline"}}};
}

Response Dashboard::note(const Request& request) {
  const Note note = or_refuse(note_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  return delivery_response(desk_.keep_note(note_folder_, note));
}

Response Dashboard::remove_note(const Request& request) {
  const std::string id = or_refuse(note_id_from_json(request.body));
  const std::lock_guard lock(desk_mutex_);
  if (const auto removed = note_folder_.remove(id); !removed) throw Refusal{404, removed.error().message};
  return delivery_response({});
}

}  // namespace nacre::dashboard
