#pragma once
// A root of log f(x) - log target by bracketing on logarithms.

#include <optional>
#include <vector>

namespace nacre::sysid {

/// Finds x in [lower, upper] where a positive function f meets a target, by ask and tell: the search is told the ratio
/// f(x) / target, and seeks the x at which it is one. It works on logarithms, expects f to grow about in proportion
/// to x at first, and then trusts the bracket; f may jump.
class RatioSearch {
 public:
  struct Settings {
    double lower = 0.0, upper = 0.0;
    double first = 0.0;       ///< first guess, clamped to the bounds
    double tolerance = 0.0;   ///< of |ratio - 1|
    double narrowest = 1e-6;  ///< relative width of a bracket across which the function is taken to jump
  };
  explicit RatioSearch(const Settings& settings);
  /// At most `count` points never asked before; empty when the target is met or nothing more can be gained: the target
  /// lies beyond a bound, or f jumps across it.
  std::vector<double> ask(int count) const;
  /// The ratio at x; nothing when f failed there.
  void tell(double x, std::optional<double> ratio);
  bool met() const;
  /// The x whose ratio is nearest to 1; nothing before the first success.
  std::optional<double> best() const;

 private:
  struct Sample {
    double log_x = 0.0, log_ratio = 0.0;
  };
  std::optional<Sample> best_sample() const;
  std::vector<double> proposals() const;
  bool is_new(double log_x, const std::vector<double>& chosen) const;

  Settings settings_;
  std::vector<Sample> samples_;  ///< by increasing x
  std::vector<double> failed_;   ///< log x
};

}  // namespace nacre::sysid
