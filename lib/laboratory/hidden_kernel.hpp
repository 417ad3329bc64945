#pragma once
// The inner loop of the fracture bench for specimens whose material has hidden effects. The laboratory's own
// formulation, in Green's strain: plastic strain and the viscous strain of the Maxwell branch are subtracted from it.

#include "laboratory/fracture_kernel.hpp"

namespace nacre::laboratory {

/// What a row of elements has beyond ElementRow: constants, and the history of its four quadrature points.
struct HiddenRow {
  const float* flow_limit;     ///< Y / (2 mu), infinity where nothing flows
  const float* inverse_limit;  ///< 1 / J_m
  const float* eigenstrain;
  const float* overstress;
  const float* onset;    ///< energy density at which an element starts to break, J/m^3
  float* plastic[4][2];  ///< (h11 - h22) / 2 and h12 of the logarithmic plastic strain
  float* work[4];        ///< of flow, J/m^3
  float* viscous[4][3];  ///< viscous Green strain, components 11, 22, 12
  float* integrity;
};

struct HiddenStep {
  float relaxed = 0.0f;  ///< 1 - exp(-dt / tau)
  float eigen_scale = 1.0f;
  SofteningLaw softening = {};
  float tension_only = 0.0f;
};

/// The parts of the hidden law that act, beside softening.
struct HiddenParts {
  bool flows = false;         ///< flow_limit
  bool fills = false;         ///< inverse_limit
  bool shrinks = false;       ///< eigenstrain
  bool relaxes = false;       ///< overstress
  bool spares_crush = false;  ///< tension_only
  bool operator==(const HiddenParts&) const = default;
};

/// As advance_elements(), with the hidden law; advances the history. One part alone is up to six times as fast as all.
int advance_hidden_elements(const ElementRow& row, const ElementStep& step, const HiddenRow& hidden,
                            const HiddenStep& hidden_step, const HiddenParts& parts);

}  // namespace nacre::laboratory
