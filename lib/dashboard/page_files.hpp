#pragma once
// The page's own files.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "dashboard/http.hpp"

namespace nacre::dashboard {

/// The page as built from web/: read once, so that no request ever names a file.
class PageFiles {
 public:
  /// The files of `folder` itself that a page is made of (html, js, css, svg, png, woff2; at most 16 MiB each). A
  /// folder that is not there leaves a page that says how to build it.
  explicit PageFiles(const std::filesystem::path& folder);
  /// The file of that path (`/` is index.html); nothing when there is none.
  std::optional<Response> find(const std::string& path) const;

 private:
  std::map<std::string, Response> files_;
};

}  // namespace nacre::dashboard
