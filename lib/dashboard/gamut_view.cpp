#include "dashboard/gamut_view.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include <nlohmann/json.hpp>

#include "optimize/best_by_rank.hpp"

namespace nacre::dashboard {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers are written as they lie in memory");

template <class Number>
void append(std::string& bytes, const Number& number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

}  // namespace

std::string gamut_bytes(const run::Gamut& gamut, int round) {
  const auto ranks = optimize::non_dominated_ranks(gamut.performances);
  nlohmann::ordered_json header = {
      {"round", round}, {"count", gamut.patterns.size()}, {"front", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < ranks.size(); ++i)
    if (ranks[i] == 1) header["front"].push_back(i);
  std::string text = header.dump();
  text.resize((text.size() + 7) / 8 * 8, ' ');  // the columns begin where a browser may look at them in place
  std::string bytes = "NACREGMT";
  bytes.reserve(16 + text.size() + 16 * gamut.patterns.size());
  append(bytes, std::uint32_t{1});
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
  for (const std::uint64_t pattern : gamut.patterns) append(bytes, pattern);
  for (const auto& each : gamut.performances) append(bytes, static_cast<float>(each.modulus_pa));
  for (const auto& each : gamut.performances) append(bytes, static_cast<float>(each.toughness_pa));
  return bytes;
}

std::vector<std::size_t> best_of(const run::Gamut& gamut, std::size_t most) {
  std::vector<std::size_t> order = optimize::best_by_rank(gamut.performances, most);
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace nacre::dashboard
