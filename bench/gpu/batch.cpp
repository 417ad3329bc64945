#include "batch.hpp"

#include <chrono>
#include <optional>

#include "base/parallel.hpp"
#include "gpu/cuda.hpp"
#include "gpu/emulated_device.hpp"

namespace nacre::gpu_study {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::unique_ptr<gpu::Device> device_with(int places, bool emulated) {
  if (emulated) return gpu::emulated_device(places);
  auto device = gpu::cuda_device(places);
  if (!device) throw InputError(device.error().message);
  return *std::move(device);
}

int places_on_device(const tester::FractureTest& typical, int most, bool emulated) {
  const auto prepared = gpu::PreparedTest::of(typical);
  if (!prepared) throw InputError(prepared.error().message);
  return gpu::places_for(*device_with(1, emulated), prepared->image(), most);
}

std::vector<Result<tester::ToughnessResult>> pull_all(std::unique_ptr<gpu::Device> device, int places,
                                                      const std::vector<tester::FractureTest>& tests,
                                                      BatchTimes& times) {
  std::vector<std::optional<Result<gpu::PreparedTest>>> prepared(tests.size());
  const auto began = std::chrono::steady_clock::now();
  parallel_for(static_cast<int>(tests.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    prepared[at] = gpu::PreparedTest::of(tests[at]);
  });
  times.preparing_s = seconds_since(began);
  gpu::BatchTester batch(std::move(device), places);
  std::vector<std::optional<Result<tester::ToughnessResult>>> results(tests.size());
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (*prepared[i])
      batch.add({static_cast<int>(i), **std::move(prepared[i])});
    else
      results[i] = tl::unexpected(prepared[i]->error());
    prepared[i].reset();
  }
  const auto pulling = std::chrono::steady_clock::now();
  while (batch.pending() > 0) {
    for (gpu::NumberedResult& over : batch.turn()) results[over.number] = std::move(over.result);
  }
  times.pulling_s = seconds_since(pulling);
  std::vector<Result<tester::ToughnessResult>> in_order;
  for (auto& result : results) in_order.push_back(*std::move(result));
  return in_order;
}

}  // namespace nacre::gpu_study
