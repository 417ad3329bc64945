#include "made_up.hpp"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "pattern/random_pattern.hpp"

namespace nacre::load {

tester::Curve made_up_curve(int points, RandomStream& random) {
  tester::Curve curve;
  const double strain = 0.05 + 0.1 * random.uniform(), peak_pa = 1e7 * (1.0 + random.uniform());
  for (int i = 0; i < points; ++i) {
    const double along = static_cast<double>(i) / (points - 1);
    curve.strain.push_back(along * strain);
    curve.stress_pa.push_back(peak_pa * std::sin(3.1415 * along));
  }
  return curve;
}

std::vector<explore::Evaluated> made_up_gamut(int count, RandomStream& random) {
  std::set<std::uint64_t> known;
  std::vector<explore::Evaluated> gamut;
  while (static_cast<int>(gamut.size()) < count) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    if (!known.insert(pattern.bits()).second) continue;
    gamut.push_back({pattern, {1e9 * random.uniform(), 1e6 * random.uniform()}});
  }
  return gamut;
}

std::vector<measurement::SpecimenRecord> made_up_specimens(int count, int designs, RandomStream& random) {
  std::vector<pattern::Design> known;
  for (int i = 0; i < designs; ++i) known.emplace_back(pattern::random_pattern(random));
  std::vector<measurement::SpecimenRecord> specimens;
  for (int i = 0; i < count; ++i) {
    measurement::SpecimenRecord record;
    record.specimen = fmt::format("s{}", i);
    record.design = known[static_cast<std::size_t>(i / 2) % known.size()];
    record.batch = "load";
    if (i % 2 == 0) {
      record.test = tester::TestKind::modulus;
      record.modulus_pa = 5e8 * (1.0 + random.uniform());
    } else {
      constexpr int kCurvePoints = 200;
      record.test = tester::TestKind::toughness;
      record.curve = made_up_curve(kCurvePoints, random);
    }
    specimens.push_back(std::move(record));
  }
  return specimens;
}

}  // namespace nacre::load
