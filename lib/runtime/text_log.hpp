#pragma once
// A node's log for people: standard error, and RUN/nodes/NODE/node.log (rotating).

#include <filesystem>
#include <memory>
#include <string>

#include "runtime/node_core.hpp"

namespace spdlog {
class logger;
}

namespace nacre::runtime {

class TextLog {
 public:
  TextLog(const std::string& node, const std::filesystem::path& folder);
  ~TextLog();
  void write(LogLevel level, const std::string& text);
  void flush();

 private:
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace nacre::runtime
