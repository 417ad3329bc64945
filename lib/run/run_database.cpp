#include "run/run_database.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <optional>
#include <span>

#include "base/no_space.hpp"
#include "base/result.hpp"
#include "measurement/conditions.hpp"
#include "measurement/specimen_checks.hpp"
#include "run/message_place.hpp"
#include "run/run_schema.hpp"
#include "store/database_care.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"
#include "wire/lcm_types.hpp"
#include "wire/schema.hpp"

namespace nacre::run {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw InputError::format(
      "{} cannot be used: {}. It is made from the analyser's journal: `nacre rebuild` makes it anew", path.string(),
      reason);
}

/// SQLite calls it an I/O error where the -shm file beside the database finds no room.
[[noreturn]] void refuse(const std::filesystem::path& path, const SQLite::Exception& error) {
  constexpr int kPrimary = 0xff;  // of a code that may be extended
  const int code = error.getErrorCode() & kPrimary;
  if (code != SQLITE_FULL && code != SQLITE_IOERR) refuse(path, std::string(error.what()));
  throw NoSpace(fmt::format("{} cannot be written: {}. Make room on its disk; the analyser's journal holds all of it",
                            path.string(), error.what()));
}

/// The message without columns of numbers (arrays whose length it says), which only programs read.
Json without_columns(const Json& message, const wire::Struct& type) {
  Json kept = Json::object();
  for (const wire::Member& member : type.members) {
    const Json& value = message.at(member.name);
    const bool is_number = member.structure == nullptr && member.primitive != wire::Primitive::text;
    if (is_number && member.count_member >= 0) continue;
    Json& part = kept[member.name];
    if (member.structure == nullptr) {
      part = value;
    } else if (member.is_array()) {
      part = Json::array();
      for (const Json& each : value) part.push_back(without_columns(each, *member.structure));
    } else {
      part = without_columns(value, *member.structure);
    }
  }
  return kept;
}

std::string content_of(const wire::Channel& channel, const std::string& payload) {
  auto message = wire::to_json(channel.type, payload);
  if (!message) return "{}";
  Json content = without_columns(*message, wire::message_types().find(channel.type)->second);
  content.erase("header");
  return content.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// What is read from a specimen's record beside its fields.
std::string reading_of(const wire::Measurement& measured, int measured_in) {
  const measurement::SpecimenRecord& r = measured.record;
  const bool is_toughness = r.test == tester::TestKind::toughness;
  return Json({{"measured_in", measured_in},
               {"design", r.design.name()},
               {"test", tester::to_string(r.test)},
               {"modulus_pa", or_null(measurement::modulus_of(r))},
               {"toughness_pa", or_null(is_toughness ? measurement::toughness_of(r) : r.toughness_pa)},
               {"standard", measurement::is_standard(r.conditions)},
               {"usable", !measurement::why_unusable(r)}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The rounds that are closed, by the messages kept so far.
ClosedRounds closed_rounds(SQLite::Database& db) {
  ClosedRounds closed;
  SQLite::Statement query(db, "SELECT round, content->>'last' FROM messages WHERE channel = 'ROUND'");
  while (query.executeStep()) closed.close(query.getColumn(0).getInt(), query.getColumn(1).getInt() != 0);
  return closed;
}

void keep_samples(SQLite::Database& db, std::int64_t message, std::span<const explore::Evaluated> samples) {
  SQLite::Statement insert(db, "INSERT INTO samples VALUES (?,?,?,?,?)");
  int place = 0;
  for (const explore::Evaluated& sample : samples) {
    insert.bind(1, message);
    insert.bind(2, ++place);
    insert.bind(3, static_cast<std::int64_t>(sample.pattern.bits()));
    insert.bind(4, sample.performance.modulus_pa);
    insert.bind(5, sample.performance.toughness_pa);
    insert.exec();
    insert.reset();
  }
}

void keep_message(SQLite::Database& db, const wire::Channel& channel, const std::string& payload) {
  SQLite::Statement insert(
      db, "INSERT OR IGNORE INTO messages (channel, round, hash, payload, content, reading) VALUES (?,?,?,?,?,?)");
  insert.bind(1, std::string(channel.name));
  if (const auto round = round_of(channel.name, payload)) insert.bind(2, *round);
  insert.bind(3, wire::message_hash(channel.name, payload));
  insert.bind(4, payload.data(), static_cast<int>(payload.size()));
  insert.bind(5, content_of(channel, payload));
  if (channel.name == "MEASUREMENT") {
    const auto measured = wire::read<wire::Measurement>(payload);
    insert.bind(6, reading_of(*measured, measured_in(*measured, closed_rounds(db))));
  }
  if (insert.exec() == 0) return;  // it is there
  const std::int64_t id = db.getLastInsertRowid();
  if (channel.name == "GAMUT") keep_samples(db, id, wire::read<wire::GamutChunk>(payload)->samples);
  if (channel.name == "FAMILY_GAMUT") keep_samples(db, id, wire::read<wire::FamilyGamut>(payload)->samples);
}

void make_schema(SQLite::Database& db) {
  SQLite::Transaction transaction(db);
  db.exec(kRunTables);
  for (const char* view : {kRoundsView, kSpecimensView, kDesignsView, kGamutView, kFrontsView, kEffectsView})
    db.exec(view);
  db.exec("PRAGMA user_version = " + std::to_string(kRunSchemaVersion));
  transaction.commit();
}

}  // namespace

RunDatabase::RunDatabase(const std::filesystem::path& path) : path_(path) {
  try {
    database_ = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, 30'000);
    store::distrust(*database_);
    database_->exec("PRAGMA page_size = 16384");  // of a new file: a message of 2 kB would fill half a page of 4 kB
    database_->exec("PRAGMA journal_mode = WAL");
    const int version = database_->execAndGet("PRAGMA user_version").getInt();
    if (version == 0) {
      make_schema(*database_);
    } else if (version != kRunSchemaVersion) {
      refuse(path_, fmt::format("it has schema version {}, this program writes {}", version, kRunSchemaVersion));
    }
  } catch (const SQLite::Exception& error) {
    refuse(path_, error);
  }
}

RunDatabase::~RunDatabase() = default;

void RunDatabase::keep(const std::string& channel, const std::string& payload) {
  const wire::Channel* known = wire::find_channel(channel);
  if (known == nullptr || !known->validate(payload)) return;
  const std::lock_guard lock(mutex_);
  try {
    SQLite::Transaction transaction(*database_);
    keep_message(*database_, *known, payload);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    refuse(path_, error);
  }
}

void RunDatabase::checkpoint() {
  const std::lock_guard lock(mutex_);
  try {
    database_->exec("PRAGMA wal_checkpoint(TRUNCATE)");
  } catch (const SQLite::Exception& error) {
    refuse(path_, error);
  }
}

}  // namespace nacre::run
