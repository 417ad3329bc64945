#pragma once
// Moduli of homogeneous specimens that a laboratory could add: those under conditions that others were measured at.

#include <vector>

#include "diagnosis/possible_tests.hpp"

namespace nacre::diagnosis {

/// Of every homogeneous material whose modulus was measured, tests that differ from a measured one in one condition:
/// the strain rate, and temperature, humidity, age or machine where these vary. Values are the least and the largest
/// that any specimen was measured at, and the middle of their widest gap; of the rate also TestRules::second_rate times
/// the largest, and relaxation after a hold of TestRules::holds_s. Where there are several machines, pieces of every
/// base material on two of them. None where layouts are among the data.
std::vector<PossibleTest> moduli_of_specimens(const Observations& observations, const TestRules& rules);

}  // namespace nacre::diagnosis
