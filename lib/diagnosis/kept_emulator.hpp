#pragma once
// An emulator of fracture tests that serves every set of the same layouts: its models lie about a calibration, and do
// not follow what was measured. Once simulated and kept (DiagnosisSettings::store), a diagnosis simulates nothing.

#include <optional>
#include <vector>

#include "diagnosis/settings.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

/// Simulates in this process, on settings.threads, what settings.store does not know: base models and effects about
/// settings.start, and layouts on half elements there. For settings.fractures. Nothing where the set has no fracture
/// tests.
std::optional<SimulatedFractures> kept_emulator(const std::vector<measurement::SpecimenRecord>& specimens,
                                                const DiagnosisSettings& settings);

/// Only the layouts on half elements, at the centre of settings.fractures: what no farm simulates.
std::vector<RefinedLayout> refined_layouts_of(const std::vector<measurement::SpecimenRecord>& specimens,
                                              const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
