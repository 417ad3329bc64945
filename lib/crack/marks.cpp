#include "crack/marks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>

namespace nacre::crack {
namespace {

constexpr double kToTheEnd = std::numeric_limits<double>::infinity();

/// The path of a record with the strains at which its elements failed.
struct FailedPath {
  const fem::Grid& grid;
  const std::vector<int>& elements;
  std::map<int, double> strain_of;  ///< of every failed element

  bool failed(int element) const { return strain_of.contains(element); }
  int row(int element) const { return element / grid.columns; }
  fem::Phase phase(int element) const { return grid.phase[element]; }
  /// Strain at which the path reaches its i-th element: when that one, or for an intact one the next failed one,
  /// failed.
  double strain_at(std::size_t i) const {
    for (; i < elements.size(); ++i)
      if (const auto found = strain_of.find(elements[i]); found != strain_of.end()) return found->second;
    return kToTheEnd;
  }
};

FailedPath path_of(const fem::Grid& grid, const CrackRecord& record) {
  FailedPath path{grid, record.path->elements, {}};
  for (const tester::Break& broken : record.order) path.strain_of[broken.element] = broken.strain;
  return path;
}

void mark_deflection(const FailedPath& path, std::vector<Mark>& marks) {
  const int start = path.row(path.elements.front());
  const auto height = [&](int element) { return path.row(element) - start; };
  for (const int sign : {1, -1}) {
    const auto farthest = std::ranges::max_element(path.elements, {}, [&](int e) { return sign * height(e); });
    if (sign * height(*farthest) < kSmallestDeflectionElements) continue;
    const auto at = static_cast<std::size_t>(farthest - path.elements.begin());
    marks.push_back({MarkKind::deflection, *farthest, path.strain_at(at), kToTheEnd});
  }
}

void mark_branching(const FailedPath& path, const CrackRecord& record, std::vector<Mark>& marks) {
  for (const int tip : branch_tips(path.grid, record))
    marks.push_back({MarkKind::branching, tip, path.strain_of.at(tip), kToTheEnd});
}

/// Calls `use(first, end)` for every longest run of path elements that fulfil `belongs`.
template <class Belongs, class Use>
void each_run(const std::vector<int>& elements, const Belongs& belongs, const Use& use) {
  for (std::size_t first = 0; first < elements.size();) {
    std::size_t end = first;
    while (end < elements.size() && belongs(elements[end])) ++end;
    if (end > first) use(first, end);
    first = std::max(end, first + 1);
  }
}

void mark_bridging(const FailedPath& path, std::vector<Mark>& marks) {
  each_run(
      path.elements, [&](int e) { return !path.failed(e); },
      [&](std::size_t first, std::size_t end) {
        marks.push_back({MarkKind::bridging, path.elements[(first + end) / 2], path.strain_at(first), kToTheEnd});
      });
}

void mark_arrest(const FailedPath& path, std::vector<Mark>& marks) {
  std::optional<double> first;
  double tip = 0.0, last = 0.0;
  for (const int element : path.elements) {
    if (!path.failed(element)) continue;
    const double strain = path.strain_of.at(element);
    first = std::min(first.value_or(strain), strain);
    last = std::max(last, strain);
  }
  if (!first) return;
  tip = *first;
  for (const int element : path.elements) {
    if (!path.failed(element)) continue;
    const double strain = path.strain_of.at(element);
    if (path.phase(element) == fem::Phase::soft && strain - tip > kShortestArrest * (last - *first))
      marks.push_back({MarkKind::soft_arrest, element, tip, strain});
    tip = std::max(tip, strain);
  }
}

void mark_guidance(const FailedPath& path, std::vector<Mark>& marks) {
  const auto weak = [&](int e) { return path.failed(e) && path.phase(e) != fem::Phase::rigid; };
  each_run(path.elements, weak, [&](std::size_t first, std::size_t end) {
    if (end - first < static_cast<std::size_t>(kShortestGuidedRun)) return;
    marks.push_back({MarkKind::guidance, path.elements[(first + end) / 2], path.strain_at(end - 1), kToTheEnd});
  });
}

}  // namespace

std::string_view to_string(MarkKind kind) {
  switch (kind) {
    case MarkKind::deflection:
      return "deflection";
    case MarkKind::branching:
      return "branching";
    case MarkKind::bridging:
      return "bridging";
    case MarkKind::soft_arrest:
      return "arrest";
    case MarkKind::guidance:
      return "guided";
  }
  return "";
}

std::vector<Mark> marks_of(const fem::Grid& notched, const CrackRecord& record) {
  std::vector<Mark> marks;
  if (!record.path || record.path->elements.empty()) return marks;
  const FailedPath path = path_of(notched, record);
  mark_deflection(path, marks);
  mark_branching(path, record, marks);
  mark_bridging(path, marks);
  mark_arrest(path, marks);
  mark_guidance(path, marks);
  return marks;
}

}  // namespace nacre::crack
