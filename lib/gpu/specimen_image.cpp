#include "gpu/specimen_image.hpp"

#include "fem/explicit_solver.hpp"

namespace nacre::gpu {
namespace {

/// Calls visit(pointer to an array, how long it is) for every array that the state has.
template <class State, class Visit>
void visit_arrays(State& s, std::size_t nodes, std::size_t elements, const Visit& visit) {
  for (auto* array : {&s.qx, &s.qy, &s.vx, &s.vy}) visit(*array, nodes);
  for (auto* array : {&s.mu, &s.lambda, &s.threshold}) visit(*array, elements);
  visit(s.row.weight, static_cast<std::size_t>(s.stride));
  const auto visit_if_there = [&](auto& array) {
    if (array != nullptr) visit(array, elements);
  };
  for (auto* array : {&s.eigenstrain, &s.inverse_limit, &s.flow_strain, &s.onset, &s.integrity}) visit_if_there(*array);
  for (auto& point : s.plastic)
    for (auto& component : point) visit_if_there(component);
  for (auto& point : s.branch)
    for (auto& component : point) visit_if_there(component);
}

}  // namespace

Specimen SpecimenImage::bind(float* memory) const {
  Specimen bound = specimen;
  const auto next = [&memory](std::size_t count) {
    float* const at = memory;
    memory += count;
    return at;
  };
  visit_arrays(bound.state, nodes, elements, [&](float*& array, std::size_t count) { array = next(count); });
  bound.other_vx = next(nodes);
  bound.other_vy = next(nodes);
  for (float*& corner : bound.corner) corner = next(elements);
  return bound;
}

SpecimenImage image_of(const fem::ExplicitSolver<float>& solver, double strain_per_step) {
  SpecimenImage image;
  Specimen& specimen = image.specimen;
  specimen.state = solver.state();
  fem::ExtendedState<float>& s = specimen.state;
  image.nodes = static_cast<std::size_t>(s.rows + 1) * static_cast<std::size_t>(s.stride);
  image.elements = static_cast<std::size_t>(s.rows) * static_cast<std::size_t>(s.element_stride);
  visit_arrays(s, image.nodes, image.elements, [&](const float* array, std::size_t count) {
    image.block.insert(image.block.end(), array, array + count);
  });
  specimen.initial_strain = solver.strain();
  specimen.strain_per_step = strain_per_step;
  specimen.extended = solver.has_extended_law();
  s.strain = static_cast<float>(specimen.initial_strain);
  s.failed = nullptr;
  return image;
}

std::vector<std::int32_t> by_element(const fem::ExtendedState<float>& state, const std::vector<std::int32_t>& padded) {
  std::vector<std::int32_t> values;
  for (int row = 0; row < state.rows; ++row) {
    const auto first = padded.begin() + static_cast<std::ptrdiff_t>(row) * state.element_stride;
    values.insert(values.end(), first, first + state.columns);
  }
  return values;
}

}  // namespace nacre::gpu
