#pragma once
// All sentences of a diagnosis for a person, made from its values.

#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/test_words.hpp"

namespace nacre::diagnosis {

/// Extensions: "droplet mixing with rigid yield"; "the base model" for none.
std::string in_words(const std::vector<std::string>& effects);
/// "e_vw_pa = 1.39e+09 Pa, e_tb_pa = 3e+05 Pa of coupons"
std::string in_words(const std::vector<ModulusAtBound>& moduli);
/// "half the element size"
std::string_view in_words(DiscretisationChange change);
/// "effect interface_anisotropy", "family geometry", "measurement side"; empty: nothing.
std::string in_words(const CommonGround& ground);
/// "soft coupons"; empty: no rows.
std::string in_words(const RowsOf& rows);

/// "modulus of mix:0.75 grows as the strain rate to the power 0.12 (90 % interval 0.10 to 0.14)"
std::string in_words(const ConditionTrend& trend);
/// What the data show by themselves, a sentence with a space in front; empty: no condition varies.
std::string trends_in_words(const DataSummary& data);

/// Verdict with its reason, gain, and everything that limits what the verdict is worth.
std::string summary_of(const Diagnosis& diagnosis);

/// Where nothing can be computed.
std::string insufficient_in_words(const std::string& why);

}  // namespace nacre::diagnosis
