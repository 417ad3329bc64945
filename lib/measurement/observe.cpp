#include "measurement/observe.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "material/extensions.hpp"

namespace nacre::measurement {
namespace {

/// Of a machine beyond the stiffest of all.
double further_compliance(const material::Extensions& extensions, int machine) {
  constexpr const char* kName = "compliance_of_one_machine";
  const auto found = extensions.find(kName);
  if (found == extensions.end()) return 0.0;
  const double least = std::min(0.0, *std::ranges::min_element(found->second));
  return (machine > 0 ? material::extension_value(extensions, kName, machine - 1) : 0.0) - least;
}

/// The machine as the extensions describe it, and how far the print has drifted in one context.
struct TestingMachine {
  double compliance_per_pa = 0.0, slack = 0.0, gain = 1.0, drift = 1.0;

  TestingMachine(const material::Extensions& extensions, const PrintContext& context)
      : compliance_per_pa(material::extension_value(extensions, "machine_compliance")),
        slack(material::extension_value(extensions, "toe_slack")),
        gain(1.0 + material::extension_value(extensions, "load_cell_gain")) {
    const double per_step = material::extension_value(extensions, "batch_drift");
    if (per_step != 0.0) drift = std::exp(context.batch_step * std::log1p(per_step));
    compliance_per_pa += further_compliance(extensions, context.machine);
    if (context.machine > 0)
      gain *= 1.0 + material::extension_value(extensions, "gain_of_one_machine", context.machine - 1);
  }
  bool is_ideal() const { return compliance_per_pa == 0.0 && slack == 0.0 && gain == 1.0 && drift == 1.0; }
};

/// Natural order: digits by their number, the rest letter by letter.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t start = at;
      while (at < text.size() && digit(text[at])) ++at;
      return text.substr(start, at - start);
    };
    const std::string x = number(a, i), y = number(b, j);
    if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // batch-01 and batch-1 are two names
}

}  // namespace

std::vector<PrintContext> print_contexts(const std::vector<SpecimenRecord>& specimens) {
  std::vector<std::string> batches;
  for (const SpecimenRecord& specimen : specimens)
    if (!specimen.batch.empty()) batches.push_back(specimen.batch);
  std::sort(batches.begin(), batches.end(), natural_less);
  batches.erase(std::unique(batches.begin(), batches.end()), batches.end());
  std::vector<PrintContext> contexts;
  for (const SpecimenRecord& specimen : specimens) {
    const auto batch = std::find(batches.begin(), batches.end(), specimen.batch);
    contexts.push_back({.batch_step = batch == batches.end() ? 0.0 : static_cast<double>(batch - batches.begin())});
  }
  return contexts;
}

double observe_modulus(double modulus_pa, const material::Extensions& extensions, const PrintContext& context) {
  const TestingMachine machine(extensions, context);
  if (machine.is_ideal()) return modulus_pa;
  const double printed_pa = machine.drift * modulus_pa;
  return machine.gain * printed_pa / (1.0 + machine.compliance_per_pa * printed_pa);
}

double observe_toughness(double toughness_pa, const material::Extensions& extensions, const PrintContext& context) {
  const TestingMachine machine(extensions, context);
  return machine.gain * machine.drift * toughness_pa;
}

double modulus_behind(double recorded_pa, const material::Extensions& extensions) {
  const TestingMachine machine(extensions, {});
  const double left = machine.gain - machine.compliance_per_pa * recorded_pa;
  return left > 0.0 ? recorded_pa / left : std::numeric_limits<double>::infinity();
}

tester::Curve observe_curve(const tester::Curve& curve, const material::Extensions& extensions,
                            const PrintContext& context) {
  const TestingMachine machine(extensions, context);
  if (machine.is_ideal()) return curve;
  tester::Curve recorded;
  if (machine.slack > 0.0) recorded = {.strain = {0.0}, .stress_pa = {0.0}};
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double stress_pa = machine.drift * curve.stress_pa[i];
    recorded.strain.push_back(curve.strain[i] + machine.slack + machine.compliance_per_pa * stress_pa);
    recorded.stress_pa.push_back(machine.gain * stress_pa);
  }
  return recorded;
}

tester::Curve observe_along(const std::vector<double>& recorded_strain, const SpecimenResponse& pull,
                            const material::Extensions& extensions, const PrintContext& context) {
  constexpr double kSmallStrain = 1e-4, kWellKnown = 1e-9;
  constexpr int kMostPasses = 50;
  const TestingMachine machine(extensions, context);
  if (machine.is_ideal()) return pull(recorded_strain);
  std::vector<double> own;
  for (const double strain : recorded_strain) own.push_back(std::max(0.0, strain - machine.slack));
  // A Newton step with the stiffness at the start: at once for a linear specimen, in a few passes for one that flows.
  const double per_pa = machine.compliance_per_pa * machine.drift;
  const double stiffness = per_pa > 0.0 ? pull({kSmallStrain}).stress_pa.front() / kSmallStrain : 0.0;
  tester::Curve pulled = pull(own);
  for (int pass = 0; per_pa > 0.0 && pass < kMostPasses; ++pass) {
    double largest = 0.0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const double excess = own[i] + machine.slack + per_pa * pulled.stress_pa[i] - recorded_strain[i];
      const double next = std::max(0.0, own[i] - excess / (1.0 + per_pa * stiffness));
      largest = std::max(largest, std::abs(next - own[i]));
      own[i] = next;
    }
    if (largest < kWellKnown) break;
    pulled = pull(own);
  }
  pulled.strain = recorded_strain;
  for (double& stress : pulled.stress_pa) stress *= machine.gain * machine.drift;
  return pulled;
}

}  // namespace nacre::measurement
