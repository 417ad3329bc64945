#pragma once
// What a print job costs: trays, layers, hours at the printer and at the testing machine, resin.

#include <string>

#include "fabricate/job.hpp"

namespace nacre::fabricate {

struct Price {
  int specimens = 0;
  int trays = 0;
  int slices = 0;           ///< layers that are printed: of every tray those of its thickest specimen
  double printing_h = 0.0;  ///< without filling, cleaning and curing
  double testing_h = 0.0;
  double resin_ml = 0.0;  ///< of the specimens: without support and purging

  static void fields(auto& field, auto& m) {
    field("specimens", m.specimens);
    field("trays", m.trays);
    field("slices", m.slices);
    field("printing_h", m.printing_h);
    field("testing_h", m.testing_h);
    field("resin_ml", m.resin_ml);
  }
  bool operator==(const Price&) const = default;
};

/// Of a planned job, at the rates of its request. Resin is outline times height of the layers.
Price price_of(const Job& job);

/// "32 specimens on 4 trays, 404 slices, about 4.5 h of printing, 5.3 h of testing, 408 ml of resin".
std::string in_words(const Price& price);

}  // namespace nacre::fabricate
