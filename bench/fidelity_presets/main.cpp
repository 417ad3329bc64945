// How well a smaller or faster specimen ranks designs by toughness against the thesis' geometry.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/tester.hpp"
using namespace nacre;
int main(int argc, char** argv) {
  CLI::App app{"fidelity presets"};
  std::string variant = "full", out = "t.csv"; double rate = 1; int n = 200; std::string fidelity = "full"; int threads = 0;
  app.add_option("--variant", variant); app.add_option("--rate", rate); app.add_option("--out", out); app.add_option("-n", n);
  app.add_option("--fidelity", fidelity); app.add_option("--threads", threads);
  CLI11_PARSE(app, argc, argv);
  RandomStream random(2026, "fidelity");
  std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(120, random);
  while (patterns.size() < 200) patterns.push_back(pattern::random_pattern(76 + static_cast<int>(patterns.size() % 10), random));
  // interleave so that the first n are a fair sample
  std::vector<pattern::Pattern> order;
  for (int i = 0; i < 40; ++i) { for (int k = 0; k < 3; ++k) order.push_back(patterns[i * 3 + k]); for (int k = 0; k < 2; ++k) order.push_back(patterns[120 + i * 2 + k]); }
  std::map<std::string, int> done;
  { std::ifstream in(out); std::string line; while (std::getline(in, line)) if (line.rfind(variant + ",", 0) == 0) done[line.substr(0, line.find(',', variant.size() + 1))] = 1; }
  std::mutex m; FILE* f = std::fopen(out.c_str(), "a");
  parallel_for(n, [&](int i) {
    const auto& p = order[i];
    if (done.count(variant + "," + p.key())) return;
    const auto t0 = std::chrono::steady_clock::now();
    tester::Numerics numerics; numerics.rate_scale = rate;
    auto r = tester::test_toughness({.design = p, .parameters = material::default_parameters(), .conditions = {}, .fidelity = fidelity == "full" ? tester::Fidelity::full : tester::Fidelity::preview}, numerics);
    double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    std::lock_guard lock(m);
    if (r) fmt::print(f, "{},{},{:.2f},{:.6g},{:.6g},{:.5g},{},{:.3f}\n", variant, p.key(), p.rigid_fraction(), r->toughness_pa, r->peak_stress_pa, r->failure_strain, r->steps, s);
    else fmt::print(f, "{},{},{:.2f},fail\n", variant, p.key(), p.rigid_fraction());
    std::fflush(f);
  }, threads);
}
