#include "simulator_farm/spool.hpp"

#include <algorithm>
#include <set>

#include <fmt/ranges.h>

#include "base/files.hpp"
#include "base/lines.hpp"

namespace nacre::simulator_farm {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> lines_of(std::string_view text) {
  const std::vector<std::string_view> lines = lines_in(text);
  return {lines.begin(), lines.end()};
}

/// A file that may be gone by now.
std::optional<std::string> read_if_there(const fs::path& path) {
  try {
    return read_file(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

Spool::Spool(fs::path folder) : folder_(std::move(folder)) { make_folder(folder_); }

void Spool::put(const std::string& batch, const std::string& bytes) const {
  if (!fs::exists(batch_file(batch))) write_file_atomically(batch_file(batch), bytes);
}

void Spool::put_wave(const std::string& name, const std::vector<std::string>& batches) const {
  write_file_atomically(wave(name), fmt::format("{}\n", fmt::join(batches, "\n")));
}

Result<std::string> Spool::batch_of(const std::string& wave_name, int task) const {
  const auto text = read_if_there(wave(wave_name));
  if (!text) return fail("{}: there is no such wave", wave(wave_name).string());
  const std::vector<std::string> batches = lines_of(*text);
  if (task < 0 || task >= static_cast<int>(batches.size())) {
    return fail("{}: there is no task {}, expected 0 to {}", wave(wave_name).string(), task,
                static_cast<int>(batches.size()) - 1);
  }
  return batches[task];
}

/// Read anew each time: on network file systems a listing is fresh where a single look may be answered from memory.
std::vector<std::string> Spool::names_with(const std::string& ending) const {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder_, unreadable)) {
    if (entry.path().extension() == ending) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> Spool::batches() const { return names_with(".in"); }
std::vector<std::string> Spool::results() const { return names_with(".out"); }

std::map<std::string, std::vector<Task>> Spool::tasks() const {
  std::map<std::string, std::vector<Task>> tasks;
  for (const std::string& name : names_with(".wave")) {
    const std::vector<std::string> batches = lines_of(read_if_there(wave(name)).value_or(""));
    for (std::size_t i = 0; i < batches.size(); ++i) tasks[batches[i]].emplace_back(name, static_cast<int>(i));
  }
  return tasks;
}

std::string Spool::read_sign(const std::string& batch) const { return read_if_there(sign(batch)).value_or(""); }

std::string Spool::last_words(const std::vector<Task>& tasks) const {
  for (auto task = tasks.rbegin(); task != tasks.rend(); ++task) {
    const auto text = read_if_there(folder_ / fmt::format("{}-{}.log", task->first, task->second));
    if (!text || text->empty()) continue;
    return lines_of(*text).back();
  }
  return "nothing";
}

void Spool::remove(const std::string& batch) const {
  std::error_code ignored;  // what cannot be removed is removed by the next tidy()
  for (const fs::path& file : {batch_file(batch), result(batch), sign(batch)}) fs::remove(file, ignored);
}

void Spool::tidy() const {
  const std::vector<std::string> open = batches();
  const auto is_open = [&](const std::string& batch) { return std::binary_search(open.begin(), open.end(), batch); };
  std::error_code ignored;
  for (const std::string& batch : names_with(".sign")) {
    if (!is_open(batch)) fs::remove(sign(batch), ignored);
  }
  for (const std::string& name : names_with(".wave")) {
    const std::vector<std::string> batches = lines_of(read_if_there(wave(name)).value_or(""));
    if (std::any_of(batches.begin(), batches.end(), is_open)) continue;
    for (std::size_t task = 0; task < batches.size(); ++task) {
      fs::remove(folder_ / fmt::format("{}-{}.log", name, task), ignored);
    }
    fs::remove(wave(name), ignored);
  }
}

}  // namespace nacre::simulator_farm
