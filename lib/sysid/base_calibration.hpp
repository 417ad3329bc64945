#pragma once
// Round 0 (thesis 3.2): base materials, one at a time.

#include <memory>
#include <vector>

#include "pattern/design.hpp"
#include "sysid/calibration.hpp"

namespace nacre::sysid {

/// Whether a design is soft, rigid or interface alone: what BaseCalibration fits.
bool is_base_material(const pattern::Design& design);

/// Each of soft, rigid and interface is fitted by itself, to the parameters that it depends on, at a damping that suits
/// all three; when there is none, the one at which the worst of them misses least. (The thesis keeps the median of
/// three separate estimates; thresholds fitted at another damping then miss.) toughness_budget is per material, over
/// all dampings.
class BaseCalibration final : public CalibrationProtocol {
 public:
  BaseCalibration(std::vector<measurement::Replicates> base_materials, const CalibrationSettings& settings);
  ~BaseCalibration() override;
  BaseCalibration(BaseCalibration&&) noexcept;
  BaseCalibration& operator=(BaseCalibration&&) noexcept;
  const std::vector<WantedEvaluation>& wanted() const override;
  void tell(std::size_t index, const std::vector<Prediction>& predictions) override;
  double progress() const override;
  const Calibrated& result() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::sysid
