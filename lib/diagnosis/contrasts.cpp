#include "diagnosis/contrasts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/result.hpp"
#include "material/surroundings_laws.hpp"
#include "material/temperature_shift.hpp"

namespace nacre::diagnosis {
namespace {

using pattern::kSide;
using pattern::Layout;

/// Pixel with periodic indices: a layout is repeated over the specimen.
bool at(const Layout& layout, int row, int column) {
  return layout.rigid((row + kSide) % kSide, (column + kSide) % kSide);
}

/// Share of neighbouring pixel pairs that differ; pairs across (dr = 0, dc = 1) or along (dr = 1, dc = 0) the load.
double interface_share(const Layout& layout, int dr, int dc) {
  int differing = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) differing += at(layout, r, c) != at(layout, r + dr, c + dc);
  }
  return differing / static_cast<double>(pattern::kPixels);
}

/// Mean length in pixels of unbroken runs of one phase in both directions.
double mean_run(const Layout& layout, bool rigid) {
  int pixels = 0, ends = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      if (at(layout, r, c) != rigid) continue;
      pixels += 2;
      ends += at(layout, r, c + 1) != rigid;
      ends += at(layout, r + 1, c) != rigid;
    }
  }
  return ends > 0 ? pixels / static_cast<double>(ends) : kSide;
}

/// Share of pixel corners where only diagonal neighbours agree: the phases touch point to point.
double diagonal_contacts(const Layout& layout) {
  int count = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const bool a = at(layout, r, c), b = at(layout, r, c + 1), d = at(layout, r + 1, c), e = at(layout, r + 1, c + 1);
      count += a == e && b == d && a != b;
    }
  }
  return count / static_cast<double>(pattern::kPixels);
}

/// Share of pixel corners where the four pixels do not all agree.
double mixed_corners(const Layout& layout) {
  int count = 0;
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const int sum = at(layout, r, c) + at(layout, r, c + 1) + at(layout, r + 1, c) + at(layout, r + 1, c + 1);
      count += sum != 0 && sum != 4;
    }
  }
  return count / static_cast<double>(pattern::kPixels);
}

/// 1 when rigid pixels, joined by edges, connect bottom and top of the unit.
double rigid_percolates(const Layout& layout) {
  std::array<std::array<bool, kSide>, kSide> seen{};
  std::vector<std::pair<int, int>> open;
  for (int c = 0; c < kSide; ++c) {
    if (layout.rigid(0, c)) open.emplace_back(0, c), seen[0][c] = true;
  }
  constexpr std::array<std::pair<int, int>, 4> kNeighbours = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  while (!open.empty()) {
    const auto [r, c] = open.back();
    open.pop_back();
    if (r == kSide - 1) return 1.0;
    for (const auto& [dr, dc] : kNeighbours) {
      const int nr = r + dr, nc = (c + dc + kSide) % kSide;
      if (nr < 0 || nr >= kSide || !layout.rigid(nr, nc) || seen[nr][nc]) continue;
      seen[nr][nc] = true;
      open.emplace_back(nr, nc);
    }
  }
  return 0.0;
}

struct LayoutDescriptor {
  const char* name;
  double (*of)(const Layout&);
};

constexpr std::array kLayoutDescriptors = {
    LayoutDescriptor{"interface length across the load", [](const Layout& l) { return interface_share(l, 0, 1); }},
    LayoutDescriptor{"interface length along the load", [](const Layout& l) { return interface_share(l, 1, 0); }},
    LayoutDescriptor{"run length of the rigid phase", [](const Layout& l) { return mean_run(l, true); }},
    LayoutDescriptor{"run length of the soft phase", [](const Layout& l) { return mean_run(l, false); }},
    LayoutDescriptor{"point contacts at pixel corners", diagonal_contacts},
    LayoutDescriptor{"mixed pixel corners", mixed_corners},
    LayoutDescriptor{"percolation of the rigid phase", rigid_percolates},
};

/// Features along which designs are compared; the others only as a whole.
constexpr std::array kDescribed = {Feature::log_modulus, Feature::log_toughness, Feature::log_tangent_30,
                                   Feature::log_peak};

/// Appends the direction when it varies over the rows it is about: centred there, unit length.
void add_if_varying(std::vector<ContrastDirection>& directions, const std::string& name, const ContrastView& view,
                    Eigen::VectorXd values, const std::vector<int>& rows) {
  double mean = 0.0;
  for (const int row : rows) mean += values[row] / static_cast<double>(rows.size());
  double largest = 0.0;
  for (const int row : rows) largest = std::max(largest, std::abs(values[row])), values[row] -= mean;
  const double length = values.norm();
  if (length < 1e-9 * (1.0 + largest) * static_cast<double>(rows.size() + 1)) return;
  directions.push_back({name, view, values / length});
}

