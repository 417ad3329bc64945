#pragma once
// Numbers and names of the report as text. All but shortened() return what is safe to put into the page.

#include <optional>
#include <string>
#include <string_view>

namespace nacre::report {

inline constexpr std::string_view kDash = "–";  ///< for what is not known

/// `value` with about three significant digits and no exponent; a dash when it is not finite.
std::string figure(double value);
/// A share as a percentage: `0.0653` becomes "6.5 %"; above 100 % without decimals.
std::string percent(double share);
std::string percent_or_dash(const std::optional<double>& share);
std::string gpa(double pa);  ///< "1.81", in GPa, no unit
std::string mpa(double pa);  ///< "0.473", in MPa, no unit
/// "a ± b" with as many decimals as b needs for two digits; without b when it is 0.
std::string with_error(double value, double error);
/// A chance: "< 0.001" below that.
std::string chance(double p);
/// A number of any size in a parameter's own unit: plain between 0.001 and 10,000, else "1.2 × 10⁻⁹".
std::string quantity(double value);
/// An effect's name in words.
std::string effect_name(const std::string& name);
/// A name of more than 20 characters by its first nine and an ellipsis; not escaped.
std::string shortened(std::string_view name);
/// A design's name, long keys of free layouts shortened with the whole in the hint.
std::string design_name(std::string_view name);

}  // namespace nacre::report
