#pragma once
// A run, finished or growing, read: everybody but the analyser reads run.db through this class.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "run/recording.hpp"
#include "run/run_record.hpp"

namespace SQLite {
class Database;
}

namespace nacre::run {

/// Reads what has been added since the last call. Calls may come from any thread; all throw InputError where run.db
/// cannot be read.
class Run {
 public:
  /// `database`: the name of run.db in the folder.
  explicit Run(const std::filesystem::path& folder, const std::string& database = "run.db");
  ~Run();

  /// Changes with every write of the analyser.
  std::string version();
  /// Without gamuts; empty before the analyser's first write.
  std::shared_ptr<const RunRecord> record();
  /// With the gamuts of families and rounds (`rounds`: of these alone), which are most of a large run.
  RunRecord record_with_gamuts(const std::optional<std::set<int>>& rounds = std::nullopt);
  /// By round; no pattern where the round has none. 100,000 patterns take about 20 ms once, and are kept.
  std::shared_ptr<const Gamut> gamut(int round);
  /// The variants of a family by its number.
  std::shared_ptr<const Gamut> variants(int family);
  /// Payloads on a channel in the order of arrival; `round`: those of one round (message_place.hpp).
  std::vector<std::string> payloads(const std::string& channel, std::optional<int> round = std::nullopt);

 private:
  using Ids = std::vector<std::int64_t>;
  struct Kept {
    Ids ids;
    std::shared_ptr<const Gamut> gamut;
  };
  void refresh();
  std::string version_now();
  void read_new_messages();
  template <class Chunk>
  std::shared_ptr<const Gamut> kept_gamut(std::map<int, Kept>& kept, int number, const Ids& ids);

  std::filesystem::path database_;
  bool is_diagnosed_ = true;
  std::mutex mutex_;
  std::unique_ptr<SQLite::Database> watching_;  ///< tells whether somebody has written
  std::uint64_t watched_ = 0;                   ///< inode of its file
  int watches_ = 0;                             ///< how often it was opened
  std::string read_version_;
  std::uint64_t file_ = 0;    ///< inode: a database made anew is another
  std::int64_t last_id_ = 0;  ///< of the messages read
  Recording recording_;
  std::shared_ptr<const RunRecord> record_ = std::make_shared<const RunRecord>();
  std::map<int, Kept> gamuts_, variants_;
};

}  // namespace nacre::run
