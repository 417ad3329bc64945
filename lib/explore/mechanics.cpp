#include "explore/mechanics.hpp"

#include <cmath>
#include <mutex>
#include <unordered_map>

#include "base/parallel.hpp"
#include "tester/modulus.hpp"
#include "tester/unit_cell.hpp"

namespace nacre::explore {
namespace {

/// `compute` of each pattern, in their order.
template <typename Compute>
auto of_each(std::span<const pattern::Pattern> patterns, int threads, const Compute& compute) {
  std::vector<decltype(compute(patterns[0]))> results(patterns.size());
  parallel_for(
      static_cast<int>(patterns.size()),
      [&](int i) {
        const auto index = static_cast<std::size_t>(i);
        results[index] = compute(patterns[index]);
      },
      threads);
  return results;
}

/// Natural logarithms of the moduli and loads of a pattern's unit cell in both testers.
struct CellLogs {
  double modulus = 0.0;
  /// In the toughness tester: the modulus, then the loads of the blocks.
  std::array<double, 1 + tester::kCellBlocks * tester::kCellBlocks> fracture{};
};

CellLogs cell_logs(const pattern::Pattern& pattern, const material::ParameterSet& parameters) {
  CellLogs logs;
  if (const auto cell = tester::pull_unit_cell(pattern, parameters, tester::AssemblyTarget::modulus))
    logs.modulus = std::log(cell->modulus_pa);
  const auto cell = tester::pull_unit_cell(pattern, parameters, tester::AssemblyTarget::toughness);
  if (!cell) return logs;
  logs.fracture[0] = std::log(cell->modulus_pa);
  for (std::size_t block = 0; block < cell->load.size(); ++block)
    logs.fracture[1 + block] = std::log(cell->load[block]);
  return logs;
}

/// Cells of one model. Thread-safe; results do not depend on what is remembered.
class CellMemory {
 public:
  explicit CellMemory(const material::ParameterSet& parameters) : parameters_(parameters) {}
  const material::ParameterSet& parameters() const { return parameters_; }

  std::vector<CellLogs> cells_of(std::span<const pattern::Pattern> patterns, int threads) {
    return of_each(patterns, threads, [this](const pattern::Pattern& pattern) { return cell_of(pattern); });
  }

 private:
  CellLogs cell_of(const pattern::Pattern& pattern) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = known_.find(pattern.bits()); found != known_.end()) return found->second;
    }
    const CellLogs logs = cell_logs(pattern, parameters_);
    const std::lock_guard lock(mutex_);
    constexpr std::size_t kMost = 300'000;  // 50 MB
    if (known_.size() >= kMost) known_.clear();
    return known_[pattern.bits()] = logs;
  }

  material::ParameterSet parameters_;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, CellLogs> known_;
};

/// An agent needs batch after batch for one model, each by itself.
std::shared_ptr<CellMemory> memory_of(const material::ParameterSet& parameters) {
  static std::mutex mutex;
  static std::shared_ptr<CellMemory> last;
  const std::lock_guard lock(mutex);
  if (!last || last->parameters() != parameters) last = std::make_shared<CellMemory>(parameters);
  return last;
}

ModulusOf modulus_by_tester(const material::ParameterSet& parameters, tester::Fidelity fidelity, int threads) {
  return [=](std::span<const pattern::Pattern> patterns) {
    return of_each(patterns, threads, [&](const pattern::Pattern& pattern) -> std::optional<double> {
      const auto result = tester::test_modulus({pattern, parameters, {}, fidelity});
      if (!result) return std::nullopt;
      return result->modulus_pa;
    });
  };
}

}  // namespace

Mechanics mechanics_by_tester(const material::ParameterSet& parameters, tester::Fidelity fidelity, int threads) {
  Mechanics mechanics{.modulus_of = modulus_by_tester(parameters, fidelity, threads)};
  const std::shared_ptr<CellMemory> memory = memory_of(parameters);
  mechanics.cell_modulus = [=](std::span<const pattern::Pattern> patterns) {
    Eigen::MatrixXd column(static_cast<Eigen::Index>(patterns.size()), 1);
    Eigen::Index row = 0;
    for (const CellLogs& logs : memory->cells_of(patterns, threads)) column(row++, 0) = logs.modulus;
    return column;
  };
  mechanics.cell_loads = [=](std::span<const pattern::Pattern> patterns) {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(patterns.size()), std::tuple_size_v<decltype(CellLogs::fracture)>);
    Eigen::Index row = 0;
    for (const CellLogs& logs : memory->cells_of(patterns, threads))
      rows.row(row++) = Eigen::Map<const Eigen::RowVectorXd>(logs.fracture.data(), rows.cols());
    return rows;
  };
  return mechanics;
}

}  // namespace nacre::explore
