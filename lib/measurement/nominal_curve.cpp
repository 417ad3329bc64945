#include "measurement/nominal_curve.hpp"

namespace nacre::measurement {

tester::Curve nominal_curve(const TesterRecord& record, const SheetRow& row, const AssumedUnits& units) {
  // N / mm2 = MPa.
  const double pa_per_newton = 1e6 * units.force_factor / (row.width_mm * row.record.conditions.thickness_mm);
  tester::Curve curve;
  curve.strain.reserve(record.line.size());
  curve.stress_pa.reserve(record.line.size());
  for (std::size_t i = 0; i < record.line.size(); ++i) {
    curve.strain.push_back(record.strain.empty()
                               ? units.extension_factor * (record.extension_mm[i] - record.extension_mm.front()) /
                                     row.gauge_mm
                               : record.strain[i] - record.strain.front());
    curve.stress_pa.push_back(record.stress_pa.empty() ? record.force_n[i] * pa_per_newton : record.stress_pa[i]);
  }
  return curve;
}

}  // namespace nacre::measurement
