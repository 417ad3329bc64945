// Part of the conversions (convert.hpp): FRACTURE.

#include <algorithm>

#include "wire/channels.hpp"
#include "wire/checks.hpp"
#include "wire/convert.hpp"

namespace nacre::wire {
namespace {

constexpr int kLargestGridSide = 4096;
/// A longer path than this many elements is cut off: no specimen has room for one that means anything.
constexpr std::size_t kMaximumPath = 4000;
constexpr double kLargestLength = 100.0;  // m

Result<void> expect_elements(std::string_view member, const std::vector<std::int32_t>& elements, int element_count) {
  for (const std::int32_t element : elements)
    if (element < 0 || element >= element_count)
      return fail("{}: there is no element {} among {}", member, element, element_count);
  return {};
}

Result<crack::CrackPath> path_from_wire(const fracture_t& message) {
  const double shares = message.material_share[0] + message.material_share[1] + message.material_share[2];
  const Result<void> sound =
      all_of(expect_range("straight_length_m", message.straight_length_m, 1e-9, kLargestLength),
             expect_range("length_m", message.length_m, message.straight_length_m * (1.0 - 1e-9), kLargestLength),
             expect_range("bridged_share", message.bridged_share, 0.0, 1.0),
             expect_range("material_share[0]", message.material_share[0], 0.0, 1.0),
             expect_range("material_share[1]", message.material_share[1], 0.0, 1.0),
             expect_range("material_share[2]", message.material_share[2], 0.0, 1.0),
             expect_range("sum of material_share", shares, 1.0 - 1e-9, 1.0 + 1e-9),
             expect_range("n_path", message.n_path, 1, static_cast<double>(kMaximumPath)),
             expect_elements("path", message.path, message.columns * message.rows));
  if (!sound) return tl::unexpected(sound.error());
  crack::CrackPath path{.elements = {message.path.begin(), message.path.end()},
                        .length_m = message.length_m,
                        .straight_length_m = message.straight_length_m,
                        .bridged_share = message.bridged_share,
                        .material = {},
                        .crosses = message.crosses != 0};
  std::ranges::copy(message.material_share, path.material.begin());
  return path;
}

void add_path(fracture_t& message, const crack::CrackPath& path) {
  message.has_path = 1;
  message.crosses = path.crosses;
  message.length_m = path.length_m;
  message.straight_length_m = path.straight_length_m;
  message.bridged_share = path.bridged_share;
  std::ranges::copy(path.material, message.material_share);
  const std::size_t kept = std::min(path.elements.size(), kMaximumPath);
  message.path.assign(path.elements.begin(), path.elements.begin() + static_cast<std::ptrdiff_t>(kept));
  message.n_path = static_cast<std::int32_t>(kept);
}

/// Whoever opens the file looks in RUN/films and nowhere else.
Result<void> expect_file_of_films(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  const bool is_name = name.size() <= 200 && !name.starts_with('.') && std::ranges::all_of(name, is_plain);
  if (name.empty() || (is_name && name.ends_with(".film"))) return {};
  return fail("film: \"{}\" is no name of a file in RUN/films", name);
}

}  // namespace

fracture_t to_wire(const Fracture& fracture) {
  fracture_t message{};
  message.request_id = fracture.request_id;
  message.design_index = fracture.design_index;
  message.design = fracture.design.name();
  message.film = fracture.film;
  message.columns = fracture.crack.columns;
  message.rows = fracture.crack.rows;
  message.branches = fracture.crack.branches;
  message.separate_cracks = fracture.crack.separate_cracks;
  if (fracture.crack.path) add_path(message, *fracture.crack.path);
  message.broken = fracture.broken;
  for (const tester::Break& broken : fracture.crack.order) {
    if (message.element.size() == kMaximumBreaks) break;
    message.element.push_back(broken.element);
    message.strain.push_back(static_cast<float>(broken.strain));
  }
  message.n_order = static_cast<std::int32_t>(message.element.size());
  return message;
}

Result<Fracture> from_wire(const fracture_t& message) {
  constexpr std::string_view type = "fracture_t";
  if (requester_of(message.request_id).empty()) {
    return fail("{}: request_id \"{}\" does not begin with a node's name and '/'", type, message.request_id);
  }
  const Result<pattern::Design> design = pattern::design_from_name(message.design);
  if (!design) return fail("{}: {}", type, design.error().message);
  const Result<void> shape = all_of(expect_range("columns", message.columns, 1, kLargestGridSide),
                                    expect_range("rows", message.rows, 1, kLargestGridSide));
  if (!shape) return fail("{}: {}", type, shape.error().message);
  const int element_count = message.columns * message.rows;
  const Result<void> sound =
      all_of(expect_name("request_id", message.request_id),
             expect_range("design_index", message.design_index, 0, kMaximumDesigns - 1.0),
             expect_range("branches", message.branches, 0, element_count),
             expect_range("separate_cracks", message.separate_cracks, 0, element_count),
             expect_range("broken", message.broken, message.n_order, element_count),
             expect_range("n_order", message.n_order, 0, static_cast<double>(kMaximumBreaks)),
             expect_elements("element", message.element, element_count), expect_file_of_films(message.film));
  if (!sound) return fail("{}: {}", type, sound.error().message);
  Fracture fracture{.request_id = message.request_id,
                    .design_index = message.design_index,
                    .design = *design,
                    .crack = {},
                    .broken = message.broken,
                    .film = message.film};
  fracture.crack.columns = message.columns;
  fracture.crack.rows = message.rows;
  fracture.crack.branches = message.branches;
  fracture.crack.separate_cracks = message.separate_cracks;
  if (message.has_path != 0) {
    Result<crack::CrackPath> path = path_from_wire(message);
    if (!path) return fail("{}: {}", type, path.error().message);
    fracture.crack.path = *std::move(path);
  }
  for (std::size_t i = 0; i < message.element.size(); ++i) {
    const Result<void> strain = expect_range("strain", message.strain[i], 0.0, kLargestStrain);
    if (!strain) return fail("{}: {}", type, strain.error().message);
    fracture.crack.order.push_back({message.element[i], message.strain[i]});
  }
  return fracture;
}

}  // namespace nacre::wire
