#pragma once
// What a node has heard and said, from its journal.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace nacre::run {

/// Functions that take a payload (with blank header), by channel.
using Takers = std::map<std::string, std::function<void(const std::string& payload)>, std::less<>>;

/// A journal that may be growing: each reading goes on where the last one ended.
class JournalMessages {
 public:
  JournalMessages(const std::filesystem::path& run_folder, const std::string& node);
  /// Hands out what the node has received and sent on these channels since the last call, oldest first; nothing before
  /// its first message and on machines that do not hold the run's folder. Throws InputError when it is damaged.
  void read(const Takers& received, const Takers& sent);
  /// Whether the next reading begins anew: the journal was cut or is another.
  bool begins_anew() const;

 private:
  std::filesystem::path journal_;
  std::uint64_t file_ = 0;  ///< inode
  std::int64_t read_ = 0;   ///< bytes
};

/// All that a node has received, or sent, on a channel.
std::vector<std::string> received_by(const std::filesystem::path& run_folder, const std::string& node,
                                     const std::string& channel);
std::vector<std::string> sent_by(const std::filesystem::path& run_folder, const std::string& node,
                                 const std::string& channel);

}  // namespace nacre::run
