#include "wire/farm_messages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.hpp"
#include "wire/convert.hpp"
#include "wire/schema.hpp"

namespace nacre::wire {

std::string SimulateRequest::contradiction() const {
  const bool is_sound = (modulus || toughness) && (toughness || !(crack || film));
  if (is_sound) return {};
  return fmt::format("tests: {}, expected modulus, toughness or both, and crack or film with toughness only",
                     modulus ? "modulus with crack or film" : "neither modulus nor toughness");
}

std::string SimulateResult::contradiction() const {
  if (std::string fault = index_fault("chunk", chunk, chunks); !fault.empty()) return fault;
  if (results.size() + static_cast<std::size_t>(first) <= kMaximumDesigns) return {};
  return fmt::format("n_results: {} from {} on, a request has at most {}", results.size(), first, kMaximumDesigns);
}

std::string film_fault(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  const bool is_name = name.size() <= 200 && !name.starts_with('.') && std::ranges::all_of(name, is_plain);
  if (name.empty() || (is_name && name.ends_with(".film"))) return {};
  return fmt::format("\"{}\" is no name of a file in RUN/films", name);
}

namespace {

/// What does not fit an index among so many elements.
std::string fault_among(std::string_view name, int index, int element_count) {
  if (index >= 0 && index < element_count) return {};
  return fmt::format("{}: there is no element {} among {}", name, index, element_count);
}

std::string fault_of(const crack::CrackPath& path, int element_count) {
  constexpr double kRounding = 1e-9;
  if (path.length_m < path.straight_length_m * (1.0 - kRounding))
    return fmt::format("length_m: {} is shorter than the straight crack, {}", path.length_m, path.straight_length_m);
  const double shares = path.material[0] + path.material[1] + path.material[2];
  if (std::abs(shares - 1.0) > kRounding) return fmt::format("material_share: the sum is {}, expected 1", shares);
  for (const int element : path.elements)
    if (std::string fault = fault_among("path", element, element_count); !fault.empty()) return fault;
  return {};
}

}  // namespace

std::string Fracture::contradiction() const {
  const int element_count = crack.columns * crack.rows;
  for (const tester::Break& each : crack.order)
    if (std::string fault = fault_among("element", each.element, element_count); !fault.empty()) return fault;
  if (static_cast<std::size_t>(broken) < crack.order.size())
    return fmt::format("broken: {}, but {} elements stand in the order", broken, crack.order.size());
  for (const auto& [name, count] :
       {std::pair{"broken", broken}, {"branches", crack.branches}, {"separate_cracks", crack.separate_cracks}})
    if (count > element_count) return fmt::format("{}: {} among {} elements", name, count, element_count);
  return crack.path ? fault_of(*crack.path, element_count) : "";
}

SimulateRequest with_content_id(SimulateRequest request) {
  const std::string place = std::exchange(request.request_id, {});
  request.request_id = fmt::format("{}#{:016x}", place, content_hash64(write(request)));
  return request;
}

std::vector<SimulateResult> simulate_response(const std::string& request_id,
                                              const std::vector<SimulatedDesign>& results) {
  constexpr std::size_t kRoom = kMaximumBlankPayload - 500;  // the message's own members
  std::vector<SimulateResult> response;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    std::string bytes;
    FieldWriter writer(bytes);
    writer("results", results[i]);
    const std::size_t size = bytes.size();
    if (response.empty() || filled + size > kRoom) {
      response.push_back({request_id, static_cast<int>(response.size()), 1, static_cast<int>(i), {}});
      filled = 0;
    }
    filled += size;
    response.back().results.push_back(results[i]);
  }
  for (SimulateResult& part : response) part.chunks = response.size();
  return response;
}

std::optional<std::vector<SimulatedDesign>> ResponseCollector::add(SimulateResult part) {
  const std::string request_id = part.request_id;
  const int chunks = part.chunks;
  auto& parts = parts_[request_id];
  parts.insert_or_assign(part.chunk, std::move(part));
  if (static_cast<int>(parts.size()) < chunks) return std::nullopt;
  std::vector<SimulatedDesign> whole;
  for (auto& [chunk, piece] : parts) std::ranges::move(piece.results, std::back_inserter(whole));
  parts_.erase(request_id);
  return whole;
}

}  // namespace nacre::wire
