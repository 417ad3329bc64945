#include "measurement/surroundings.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/csv.hpp"

namespace nacre::measurement {
namespace {

std::string cell(const SpecimenRecord& specimen, const char* column) {
  const auto found = specimen.other_columns.find(column);
  return found == specimen.other_columns.end() ? "" : std::string(trimmed(found->second));
}

std::optional<double> number(const SpecimenRecord& specimen, const char* column) {
  const Result<double> value = number_from_text(cell(specimen, column));
  return value ? std::optional(*value) : std::nullopt;
}

}  // namespace

Surroundings surroundings_of(const SpecimenRecord& specimen) {
  return {number(specimen, "temperature_c"), number(specimen, "humidity_pct"), number(specimen, "age_days"),
          cell(specimen, "machine"), number(specimen, "hold_s").has_value()};
}

std::string nominal_surroundings(const Surroundings& s) {
  constexpr double kDegrees = 5.0, kHumidity = 10.0, kAge = 1.5;
  std::string text = s.machine;
  if (s.temperature_c) text += fmt::format(" {} degrees", std::lround(*s.temperature_c / kDegrees));
  if (s.humidity_pct) text += fmt::format(" {} humid", std::lround(*s.humidity_pct / kHumidity));
  if (s.age_days && *s.age_days > 0.0)
    text += fmt::format(" {} old", std::lround(std::log(*s.age_days) / std::log(kAge)));
  if (s.held) text += " held";
  return text;
}

}  // namespace nacre::measurement
