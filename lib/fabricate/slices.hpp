#pragma once
// Slices as files: one indexed PNG per layer, point = droplet, palette index 0 none, 1 soft, 2 rigid.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fabricate/droplet_plan.hpp"

namespace nacre::fabricate {

/// `0000.png`, `0001.png`, ... from the tray upwards.
std::string slice_name(int layer);

/// Droplets counted in the files.
struct StackCount {
  int layers = 0;
  int columns = 0;
  int rows = 0;
  DropletCount total{};
  std::vector<DropletCount> by_layer;
};

/// Writes all layers of a plan into `folder` (made when absent, slices of an earlier stack removed), on all allowed
/// cores, a layer in memory per core. `done` is called after each layer with the number written so far, from any
/// thread, one at a time. Throws InputError naming the file.
void write_slices(const DropletPlan& plan, const Printer& printer, const std::filesystem::path& folder,
                  const std::function<void(int)>& done = {});

/// Counts the droplets of all slices in `folder`, from the files. Throws InputError when one is missing, differs in
/// size or cannot be read.
StackCount count_slices(const std::filesystem::path& folder);

}  // namespace nacre::fabricate