/// Rows of one feature, by test: of notched specimens `homogeneous` or layouts, of others both.
std::vector<int> rows_of(const Observations& observations, Feature feature, tester::TestKind test,
                         bool homogeneous = false) {
  std::vector<int> rows;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.kind != RowKind::mean || row.feature != feature || row.test != test) continue;
    if (is_notched_bulk(observations.group_of(i)) == homogeneous) rows.push_back(i);
  }
  return rows;
}

/// The mean over these rows; nothing without any.
void add_whole(std::vector<ContrastDirection>& directions, const std::string& name, const ContrastView& view,
               const Observations& observations, const std::vector<int>& rows) {
  if (rows.empty()) return;
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(observations.size());
  for (const int row : rows) whole[row] = 1.0 / std::sqrt(static_cast<double>(rows.size()));
  directions.push_back({name, view, whole});
}

using Kinds = std::set<std::pair<Feature, tester::TestKind>>;

/// The feature in words, and of which specimens where two kinds of test show it.
std::string name_of(Feature feature, tester::TestKind test, const Kinds& kinds) {
  const bool alone = std::ranges::count_if(kinds, [feature](const auto& kind) { return kind.first == feature; }) == 1;
  if (alone) return std::string(in_words(feature));
  return fmt::format("{} of {}", in_words(feature),
                     test == tester::TestKind::tensile ? "coupons" : "notched specimens");
}

/// That of a name that is none, like "material" or "level", is `design`.
DescriptorKind kind_of(std::string_view name) {
  static const std::vector<Descriptor> all = descriptors();
  const auto found = std::ranges::find(all, name, &Descriptor::name);
  return found == all.end() ? DescriptorKind::design : found->kind;
}

Eigen::VectorXd spread(const Observations& observations, const std::vector<int>& rows,
                       const std::function<double(const Observation&)>& value) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(observations.size());
  for (const int row : rows) values[row] = value(observations.group_of(row));
  return values;
}

}  // namespace

std::vector<Descriptor> descriptors() {
  using enum DescriptorKind;
  std::vector<Descriptor> all = {
      {"rigid fraction", design, [](const Observation& g) { return g.design.rigid_fraction(); }},
      {"orientation", condition_with_law, [](const Observation& g) { return g.conditions.orientation_deg; }},
      {std::string(kStrainRate), condition_with_law,
       [](const Observation& g) { return std::log(g.conditions.strain_rate_per_s); }},
      {"thickness", condition_with_law, [](const Observation& g) { return g.conditions.thickness_mm; }},
      {"print order", condition_with_law, [](const Observation& g) { return g.print_order; }},
      {"batch", condition_with_law, [](const Observation& g) { return g.batch_step; }},
      // Where it is not noted: the standard atmosphere of ISO 291, and new.
      {"temperature", condition_without_law,
       [](const Observation& g) { return g.surroundings.temperature_c.value_or(material::kReferenceTemperatureC); }},
      {"humidity", condition_without_law,
       [](const Observation& g) { return g.surroundings.humidity_pct.value_or(material::kReferenceHumidityPct); }},
      {"age", condition_without_law,
       [](const Observation& g) { return std::log1p(g.surroundings.age_days.value_or(0.0)); }},
      {"machine", condition_without_law, [](const Observation& g) { return static_cast<double>(g.machine); }},
  };
  for (const LayoutDescriptor& descriptor : kLayoutDescriptors)
    all.push_back({descriptor.name, design, [of = descriptor.of](const Observation& g) {
                     return g.design.layout() ? of(*g.design.layout()) : 0.0;
                   }});
  return all;
}

bool is_condition(std::string_view descriptor) { return kind_of(descriptor) != DescriptorKind::design; }

bool is_without_law(std::string_view descriptor) {
  return kind_of(descriptor) == DescriptorKind::condition_without_law;
}

