#pragma once
// The JSON document of `nacre diagnose --json` (docs/FORMATS.md).

#include <string>

#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {

std::string to_json(const Diagnosis& diagnosis);

}  // namespace nacre::diagnosis
