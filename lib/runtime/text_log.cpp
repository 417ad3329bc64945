#include "runtime/text_log.hpp"

#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <vector>

#include "base/result.hpp"

namespace nacre::runtime {
namespace {

constexpr std::size_t kLargestFile = 5 << 20;
constexpr std::size_t kOldFiles = 3;

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

}  // namespace

TextLog::TextLog(const std::string& node, const std::filesystem::path& folder) {
  auto console = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  console->set_level(spdlog::level::info);
  console->set_pattern("%H:%M:%S.%e %l: %v");
  std::vector<spdlog::sink_ptr> sinks{console};
  try {
    auto file =
        std::make_shared<spdlog::sinks::rotating_file_sink_mt>((folder / "node.log").string(), kLargestFile, kOldFiles);
    file->set_pattern("%Y-%m-%d %H:%M:%S.%f %l: %v");
    sinks.push_back(file);
  } catch (const spdlog::spdlog_ex& problem) {
    std::fprintf(stderr, "no text log: %s\n", problem.what());
  }
  logger_ = std::make_shared<spdlog::logger>(node, sinks.begin(), sinks.end());
  logger_->set_level(spdlog::level::debug);
  logger_->flush_on(spdlog::level::info);
  // A full disk must not keep the sentence about it from standard error, nor repeat itself for every line.
  logger_->set_error_handler([](const std::string&) {});
}

TextLog::~TextLog() { flush(); }
void TextLog::write(LogLevel level, const std::string& text) { logger_->log(level_of(level), "{}", text); }
void TextLog::flush() { logger_->flush(); }

}  // namespace nacre::runtime
