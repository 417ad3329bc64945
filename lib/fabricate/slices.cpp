#include "fabricate/slices.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>

#include "base/files.hpp"
#include "base/hash.hpp"
#include "base/no_space.hpp"
#include "base/parallel.hpp"
#include "base/result.hpp"
#include "fabricate/slice_png.hpp"

namespace nacre::fabricate {
namespace {

constexpr std::string_view kPrefix = "slice_";  // Voxel Print wants one

bool is_slice_name(std::string name) {
  if (name.starts_with(kPrefix)) name.erase(0, kPrefix.size());
  const std::size_t dot = name.find('.');
  return dot >= 4 && dot != std::string::npos && name.substr(dot) == ".png" &&
         name.find_first_not_of("0123456789") == dot;
}

void empty_folder_of_slices(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) refuse_write(fmt::format("{}: cannot be made: {}", folder.string(), failure.message()), failure.value());
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (is_slice_name(entry.path().filename().string())) old.push_back(entry.path());
  }
  for (const auto& path : old) std::filesystem::remove(path, failure);
}

/// Without sync to disk: thousands of slices would be slow, and the build sheet that lists them is written last.
void write_plainly(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) refuse_write(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)), errno);
}

}  // namespace

std::string slice_name(int layer, SlicePixels pixels) {
  return fmt::format("{}{:04}.png", pixels == SlicePixels::rgba ? kPrefix : "", layer);
}

void write_slices(const SliceStack& stack, const Printer& printer, const std::filesystem::path& folder,
                  const std::function<void(int)>& done) {
  empty_folder_of_slices(folder);
  std::vector<int> first;  // of layers that are alike
  for (int layer = 0; layer < stack.layers(); ++layer)
    if (!stack.is_like_before(layer)) first.push_back(layer);
  first.push_back(stack.layers());
  std::mutex reporting;
  int written = 0;
  parallel_for(static_cast<int>(first.size()) - 1, [&](int run) {
    const std::string png = to_png(stack.slice(first[run]), printer, stack.is_noise(first[run]));
    for (int layer = first[run]; layer < first[run + 1]; ++layer)
      write_plainly(folder / slice_name(layer, printer.pixels), png);
    const std::lock_guard lock(reporting);
    written += first[run + 1] - first[run];
    if (done) done(written);
  });
}

StackCount count_slices(const std::filesystem::path& folder, SlicePixels pixels) {
  StackCount stack;
  std::string last_bytes_hash;
  const auto place_of = [&](int layer) { return folder / slice_name(layer, pixels); };
  while (std::filesystem::exists(place_of(stack.layers))) {
    const std::filesystem::path path = place_of(stack.layers);
    // The same file again holds the same droplets.
    std::string bytes_hash = content_hash(read_file(path));
    if (bytes_hash == last_bytes_hash) {
      stack.by_layer.push_back(stack.by_layer.back());
    } else {
      const Slice slice = read_slice(path);
      if (stack.layers > 0 && (slice.columns != stack.columns || slice.rows != stack.rows)) {
        throw InputError::format("{}: {} x {} droplets, expected {} x {} as in the slices below", path.string(),
                                 slice.columns, slice.rows, stack.columns, stack.rows);
      }
      stack.columns = slice.columns;
      stack.rows = slice.rows;
      stack.by_layer.push_back(count_droplets(slice));
    }
    last_bytes_hash = std::move(bytes_hash);
    for (std::size_t i = 0; i < stack.total.size(); ++i) stack.total[i] += stack.by_layer.back()[i];
    ++stack.layers;
  }
  if (stack.layers == 0)
    throw InputError::format("{}: holds no slices, expected {} and so on", folder.string(), slice_name(0, pixels));
  return stack;
}

}  // namespace nacre::fabricate
