#pragma once
// The virtual laboratory as its customers see it: a design goes in, replicate specimens come out. What is simulated
// (the same for all replicates) and what scatters or is added by the machine are two steps, so that one simulation
// serves every replicate.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "laboratory/truth.hpp"
#include "measurement/specimen_record.hpp"
#include "tester/loading.hpp"

namespace nacre::laboratory {

/// Rises whenever a response changes: those of another version are not taken for it.
inline constexpr int kResponseVersion = 1;

/// One test of one design: the laboratory's unit of work, which one simulation serves.
struct Experiment {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions = {};
  tester::Fidelity fidelity = tester::Fidelity::full;
  tester::Loading loading = {};              ///< of a coupon; every other test is monotonic
  std::optional<double> hold_s = {};         ///< of a homogeneous modulus: strain is held for so long, not pulled
  std::optional<double> temperature_c = {};  ///< nothing: that of the laboratory, kReferenceC, and not noted
  int specimens = 0;  ///< pulled to separation, as far as they differ; 0: as many as the truth has replicates
  bool operator==(const Experiment&) const = default;
};

/// The specimen's true response, without scatter and before the machine: a modulus, or a curve.
struct TrueResponse {
  double modulus_pa = 0.0;   ///< test `modulus`
  tester::Curve curve = {};  ///< `toughness` and `tensile`
  std::string remark = {};   ///< what a lab book would note, or empty
  /// Where voxels have strengths of their own: curves of further specimens after `curve`, as many in all as the
  /// experiment has. Whoever asks for more gets them again: every one costs a simulation.
  std::vector<tester::Curve> other_curves = {};
};

/// Simulates one test. Pure and thread-safe. Error: what went wrong in the simulation; an experiment that makes no
/// sense
/// (`tensile` of a layout, an orientation other than 0 and 90, fracture at another temperature, a hold that is shorter
/// than two ramps, or of a law that has no relaxation function).
Result<TrueResponse> respond(const Truth& truth, const Experiment& experiment);

/// The same of each of many, on all allowed cores; `done` is called, from one thread at a time, with the index of each
/// that has ended.
std::vector<Result<TrueResponse>> responses_to(const Truth& truth, const std::vector<Experiment>& experiments,
                                               const std::function<void(std::size_t)>& done = {});

/// One replicate: how it is called and where it was printed.
struct Replicate {
  std::string specimen;    ///< names the streams of its scatter
  std::string piece = {};  ///< which is tested several times and has one scatter; empty: the specimen itself
  std::string batch = {};
  int print_order = 0;
  std::string machine = {};        ///< on which it is tested; empty: the laboratory's only one, not noted
  bool on_second_machine = false;  ///< of two
  int number = 1;  ///< among those of its order, from 1: which specimen of a TrueResponse with several it is
};

/// The record of one specimen: the response with this specimen's scatter, seen through the machine, its curve in at
/// most 200 points. A failed simulation gives an invalid specimen with a note, never a number.
measurement::SpecimenRecord record_specimen(const Truth& truth, const Experiment& experiment,
                                            const Result<TrueResponse>& response, const Replicate& replicate);

}  // namespace nacre::laboratory
