#pragma once
// Physical (or virtual-laboratory) measurements: one row per specimen.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measurement/limits.hpp"
#include "pattern/design.hpp"
#include "tester/curve.hpp"
#include "tester/tester.hpp"

namespace nacre::measurement {

/// One tested specimen, as in a row of measurements.csv or a MEASUREMENT message.
struct SpecimenRecord {
  std::string specimen;  ///< unique name
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  std::string batch;
  int print_order = 0;  ///< 0 when unknown
  std::optional<double> modulus_pa;
  std::optional<double> toughness_pa;  ///< a given value wins over the area under the curve
  tester::Curve curve;                 ///< empty when none was recorded
  bool valid = true;
  std::string note;
  /// Columns of the file that nacre does not know, by name, empty cells left out; written back as they were.
  std::map<std::string, std::string> other_columns;
  bool operator==(const SpecimenRecord&) const = default;
};

/// A row that could not be used.
struct RejectedRow {
  int line = 0;
  std::string column;  ///< empty when it is the row as a whole
  std::string reason;  ///< a sentence with what was expected
};

struct MeasurementSet {
  std::vector<SpecimenRecord> specimens;  ///< in the order of the file
  std::vector<int> lines;                 ///< of each specimen in the table
  std::vector<RejectedRow> rejected;
  std::vector<std::string> warnings;
};

/// Reads a measurement set: a folder with measurements.csv and the curve files it names (format: docs/FORMATS.md). One
/// bad row does not lose the others. Throws InputError when the folder or the table cannot be read or no row is usable.
MeasurementSet read_measurement_set(const std::filesystem::path& folder);

/// The same for whoever computes with the values: valid rows outside kModulusPa and kToughnessPa are rejected, too, for
/// one modulus in GPa draws a whole fit after it. Throws InputError also when none is left.
MeasurementSet read_plausible_set(const std::filesystem::path& folder);

/// Writes measurements.csv and curves/SPECIMEN.csv, or SPECIMEN~2.csv and so on where a file of that name is there:
/// only the table is written over. Throws InputError when the folder cannot be written.
void write_measurement_set(const std::filesystem::path& folder, const std::vector<SpecimenRecord>& specimens);

/// What was measured of one design under one set of conditions, from its valid specimens.
struct Replicates {
  pattern::Design design;
  tester::TestConditions conditions;
  std::string batch_list;              ///< batches joined by a comma
  std::vector<std::string> specimens;  ///< names of the valid specimens, sorted
  int modulus_count = 0, toughness_count = 0;
  double modulus_pa = 0.0, modulus_sd_pa = 0.0;  ///< mean and sample standard deviation; 0 when not measured
  double toughness_pa = 0.0, toughness_sd_pa = 0.0;
  double modulus_batch_step = 0.0,
         toughness_batch_step = 0.0;   ///< means of print_contexts()
  tester::Curve representative_curve;  ///< of the specimen whose toughness is nearest to the mean; empty when none
};

/// Groups valid specimens by design and conditions (modulus, toughness specimens of one design come together). Sorted
/// by design name, then conditions, so that the order of arrival never matters. `tensile` coupons are not included.
std::vector<Replicates> summarise(const std::vector<SpecimenRecord>& specimens);

/// Modulus of a modulus test's specimen: the given value, else the slope of its curve between 0.05 and 0.25 % strain,
/// by least squares, or of the chord where fewer than three points lie there (docs/FORMATS.md); else nothing.
std::optional<double> modulus_of(const SpecimenRecord& specimen);

/// Toughness of a specimen: the given value, else the area under its curve; nothing when it has neither.
std::optional<double> toughness_of(const SpecimenRecord& specimen);

inline constexpr std::string_view kTensileIsHomogeneous =
    "a tensile coupon is homogeneous, expected rigid, soft, interface or mix:F";

/// What a specimen lacks to say anything of what its test tests: a value of that kind or a curve that gives one; a
/// tensile coupon is homogeneous. Its column and what was expected. Line 0.
std::optional<RejectedRow> missing_result(const SpecimenRecord& specimen);

/// The modulus or toughness that the specimen's test measured, or that is given for it, where it lies outside
/// kModulusPa or kToughnessPa: its column and why no game can use it. Line 0.
std::optional<RejectedRow> implausible_value(const SpecimenRecord& specimen);

/// Doubts about a usable specimen that it raises by itself, each as a sentence that begins with its column: units that
/// somebody forgot to convert, a value beside its own curve, a pull that was ended too early.
std::vector<std::string> doubts_about(const SpecimenRecord& specimen);

/// Why no game can use the specimen as a valid one: what it lacks, else a value that is implausible. Line 0.
std::optional<RejectedRow> why_unusable(const SpecimenRecord& specimen);

/// Where a specimen stands among the others of its set, for the effects that go with it.
struct PrintContext {
  double batch_step = 0.0;  ///< batches after the first one, in the order of printing
};

/// The contexts of a set's specimens, in their order. Batches follow each other by name, numbers in their natural order
/// (batch-2 before batch-10); a specimen without batch counts to the first.
std::vector<PrintContext> print_contexts(const std::vector<SpecimenRecord>& specimens);

/// Measurement-side extensions: what the testing machine shows of a specimen whose true modulus is `modulus_pa`,
/// printed in that context. Stiffness drifts by the batch, E (1 + d)^step; a machine of compliance c (1/Pa) is a spring
/// in series, 1/E_shown = 1/E + c; the load cell shows 1 + g of the force. Exactly the identity without extensions.
double observe_modulus(double modulus_pa, const material::Extensions& extensions, const PrintContext& context = {});
/// The same for the toughness of a specimen pulled to separation, whose compliance gives back what it took.
double observe_toughness(double toughness_pa, const material::Extensions& extensions, const PrintContext& context = {});
/// The modulus that the machine would show as `shown_pa`, for prints that have not drifted; infinite where its
/// compliance alone is more than that.
double modulus_behind(double shown_pa, const material::Extensions& extensions);
/// The same for a curve: strain_shown = slack + strain + c stress, with a first point (0, 0) before the slack is taken
/// up. Strain may decrease where stress falls steeply.
tester::Curve observe_curve(const tester::Curve& curve, const material::Extensions& extensions,
                            const PrintContext& context = {});

/// Stresses of a specimen along a history of its own strains.
using Pull = std::function<tester::Curve(const std::vector<double>& strain)>;

/// The other way round: what the machine shows at strains that it recorded, on the way back too. The specimen itself is
/// stretched by less, strain = shown - slack - c stress, and by nothing while slack is taken up.
tester::Curve observe_along(const std::vector<double>& shown_strain, const Pull& pull,
                            const material::Extensions& extensions, const PrintContext& context = {});

}  // namespace nacre::measurement
