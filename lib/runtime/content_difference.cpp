#include "runtime/content_difference.hpp"

#include <algorithm>

#include "runtime/journal.hpp"
#include "wire/channels.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::runtime {

std::string content_difference(std::string_view recorded, std::string_view now) {
  for (const wire::Channel& channel : wire::channels()) {
    if (wire::fingerprint_of(recorded) != channel.fingerprint || wire::fingerprint_of(now) != channel.fingerprint)
      continue;
    if (const auto difference = wire::first_difference(channel.type, recorded, now)) return *difference;
  }
  const auto a = unpack(recorded), b = unpack(now);
  if (a && b && a->size() == b->size()) {
    const auto [in_a, in_b] = std::mismatch(a->begin(), a->end(), b->begin());
    if (in_a != a->end()) return fmt::format("field {}: {}", in_a - a->begin(), content_difference(*in_a, *in_b));
  }
  const auto first = std::mismatch(recorded.begin(), recorded.end(), now.begin(), now.end()).first;
  return fmt::format("from byte {} on ({} bytes recorded, {} now)", first - recorded.begin(), recorded.size(),
                     now.size());
}

}  // namespace nacre::runtime
