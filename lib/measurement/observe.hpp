#pragma once
// Measurement-side extensions: the response of a specimen as the testing machine records it. Symbols: E modulus, sigma
// nominal stress, c compliance of the machine (1/Pa), s slack (strain), g error of the load cell's gain, d drift per
// batch.
//
//   drift       E (1 + d)^batch_step, stresses alike
//   compliance  1/E_recorded = 1/E + c: a spring in series
//   load cell   recorded force = (1 + g) force
//   of several machines each but the first has a further g and c; where some c are below 0 all machines have as much
//   more as the least needs to be 0
//   curve       strain_recorded = s + strain + c sigma

#include <functional>
#include <vector>

#include "material/parameters.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// The position of a specimen among the others of its set, for the effects that depend on it.
struct PrintContext {
  double batch_step = 0.0;  ///< batches after the first one, in the order of printing
  int machine = 0;          ///< number of the machine among those of the set
};

/// The contexts of a set's specimens, in their order. Batches follow each other by name, numbers in their natural order
/// (batch-2 before batch-10); a specimen without batch counts to the first.
std::vector<PrintContext> print_contexts(const std::vector<SpecimenRecord>& specimens);

/// The modulus as recorded of a specimen with true modulus `modulus_pa`, printed in that context. Exactly the identity
/// without extensions.
double observe_modulus(double modulus_pa, const material::Extensions& extensions, const PrintContext& context = {});
/// The toughness as recorded of a specimen that is pulled to separation: the machine's compliance gives back the energy
/// that it stored.
double observe_toughness(double toughness_pa, const material::Extensions& extensions, const PrintContext& context = {});
/// The modulus that is recorded as `recorded_pa`, for prints that have not drifted; infinite where the machine's
/// compliance alone exceeds it.
double modulus_behind(double recorded_pa, const material::Extensions& extensions);
/// A curve as recorded, with a first point (0, 0) before the slack is taken up. Strain may decrease where stress falls
/// steeply.
tester::Curve observe_curve(const tester::Curve& curve, const material::Extensions& extensions,
                            const PrintContext& context = {});

/// Stresses of a specimen along a history of its own strains.
using SpecimenResponse = std::function<tester::Curve(const std::vector<double>& strain)>;

/// The inverse problem: the curve as recorded at given recorded strains, unloading included. The specimen itself is
/// stretched by less, strain = recorded - s - c sigma, and by nothing while slack is taken up.
tester::Curve observe_along(const std::vector<double>& recorded_strain, const SpecimenResponse& pull,
                            const material::Extensions& extensions, const PrintContext& context = {});

}  // namespace nacre::measurement
