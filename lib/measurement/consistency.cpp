#include "measurement/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/statistics.hpp"
#include "measurement/conditions.hpp"
#include "measurement/reduction.hpp"
#include "measurement/specimen_checks.hpp"
#include "measurement/summary.hpp"
#include "measurement/surroundings.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

using Members = std::vector<const SpecimenRecord*>;

double value_of(const SpecimenRecord& specimen) {
  const auto value = specimen.test == tester::TestKind::modulus ? modulus_of(specimen) : toughness_of(specimen);
  return value.value_or(0.0);
}

double peak_of(const tester::Curve& curve) {
  return curve.empty() ? 0.0 : *std::max_element(curve.stress_pa.begin(), curve.stress_pa.end());
}

/// The comparable parts of replicates' forward curves: how far a coupon is pulled is the operator's choice, and a
/// modulus test's curve has no information beyond the modulus. Empty where there is nothing to compare.
std::vector<tester::Curve> comparable_curves(const Members& members) {
  std::vector<tester::Curve> curves;
  double common_strain = std::numeric_limits<double>::infinity();
  for (const SpecimenRecord* member : members) {
    const bool is_modulus = member->test == tester::TestKind::modulus;
    curves.push_back(is_modulus ? tester::Curve{} : forward_part(member->curve));
    if (member->test == tester::TestKind::tensile && !curves.back().empty())
      common_strain = std::min(common_strain, curves.back().strain.back());
  }
  for (tester::Curve& curve : curves) {
    curve = tester::cut_at(curve, common_strain);
  }
  return curves;
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// Distance of a number from the median of the others, over their scatter or the usual one, whichever is larger.
double scatters_from_others(double value, const std::vector<double>& others, double usual) {
  std::vector<double> distances;
  const double centre = median(others);
  for (const double other : others) distances.push_back(std::abs(other - centre));
  constexpr double kMadOfNormal = 1.4826;
  return std::abs(value - centre) / std::max(kMadOfNormal * median(distances), usual);
}

/// Area between two curves relative to that under them.
double curve_distance(const tester::Curve& one, const tester::Curve& other) {
  const double area = 0.5 * (tester::area_under(one) + tester::area_under(other));
  return area > 0.0 ? tester::area_between(one, other) / area : 0.0;
}

/// Compares the valid members of one group with each other. Of n curves every pair is compared once: n^2 / 2 areas.
class GroupComparison {
 public:
  GroupComparison(Members members, const ConsistencySettings& settings)
      : members_(std::move(members)), settings_(settings), forward_(comparable_curves(members_)) {
    for (const SpecimenRecord* member : members_) values_.push_back(value_of(*member));
    for (const tester::Curve& curve : forward_) peaks_.push_back(peak_of(curve));
    for (std::size_t i = 0; i < forward_.size(); ++i)
      for (std::size_t k = i + 1; k < forward_.size(); ++k)
        if (!forward_[i].empty() && !forward_[k].empty())
          distances_.push_back({i, k, curve_distance(forward_[i], forward_[k])});
  }

  std::vector<OutlierReason> reasons_against(std::size_t suspect) const {
    std::vector<OutlierReason> reasons;
    const tester::TestKind test = members_[suspect]->test;
    if (test == tester::TestKind::modulus)
      compare(suspect, "modulus", values_, settings_.usual_modulus_scatter, reasons);
    if (test == tester::TestKind::toughness)
      compare(suspect, "toughness", values_, settings_.usual_toughness_scatter, reasons);
    compare(suspect, "peak", peaks_, settings_.usual_peak_scatter, reasons);
    compare_curve(suspect, reasons);
    compare_path(suspect, reasons);
    std::stable_sort(reasons.begin(), reasons.end(),
                     [](const auto& a, const auto& b) { return a.distance > b.distance; });
    return reasons;
  }

 private:
  /// A positive figure on the scale of its logarithm.
  void compare(std::size_t suspect, const char* kind, const std::vector<double>& figures, double usual,
               std::vector<OutlierReason>& reasons) const {
    const double own = figures[suspect];
    std::vector<double> others;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      if (i != suspect && figures[i] > 0.0) others.push_back(std::log(figures[i]));
    }
    if (own <= 0.0 || others.size() < 2) return;
    const double distance = scatters_from_others(std::log(own), others, usual);
    if (distance <= settings_.far) return;
    const double ratio = own / std::exp(median(others));
    reasons.push_back({kind, distance,
                       fmt::format("its {} is {:.0f} % {} the others'", kind, 100.0 * std::abs(ratio - 1.0),
                                   ratio < 1.0 ? "below" : "above")});
  }

  void compare_curve(std::size_t suspect, std::vector<OutlierReason>& reasons) const {
    std::vector<double> own, among_others;
    for (const Pair& pair : distances_)
      (pair.one == suspect || pair.other == suspect ? own : among_others).push_back(pair.distance);
    if (own.size() < 2) return;
    const double distance = median(own) / std::max(median(among_others), settings_.usual_curve_distance);
    if (distance <= settings_.far) return;
    reasons.push_back(
        {"curve", distance,
         fmt::format("its curve differs from the others by {:.0f} % of the area under them, they differ by {:.0f} %",
                     100.0 * median(own), 100.0 * median(among_others))});
  }

  /// In plain words without punctuation: people spell the same crack path differently.
  static std::string path_of(const SpecimenRecord& specimen) {
    const auto noted = specimen.other_columns.find("path");
    if (noted == specimen.other_columns.end()) return "";
    std::string path = noted->second;
    std::replace_if(
        path.begin(), path.end(), [](unsigned char letter) { return std::ispunct(letter) != 0; }, ' ');
    return plain_words(path);
  }

  void compare_path(std::size_t suspect, std::vector<OutlierReason>& reasons) const {
    std::map<std::string, int> counts;
    for (const SpecimenRecord* member : members_) {
      if (!path_of(*member).empty()) ++counts[path_of(*member)];
    }
    const std::string own = path_of(*members_[suspect]);
    if (own.empty() || counts.size() < 2) return;
    const auto common = std::max_element(counts.begin(), counts.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (common->first == own || common->second < 2 || common->second == counts[own]) return;
    reasons.push_back(
        {"path", 0.0, fmt::format("its crack ran `{}`, that of {} others `{}`", own, common->second, common->first)});
  }

  struct Pair {
    std::size_t one, other;
    double distance;
  };
  Members members_;
  ConsistencySettings settings_;
  std::vector<tester::Curve> forward_;
  std::vector<double> values_, peaks_;
  std::vector<Pair> distances_;
};

/// The worst first: a noted path counts as much as the limit.
double severity(const ProposedOutlier& outlier, double far) {
  double largest = 0.0;
  for (const OutlierReason& reason : outlier.reasons)
    largest = std::max(largest, reason.kind == "path" ? far : reason.distance);
  return largest;
}

std::vector<ProposedOutlier> outliers_among(const Members& valid, const ConsistencySettings& settings) {
  std::vector<ProposedOutlier> outliers;
  if (valid.size() < 3) return outliers;  // of two, either may be the outlier
  const GroupComparison comparison(valid, settings);
  for (std::size_t i = 0; i < valid.size(); ++i) {
    auto reasons = comparison.reasons_against(i);
    if (!reasons.empty()) outliers.push_back({valid[i]->specimen, std::move(reasons)});
  }
  std::stable_sort(outliers.begin(), outliers.end(),
                   [&](const auto& a, const auto& b) { return severity(a, settings.far) > severity(b, settings.far); });
  return outliers;
}

void sum_up(const Members& members, std::optional<double>& mean_pa, std::optional<double>& scatter) {
  std::vector<double> values;
  for (const SpecimenRecord* member : members) {
    if (value_of(*member) > 0.0) values.push_back(value_of(*member));
  }
  if (!values.empty()) mean_pa = mean(values);
  if (values.size() > 1) scatter = standard_deviation(values) / *mean_pa;
}

std::string representative_of(const Members& members, double mean_pa) {
  const SpecimenRecord* nearest = nullptr;
  for (const SpecimenRecord* member : members) {
    if (member->curve.empty()) continue;
    if (nearest == nullptr || std::abs(value_of(*member) - mean_pa) < std::abs(value_of(*nearest) - mean_pa))
      nearest = member;
  }
  return nearest == nullptr ? "" : nearest->specimen;
}

ReplicateGroup review_group(const Members& members, const ConsistencySettings& settings) {
  ReplicateGroup group{
      .design = members.front()->design, .test = members.front()->test, .conditions = members.front()->conditions};
  Members valid;
  for (const SpecimenRecord* member : members) {
    group.tested.push_back(member->specimen);
    if (!member->valid) continue;
    group.valid.push_back(member->specimen);
    valid.push_back(member);
  }
  group.proposed = outliers_among(valid, settings);
  const int may_go = std::max(0, static_cast<int>(valid.size()) - settings.fewest_consistent);
  const bool too_many = static_cast<int>(group.proposed.size()) > may_go;
  if (too_many) group.proposed.resize(may_go);
  Members kept;
  std::copy_if(valid.begin(), valid.end(), std::back_inserter(kept), [&](const SpecimenRecord* member) {
    return std::none_of(group.proposed.begin(), group.proposed.end(),
                        [&](const auto& each) { return each.specimen == member->specimen; });
  });
  sum_up(valid, group.mean_pa, group.scatter);
  sum_up(kept, group.mean_without_pa, group.scatter_without);
  group.representative = representative_of(kept, group.mean_without_pa.value_or(0.0));
  group.wanted = std::max({0, settings.fewest_tested - static_cast<int>(members.size()),
                           settings.fewest_consistent - static_cast<int>(kept.size())});
  if (too_many) group.wanted = std::max(group.wanted, 1);
  group.state = too_many ? GroupState::inconsistent : group.wanted > 0 ? GroupState::more_needed : GroupState::complete;
  return group;
}

using ReplicateMembers =
    std::map<std::tuple<std::string, tester::TestKind, double, double, double, std::string>, Members>;

/// Under nominal conditions, by name, each once.
std::vector<SpecimenRecord> nominal_by_name(const std::vector<SpecimenRecord>& specimens) {
  std::vector<SpecimenRecord> nominal = at_nominal_conditions(specimens);
  std::sort(nominal.begin(), nominal.end(), [](const auto& a, const auto& b) { return a.specimen < b.specimen; });
  nominal.erase(std::unique(nominal.begin(), nominal.end(),
                            [](const auto& a, const auto& b) { return a.specimen == b.specimen; }),
                nominal.end());
  return nominal;
}

ReplicateMembers groups_of(const std::vector<SpecimenRecord>& nominal) {
  ReplicateMembers groups;
  for (const SpecimenRecord& specimen : nominal) {
    const tester::TestConditions& c = specimen.conditions;
    Surroundings surroundings = surroundings_of(specimen);
    surroundings.machine.clear();  // replicates on two machines should agree
    groups[{specimen.design.name(), specimen.test, c.orientation_deg, c.strain_rate_per_s, c.thickness_mm,
            nominal_surroundings(surroundings)}]
        .push_back(&specimen);
  }
  return groups;
}

}  // namespace

