#pragma once
// `POST /api/import`: what is understood of uploaded files, and its entry into the run once a person has settled the
// doubts about units and sizes.

#include "dashboard/desk.hpp"
#include "dashboard/http.hpp"
#include "dashboard/import_reader.hpp"

namespace nacre::dashboard {

/// The document of `nacre import --json` with the doubts that the run raises. The specimens that `upload` wants entered
/// are handed to the desk, those with an open doubt of scale left out; `answers` tells what became of each. The files
/// are kept with the run once one specimen is in it. May throw InputError; the caller lets one at a time to the desk.
Response import_response(const Upload& upload, const ReadUpload& read, Desk& desk);

}  // namespace nacre::dashboard
