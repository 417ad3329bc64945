#pragma once
// One specimen that breaks, as a page for somebody who sees nacre for the first time (`nacre show`).

#include <string>

#include "crack/crack_record.hpp"
#include "pattern/design.hpp"
#include "tester/fidelity.hpp"
#include "tester/toughness.hpp"

namespace nacre::report {

/// E and the fracture test of one design.
struct TestedDesign {
  pattern::Design design;
  double modulus_pa = 0.0;
  tester::ToughnessResult fracture;
};

/// What the page shows. `reference`: a homogeneous material tested in the same way, for comparison.
struct BrokenSpecimen {
  TestedDesign tested, reference;
  crack::CrackRecord crack;
  tester::Fidelity fidelity = tester::Fidelity::full;
};

/// One sentence, plain: what the crack does, and T and E as multiples of the reference's.
std::string fracture_in_words(const BrokenSpecimen& specimen);

/// A self-contained HTML page: the sentence, the film (`gif`: the bytes of the file), curves, E and T of both.
std::string render_fracture_page(const BrokenSpecimen& specimen, const std::string& gif);

}  // namespace nacre::report