std::string_view to_string(GroupState state) {
  return state == GroupState::complete ? "complete" : state == GroupState::more_needed ? "more needed" : "inconsistent";
}

std::vector<ReplicateGroup> review_replicates(const std::vector<SpecimenRecord>& specimens,
                                              const ConsistencySettings& settings) {
  const std::vector<SpecimenRecord> nominal = nominal_by_name(specimens);
  std::vector<ReplicateGroup> reviewed;
  for (const auto& [key, members] : groups_of(nominal)) reviewed.push_back(review_group(members, settings));
  return reviewed;
}

std::vector<UnitDoubt> doubts_of_units(const std::vector<SpecimenRecord>& specimens) {
  constexpr double kFar = 8.0;
  const std::vector<SpecimenRecord> nominal = nominal_by_name(specimens);
  std::vector<UnitDoubt> doubts;
  for (const auto& [key, members] : groups_of(nominal)) {
    const auto is_held = [](const SpecimenRecord* member) {
      return member->valid && value_of(*member) > 0.0 && !implausible_value(*member);
    };
    std::vector<double> logs;
    for (const SpecimenRecord* member : members) {
      if (is_held(member)) logs.push_back(std::log(value_of(*member)));
    }
    if (logs.size() < 2) continue;
    // Of two, either may be wrong: each is compared with the other.
    const double far = std::log(kFar) / (logs.size() == 2 ? 2.0 : 1.0), middle = median(logs);
    for (const SpecimenRecord* member : members) {
      const double value = value_of(*member);
      if (!is_held(member) || std::abs(std::log(value) - middle) <= far) continue;
      doubts.push_back(
          {member->specimen,
           fmt::format("specimen {}: its {} is {:.3g} times the median of the {} replicates of {}: is a unit wrong?",
                       member->specimen, tester::to_string(member->test), value / std::exp(middle), logs.size(),
                       member->design.name())});
    }
  }
  return doubts;
}

}  // namespace nacre::measurement