std::vector<ContrastDirection> contrast_directions(const Observations& observations, const Eigen::VectorXd& predicted) {
  std::vector<ContrastDirection> directions;
  Kinds kinds;
  for (const DataRow& row : observations.rows)
    if (row.kind == RowKind::mean) kinds.emplace(row.feature, row.test);
  for (const auto& [feature, test] : kinds) {
    const std::vector<int> rows = rows_of(observations, feature, test);
    const std::string whole_name = name_of(feature, test, kinds);
    const std::string prefix = kinds.size() > 1 ? whole_name + " against " : "";
    // One feature against the others: how far all specimens are off in it alone.
    if (kinds.size() > 1) add_whole(directions, whole_name, {feature, test, ""}, observations, rows);
    if (test == tester::TestKind::toughness)
      add_whole(directions, whole_name + " of homogeneous specimens", {feature, test, ""}, observations,
                rows_of(observations, feature, test, true));
    if (rows.empty()) continue;
    if (std::find(kDescribed.begin(), kDescribed.end(), feature) == kDescribed.end()) continue;
    Eigen::VectorXd level = Eigen::VectorXd::Zero(observations.size());
    for (const int row : rows) level[row] = predicted[row];
    add_if_varying(directions, prefix + (feature == Feature::log_modulus ? "stiffness level" : "level"),
                   {feature, test, std::string(kPredictedLevel)}, level, rows);
    for (const Descriptor& descriptor : descriptors())
      add_if_varying(directions, prefix + descriptor.name, {feature, test, descriptor.name},
                     spread(observations, rows, descriptor.of), rows);
    for (std::size_t machine = 0; observations.machines.size() > 2 && machine < observations.machines.size(); ++machine)
      add_if_varying(directions, fmt::format("{}machine \"{}\"", prefix, observations.machines[machine]),
                     {feature, test, "machine"},
                     spread(observations, rows,
                            [&](const Observation& g) { return g.machine == static_cast<int>(machine) ? 1.0 : 0.0; }),
                     rows);
  }
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    if (row.kind == RowKind::mean || row.kind == RowKind::batch_rest) continue;
    if (row.kind == RowKind::constant) {
      const std::string_view material = kConstantMaterials[row.material];
      directions.push_back(
          {fmt::format("E of the {} material in layouts against that of {} specimens", material, material),
           {row.feature, row.test, "", row.material},
           Eigen::VectorXd::Unit(observations.size(), i)});
      continue;
    }
    if (row.kind == RowKind::scatter) {
      directions.push_back({fmt::format("scatter of {} between replicates", in_words(row.feature)),
                            {row.feature, row.test, ""},
                            Eigen::VectorXd::Unit(observations.size(), i)});
      continue;
    }
    directions.push_back({fmt::format("{} from {} to the next", in_words(row.feature),
                                      row.kind == RowKind::batch ? "one batch" : "one specimen printed"),
                          {row.feature, row.test, ""},
                          Eigen::VectorXd::Unit(observations.size(), i)});
  }
  for (const BatchOffset& offset : observations.batch_offsets) {
    if (!offset.is_off_change) continue;
    directions.push_back({fmt::format("{} of batch \"{}\"", in_words(offset.feature), offset.batch),
                          {offset.feature, offset.test, ""},
                          offset.rows.normalized()});
  }
  return directions;
}

std::vector<ContrastDirection> even_directions(const Observations& observations) {
  using enum DescriptorKind;
  const std::array<Descriptor, 2> conditions = {
      Descriptor{"orientation", condition_with_law, [](const Observation& g) { return g.conditions.orientation_deg; }},
      Descriptor{"thickness", condition_with_law,
                 [](const Observation& g) { return 1.0 / g.conditions.thickness_mm; }}};
  std::vector<int> rows;
  for (int i = 0; i < observations.size(); ++i) {
    const DataRow& row = observations.rows[i];
    const bool scales = row.feature == Feature::log_modulus || is_curve_stress(row.feature);
    if (row.kind == RowKind::mean && scales) rows.push_back(i);
  }
  std::vector<ContrastDirection> directions;
  for (const Descriptor& condition : conditions)
    add_if_varying(directions, condition.name, {Feature::log_modulus, tester::TestKind::modulus, condition.name},
                   spread(observations, rows, condition.of), rows);
  return directions;
}

std::vector<ContrastDirection> smooth_law_directions(const Observations& observations, const Eigen::VectorXd& predicted,
                                                     std::span<const double> powers) {
  const std::vector<int> rows = rows_of(observations, Feature::log_modulus, tester::TestKind::modulus);
  if (rows.empty()) return {};
  const double largest = predicted(rows).maxCoeff();
  std::vector<ContrastDirection> directions;
  for (const double power : powers) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(observations.size());
    for (const int row : rows) values[row] = std::exp(power * (predicted[row] - largest));
    directions.push_back({fmt::format("the {:g}th power of the stiffness", power),
                          {Feature::log_modulus, tester::TestKind::modulus, std::string(kPredictedLevel)},
                          values.normalized()});
  }
  return directions;
}

}  // namespace nacre::diagnosis
