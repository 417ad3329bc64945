#pragma once
// The JSON documents of `nacre diagnose --json`, with and without --plan (docs/FORMATS.md).

#include <string>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/plan.hpp"

namespace nacre::diagnosis {

std::string to_json(const Diagnosis& diagnosis);
std::string to_json(const Plan& plan);

}  // namespace nacre::diagnosis
