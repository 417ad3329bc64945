#include "gpu/emulated_device.hpp"

#include <algorithm>

#include "gpu/step.hpp"

namespace nacre::gpu {
namespace {

struct EmulatedPlace {
  Specimen specimen;
  std::vector<float> memory;
  std::vector<std::int32_t> failed_at;
  PlaceReport report;
};

void step_nodes(Specimen& specimen, std::int64_t step, int in_chunk, Reactions& reactions) {
  for (int index = 0; index < tiles_of(specimen); ++index) {
    Tile tile;
    for (int thread = 0; thread < kTileThreads; ++thread) gather_velocities(specimen, step, index, thread, tile);
    for (int thread = 0; index == 0 && thread < kShares; ++thread) share_reactions(specimen, thread, tile);
    for (int thread = 0; thread < kTileThreads; ++thread) damp_and_move(specimen, step, index, thread, tile);
    if (index > 0) continue;
    reactions.bottom[in_chunk] = reaction(tile, 0);
    reactions.top[in_chunk] = reaction(tile, 1);
  }
}

class EmulatedDevice : public Device {
 public:
  explicit EmulatedDevice(int places) : places_(places) {}
  std::string name() const override { return "this processor in a device's place"; }
  std::size_t free_bytes() const override { return std::size_t{1} << 30; }

  void load(int place, const SpecimenImage& image) override {
    EmulatedPlace& p = places_[place];
    p.memory.assign(image.device_numbers(), 0.0f);
    std::copy(image.block.begin(), image.block.end(), p.memory.begin());
    p.failed_at.assign(image.elements, -1);
    p.specimen = image.bind(p.memory.data());
    p.specimen.failed_at = p.failed_at.data();
    p.specimen.begun_at = steps_;
    p.specimen.occupied = true;
    p.report = {};
  }
  void unload(int place) override { places_[place] = {}; }

  void advance() override {
    for (int k = 0; k < kChunkSteps; ++k, ++steps_) {
      for (EmulatedPlace& p : places_) {
        if (!p.specimen.occupied) continue;
        const std::int64_t step = steps_ - p.specimen.begun_at;
        p.specimen.state.strain = strain_at(p.specimen, step);
        for (int row = 0; row < p.specimen.state.rows; ++row)
          for (int column = 0; column < p.specimen.state.columns; ++column)
            step_element(p.specimen, step, row, column, p.report.inverted);
        step_nodes(p.specimen, step, k, p.report.reactions);
      }
    }
  }
  std::vector<PlaceReport> reports() override {
    std::vector<PlaceReport> reports;
    for (const EmulatedPlace& p : places_) reports.push_back(p.report);
    return reports;
  }
  std::vector<std::int32_t> failed_at(int place) override {
    const EmulatedPlace& p = places_[place];
    return by_element(p.specimen.state, p.failed_at);
  }

 private:
  std::vector<EmulatedPlace> places_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Device> emulated_device(int places) { return std::make_unique<EmulatedDevice>(places); }

}  // namespace nacre::gpu
