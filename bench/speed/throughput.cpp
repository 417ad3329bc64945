// Figure 3-5 of the thesis in our terms: seconds per sample of both testers against batch size and strain limit, on all
// allowed cores. Writes a table (CSV) and a figure (SVG). Results: docs/studies/speed.md.
//
// Seconds per sample are processor time over the number of cores a batch can use, min(batch, cores), which is the wall
// time on a machine that does nothing else; the wall time is in the table too.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <CLI/CLI.hpp>

#include "base/parallel.hpp"
#include "cpu_time.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"
#include "tester/modulus.hpp"

namespace {

using namespace nacre;
using namespace nacre::bench;

struct ThroughputPoint {
  std::string series;  ///< "modulus", or "toughness to strain 0.05"
  int batch = 0;
  double processor_seconds = 0.0, wall_seconds = 0.0, steps = 0.0;  ///< per sample
  double seconds(int cores) const { return processor_seconds / std::min(batch, cores); }
};

/// Runs work(i) for the samples of one batch; the number of steps it returns is averaged.
template <class Work>
ThroughputPoint run_batch(const std::string& series, int batch, const Work& work) {
  std::vector<double> seconds(batch), steps(seconds.size());
  const auto start = std::chrono::steady_clock::now();
  parallel_for(batch, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    seconds[at] = seconds_of([&] { steps[at] = work(i); });
  });
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  ThroughputPoint point{.series = series, .batch = batch, .wall_seconds = wall.count() / batch};
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    point.processor_seconds += seconds[i] / batch;
    point.steps += steps[i] / batch;
  }
  return point;
}

/// A logarithmic axis: value to picture.
struct Axis {
  double low, high, from, to;
  double place(double value) const { return from + (to - from) * std::log(value / low) / std::log(high / low); }
};

void draw(std::ostream& out, const std::vector<ThroughputPoint>& points, int cores) {
  const Axis x{.low = 1.0, .high = 128.0, .from = 70.0, .to = 560.0};
  const Axis y{.low = 1e-3, .high = 10.0, .from = 340.0, .to = 20.0};
  fmt::print(out,
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"400\" font-family=\"sans-serif\" "
             "font-size=\"12\">\n<rect width=\"760\" height=\"400\" fill=\"white\"/>\n");
  for (double value = y.low; value <= y.high * 1.01; value *= 10.0)
    fmt::print(
        out, "<path d=\"M{} {:.1f}H{}\" stroke=\"#ddd\"/><text x=\"64\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n",
        x.from, y.place(value), x.to, y.place(value) + 4, value);
  for (int value = 1; value <= 128; value *= 2)
    fmt::print(
        out,
        "<path d=\"M{:.1f} {}V{}\" stroke=\"#eee\"/><text x=\"{:.1f}\" y=\"358\" text-anchor=\"middle\">{}</text>\n",
        x.place(value), y.from, y.to, x.place(value), value);
  fmt::print(
      out,
      "<text x=\"315\" y=\"385\" text-anchor=\"middle\">batch size</text>\n"
      "<text transform=\"translate(16 180) rotate(-90)\" text-anchor=\"middle\">seconds per sample, {} cores</text>\n",
      cores);
  std::map<std::string, std::vector<ThroughputPoint>> series;
  for (const ThroughputPoint& point : points) series[point.series].push_back(point);
  static constexpr const char* kColours[] = {"#0b6e4f", "#b5179e", "#4361ee", "#f77f00", "#7f5539", "#444"};
  std::size_t next = 0;
  for (const auto& [name, members] : series) {
    const char* const colour = kColours[next++ % std::size(kColours)];
    std::string path;
    for (const ThroughputPoint& point : members)
      path +=
          fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.place(point.batch), y.place(point.seconds(cores)));
    fmt::print(out,
               "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\" "
               "fill=\"{}\">{}</text>\n",
               path, colour, x.place(members.back().batch) + 6, y.place(members.back().seconds(cores)) + 4, colour,
               name);
  }
  fmt::print(out, "</svg>\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Seconds per sample of both testers against batch size and strain limit"};
  std::vector<int> toughness_batches = {1, 2, 5, 10, 20}, modulus_batches = {1, 2, 5, 10, 20, 50, 100};
  std::vector<double> limits = {0.01, 0.02, 0.05, 0.1};
  std::string table = "throughput.csv", figure = "throughput.svg";
  app.add_option("--batches", toughness_batches, "batch sizes of the toughness tester");
  app.add_option("--limits", limits, "strain limits");
  app.add_option("--table", table, "CSV file");
  app.add_option("--figure", figure, "SVG file");
  CLI11_PARSE(app, argc, argv);
  RandomStream random(1, "throughput");
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(20, random);
  const auto simulation = [&](int i) {
    return tester::Simulation{.design = patterns[static_cast<std::size_t>(i) % patterns.size()],
                              .parameters = material::default_parameters(),
                              .conditions = {}};
  };
  const auto modulus = [&](int i) {
    (void)tester::test_modulus(simulation(i)).value();
    return 0.0;  // no steps: a static solution
  };
  std::vector<ThroughputPoint> points;
  for (const int batch : modulus_batches) points.push_back(run_batch("modulus", batch, modulus));
  for (const double limit : limits)
    for (const int batch : toughness_batches)
      points.push_back(run_batch(fmt::format("toughness to strain {}", limit), batch, [&](int i) {
        tester::FractureTest test = tester::fracture_test(simulation(i));
        test.strain_limit = limit;
        return static_cast<double>(tester::run_fracture_test<float>(test).value().steps);
      }));
  const int cores = allowed_cores();
  std::ofstream csv(table), svg(figure);
  fmt::print(csv,
             "series,batch,seconds_per_sample,processor_seconds_per_sample,wall_seconds_per_sample,steps_per_sample\n");
  for (const ThroughputPoint& point : points)
    fmt::print(csv, "{},{},{:.5g},{:.5g},{:.5g},{:.0f}\n", point.series, point.batch, point.seconds(cores),
               point.processor_seconds, point.wall_seconds, point.steps);
  draw(svg, points, cores);
}
