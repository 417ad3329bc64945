#pragma once
// Slices as files: one PNG per layer (slice_png.hpp).

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fabricate/printer.hpp"
#include "fabricate/slice.hpp"

namespace nacre::fabricate {

/// `0000.png`, `0001.png`, ... from the tray upwards; in colours `slice_0000.png`, ...
std::string slice_name(int layer, SlicePixels pixels = SlicePixels::indexed);

/// Droplets counted in the files.
struct StackCount {
  int layers = 0;
  int columns = 0;
  int rows = 0;
  DropletCount total{};
  std::vector<DropletCount> by_layer;
};

/// Writes all layers of a stack into `folder` (made when absent, slices of an earlier stack removed), on all allowed
/// cores, a layer in memory per core. `done` is called with the number of layers written so far, from any thread, one
/// at a time. Throws InputError naming the file.
void write_slices(const SliceStack& stack, const Printer& printer, const std::filesystem::path& folder,
                  const std::function<void(int)>& done = {});

/// Counts the droplets of all slices in `folder`, from the files. Throws InputError when one is missing, differs in
/// size or cannot be read.
StackCount count_slices(const std::filesystem::path& folder, SlicePixels pixels = SlicePixels::indexed);

}  // namespace nacre::fabricate
