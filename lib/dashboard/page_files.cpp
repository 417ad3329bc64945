#include "dashboard/page_files.hpp"

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre::dashboard {
namespace {

constexpr std::size_t kMostBytes = 16u << 20;

const std::map<std::string, std::string>& types() {
  static const std::map<std::string, std::string> types = {{".html", "text/html; charset=utf-8"},
                                                           {".js", "text/javascript; charset=utf-8"},
                                                           {".css", "text/css; charset=utf-8"},
                                                           {".svg", "image/svg+xml"},
                                                           {".png", "image/png"},
                                                           {".woff2", "font/woff2"}};
  return types;
}

constexpr const char* kNotBuilt =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>nacre dashboard</title><h1>The page is not built "
    "yet</h1><p>In nacre's "
    "folder: <code>npm --prefix web ci &amp;&amp; npm --prefix web run build</code>, then start <code>nacre "
    "dashboard</code> again. (<code>launch/game</code> "
    "and <code>tests/run</code> do it by themselves.)</p></html>\n";

}  // namespace

PageFiles::PageFiles(const std::filesystem::path& folder) {
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    const auto type = types().find(entry.path().extension().string());
    if (type == types().end() || !entry.is_regular_file(unreadable)) continue;
    files_["/" + entry.path().filename().string()] = {
        .type = type->second, .body = read_file_up_to(entry.path(), kMostBytes), .headers = {}};
  }
  const auto index = files_.find("/index.html");
  files_["/"] = index != files_.end()
                    ? index->second
                    : Response{.status = 503, .type = "text/html; charset=utf-8", .body = kNotBuilt, .headers = {}};
}

std::optional<Response> PageFiles::find(const std::string& path) const {
  const auto found = files_.find(path);
  return found == files_.end() ? std::nullopt : std::optional<Response>(found->second);
}

}  // namespace nacre::dashboard
