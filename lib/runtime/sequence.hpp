#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>

#include <fmt/format.h>

#include "wire/header.hpp"

namespace nacre::runtime {

/// Counts gaps in the sequence numbers of every publisher's process and channel. What was said before we listened is no
/// loss; a repeated datagram may hide a gap, so the count is a lower bound.
class SequenceCounter {
 public:
  void count(const std::string& channel, const wire::Header& header) {
    Sequence& sequence = sequences_[fmt::format("{}/{}/{}", header.node, header.epoch, channel)];
    if (sequence.arrived == 0) sequence.first = sequence.highest = header.seq;
    lost_ -= sequence.missing();
    ++sequence.arrived;
    sequence.first = std::min(sequence.first, header.seq);
    sequence.highest = std::max(sequence.highest, header.seq);
    lost_ += sequence.missing();
  }
  std::int64_t lost() const { return lost_; }

 private:
  struct Sequence {
    std::int64_t first = 0, highest = 0, arrived = 0;
    std::int64_t missing() const { return arrived == 0 ? 0 : std::max<std::int64_t>(0, highest - first + 1 - arrived); }
  };
  std::map<std::string, Sequence> sequences_;
  std::int64_t lost_ = 0;
};

}  // namespace nacre::runtime
