#pragma once
// What the program prints: results on standard output, remarks on standard error.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "material/ranges.hpp"
#include "material/starting_model.hpp"
#include "measurement/read_set.hpp"
#include "offline/json_parts.hpp"

namespace nacre::cli {

/// One JSON document on standard output, with a line end; numbers that are not finite become null.
void print_json(const nlohmann::ordered_json& document);

using offline::or_null;
using offline::rejected_json;
using offline::row_json;

/// A line on standard error.
void remark(const std::string& line);
void warn(const std::string& line);
void warn_all(const std::vector<std::string>& lines);

/// What was odd about the measurement set in `folder`, and the rows of it that could not be used.
void warn_about(const measurement::MeasurementSet& set, const std::string& folder);
/// `FOLDER/measurements.csv:LINE: column X: reason`, without column where the row as a whole is wrong.
void warn_about(const measurement::RejectedRow& row, const std::string& folder);
/// The same of any table: `TABLE:LINE: column X: reason`.
void warn_about_table(const measurement::RejectedRow& row, const std::string& table);

/// Throws InputError unless all that was written to standard output has arrived (closed pipe), NoSpace on a full disk.
void check_standard_output();

/// The parameter file given, what it leaves out from `start`; `start` where none is given. Warns of a value that is a
/// hundred times outside the ranges in which it is fitted: its unit may be another. Throws InputError.
material::ParameterSet parameters_from_option(const std::string& file, const material::ParameterSet& start,
                                              const material::ParameterRanges& ranges = material::default_ranges());

/// A figure with four decimals, or with three digits where these would leave little of it.
std::string shown(double value);

/// material::starting_model() of the files given (empty: none), with the warnings of parameters_from_option().
material::StartingModel starting_model_from_options(const std::string& parameters, const std::string& ranges);

/// A fidelity as typed; throws InputError with the choices.
tester::Fidelity fidelity_from_option(const std::string& name);

/// A name of a design as part of a file name: `mix:0.65` becomes mix_0.65.
std::string file_stem(const std::string& design_name);

}  // namespace nacre::cli
