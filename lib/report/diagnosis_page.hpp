#pragma once
// A diagnosis as one page for the person who measured.

#include <string>

#include "diagnosis/diagnosis.hpp"

namespace nacre::report {

/// A self-contained HTML page: verdict, where the simulation is off, the cause with its size and meaning, what else
/// could explain it, the gain on designs held out of the fit, the next test. `set`: how the person calls the
/// measurements.
std::string render_diagnosis_page(const diagnosis::Diagnosis& diagnosis, const std::string& set,
                                  tester::Fidelity fidelity);

}  // namespace nacre::report
