#pragma once
// How a material forgets: the relaxation function of its rate laws (rate_laws.hpp) as a sum of exponentials, each of
// which is followed exactly from step to step.

#include <vector>

#include "material/extensions.hpp"
#include "material/mixture.hpp"

namespace nacre::material {

/// The shortest step and the whole time of a test, s.
struct TimeSpan {
  double shortest_s = 0.0, longest_s = 0.0;
};

/// G(t) over the modulus without rate laws: rest + sum of shares e^(-rate t). Branches that relax within every step are
/// one dashpot.
struct RelaxationFunction {
  double rest = 1.0;
  std::vector<double> shares = {}, rates_per_s = {};
  double dashpot_s = 0.0;  ///< stress of it: this, times the rate of the elastic stress
  bool is_elastic() const { return shares.empty(); }
  bool operator==(const RelaxationFunction&) const = default;
  /// At a time above 0.
  double at(double time_s) const;
};

/// Of a blend, by rate_power_law with an exponent of at most 0.95, rate_by_phase and rate_prony. The power is the
/// trapezoidal sum, in steps h = 0.75, of t^-n = 1/Gamma(n) times the integral of e^(n x - t e^x) over x (Beylkin and
/// Monzon, Appl. Comput. Harmon. Anal. 28, 2010, section 2): from the shortest time to the longest within 2 |Gamma(n +
/// 2 pi i/h)| / Gamma(n), 1e-5 at n = 0.6. Its slow and fast ends are summed in closed form.
RelaxationFunction relaxation_function(const Phases& phases, const Extensions& extensions, double rigid_fraction,
                                       TimeSpan span);

/// What is left of the stresses that a material had, step by step: exact where stress grows evenly over each.
class FadingMemory {
 public:
  explicit FadingMemory(RelaxationFunction function = {})
      : function_(std::move(function)), branches_(function_.shares.size(), 0.0) {}
  /// The stress `dt_s` after the last one, where that without relaxation is `elastic_pa`.
  double advance(double elastic_pa, double dt_s);

 private:
  void prepare(double dt_s);

  RelaxationFunction function_;
  std::vector<double> branches_;
  double step_s_ = -1.0;               ///< that these are of: most steps are alike
  std::vector<double> kept_, passed_;  ///< of a branch, and of what is added to it, after a step
  double last_pa_ = 0.0;
};

}  // namespace nacre::material
