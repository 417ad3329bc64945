#include "runtime/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/names.hpp"

namespace nacre::runtime {

int terminal_columns(int file_descriptor) {
  if (::isatty(file_descriptor) == 0) return 0;
  winsize size{};
  if (::ioctl(file_descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

std::string bar(double progress, int cells) {
  const double share = std::isfinite(progress) ? std::clamp(progress, 0.0, 1.0) : 0.0;
  const int filled = static_cast<int>(share * cells);
  return fmt::format("[{}{}]", std::string(filled, '#'), std::string(cells - filled, '.'));
}

void print_line(std::FILE* out, std::string_view line) {
  std::fwrite(line.data(), 1, line.size(), out);
  std::fputc('\n', out);
}

std::string in_words(double seconds) {
  if (!(seconds >= 0.0) || seconds > 1e9) return "";
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string about_in_words(double seconds) {
  if (!(seconds >= 0.0) || seconds > 1e9) return "";
  const auto minutes = static_cast<long>(std::ceil(seconds / 60.0));
  if (minutes <= 1) return "less than a minute";
  if (minutes < 90) return fmt::format("about {} min", minutes);
  return fmt::format("about {} h", (minutes + 30) / 60);
}

std::string time_left_in_words(double seconds) {
  const std::string about = about_in_words(seconds);
  return about.empty() ? "" : about + " left";
}

std::string fitted(std::string_view text, int columns) {
  std::string line;
  int width = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues_character = (byte & 0xC0) == 0x80;
    if (!continues_character && ++width > columns) break;
    line += is_control(c) ? ' ' : c;
  }
  return line;
}

}  // namespace nacre::runtime
