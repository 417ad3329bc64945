#include "watched_process.hpp"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

namespace nacre::soak {
namespace {

namespace fs = std::filesystem;

/// The number that stands after `field:` in the process' status; 0 when there is none.
double status_number(const fs::path& process, const std::string& field) {
  std::ifstream status(process / "status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(field + ":")) return std::stod(line.substr(field.size() + 1));
  }
  return 0.0;
}

std::optional<pid_t> number_of(const std::string& text) {
  pid_t pid = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pid);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(pid) : std::nullopt;
}

}  // namespace

std::vector<WatchedProcess> children_of(pid_t parent) {
  std::vector<WatchedProcess> children;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const std::optional<pid_t> pid = number_of(entry.path().filename().string());
    if (!pid || static_cast<pid_t>(status_number(entry.path(), "PPid")) != parent) continue;
    std::error_code ended;
    const fs::path program = fs::read_symlink(entry.path() / "exe", ended);
    const fs::directory_iterator descriptors(entry.path() / "fd", ended);
    if (ended) continue;
    children.push_back({*pid, program.filename().string(), 1024.0 * status_number(entry.path(), "VmRSS"),
                        static_cast<double>(std::distance(begin(descriptors), end(descriptors))),
                        status_number(entry.path(), "Threads")});
  }
  return children;
}

}  // namespace nacre::soak
