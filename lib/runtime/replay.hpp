#pragma once
// Feeds a recorded game to one core and compares what it sends.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "runtime/node_core.hpp"

namespace nacre::runtime {

struct ReplayReport {
  bool equal = false;  ///< every output byte for byte, and every recomputed result
  std::int64_t inputs = 0;
  std::int64_t outputs = 0;     ///< messages compared
  std::int64_t computes = 0;    ///< requests for long work compared
  std::int64_t recomputed = 0;  ///< results done again and compared
  std::int64_t unfinished =
      0;  ///< outputs that the last input causes and the journal does not hold: the node was stopped there
  std::string difference;  ///< the first one: record, channel, field; empty when equal
  std::string note;        ///< what limits the comparison (bus logs: best effort)
};

/// Feeds the inputs of a journal to a fresh core and compares outputs byte for byte. With `recompute`, the long work is
/// done again by `work` and its results are compared too. Throws InputError when the journal cannot be read.
ReplayReport replay_journal(const std::filesystem::path& journal, NodeCore& core,
                            const std::map<std::string, WorkFunction>& work = {}, bool recompute = false);

/// Best effort from the log of the bus: what `node` would have received is fed in the order of the log (each content
/// once), its long work is done by `work`, and the set of messages it sends is compared with the set it sent then.
ReplayReport replay_bus_log(const std::filesystem::path& log, const std::string& node, NodeCore& core,
                            const std::map<std::string, WorkFunction>& work);

}  // namespace nacre::runtime
