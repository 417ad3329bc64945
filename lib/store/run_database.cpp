#include "store/run_database.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <set>
#include <string>
#include <vector>

#include "base/names.hpp"
#include "base/no_space.hpp"
#include "base/result.hpp"
#include "store/database_care.hpp"
#include "store/run_schema.hpp"
#include "wire/convert.hpp"

namespace nacre::store {
namespace {

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

/// Binds values in order and runs the statement.
template <class... Values>
void run(SQLite::Database& database, const char* sql, const Values&... values) {
  SQLite::Statement statement(database, sql);
  int index = 0;
  const auto bind = [&](const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    ++index;
    if constexpr (std::is_same_v<Value, std::optional<double>>) {
      value ? statement.bind(index, *value) : statement.bind(index);
    } else if constexpr (std::is_same_v<Value, bool>) {
      statement.bind(index, value ? 1 : 0);
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      statement.bind(index, value.empty() ? "" : static_cast<const void*>(value.data()),
                     static_cast<int>(value.size() * sizeof(double)));
    } else if constexpr (std::is_same_v<Value, std::vector<std::int32_t>>) {
      statement.bind(index, value.empty() ? "" : static_cast<const void*>(value.data()),
                     static_cast<int>(value.size() * sizeof(std::int32_t)));
    } else if constexpr (std::is_same_v<Value, std::string_view>) {
      statement.bind(index, std::string(value));
    } else {
      statement.bind(index, value);
    }
  };
  (bind(values), ...);
  statement.exec();
}

std::vector<double> packed(const tester::Curve& curve) {
  std::vector<double> pairs;
  for (std::size_t i = 0; i < curve.size(); ++i) pairs.insert(pairs.end(), {curve.strain[i], curve.stress_pa[i]});
  return pairs;
}

/// A game with a family stage closes its last round twice: the second ROUND counts, whatever comes after it.
bool is_closed_for_good(SQLite::Database& db, int round) {
  SQLite::Statement query(db, "SELECT last FROM round WHERE round = ?");
  query.bind(1, round);
  return query.executeStep() && query.getColumn(0).getInt() != 0;
}

void keep(SQLite::Database& db, const wire::RoundSummary& r) {
  if (!r.last && is_closed_for_good(db, r.round)) return;
  run(db, "INSERT OR REPLACE INTO round VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?)", r.round, tester::to_string(r.fidelity),
      r.calibration_count, r.measured_hypervolume_staircase, r.measured_hypervolume_polygon,
      r.gamut_hypervolume_staircase, r.gamut_hypervolume_polygon, r.gap, r.signed_gap, r.hypervolume_error,
      r.equilibrium, r.last, r.decided_by);
  const auto errors = [&](std::string_view moment, const sysid::PredictionErrors& e) {
    run(db, "INSERT OR REPLACE INTO prediction_error VALUES (?,?,?,?,?,?,?,?,?)", r.round, moment, e.modulus_count,
        e.modulus_mean, e.modulus_max, e.toughness_count, e.toughness_mean, e.toughness_max, e.toughness_spearman);
  };
  errors("before", r.before);
  errors("after", r.after);
  errors("held_out", r.held_out);
}

/// Calls `keep_one` with name and value of every parameter.
template <class KeepOne>
void each_parameter(const material::ParameterSet& parameters, const KeepOne& keep_one) {
  const auto theta = to_vector(parameters.modulus);
  for (std::size_t i = 0; i < theta.size(); ++i)
    keep_one("modulus." + std::string(material::modulus_parameter_names()[i]), theta[i]);
  const auto eta = to_vector(parameters.toughness);
  for (std::size_t i = 0; i < eta.size(); ++i)
    keep_one("toughness." + std::string(material::toughness_parameter_names()[i]), eta[i]);
  for (const auto& [name, values] : parameters.extensions) {
    for (std::size_t i = 0; i < values.size(); ++i)
      keep_one(fmt::format("extension.{}{}", name, values.size() > 1 ? fmt::format(".{}", i) : ""), values[i]);
  }
}

void keep(SQLite::Database& db, const wire::AdoptedModel& m) {
  each_parameter(m.parameters, [&](const std::string& name, double value) {
    run(db, "INSERT OR REPLACE INTO parameter VALUES (?,?,?)", m.round, name, value);
  });
  for (std::size_t i = 0; i < m.benchmark.size(); ++i) {
    run(db, "INSERT OR REPLACE INTO benchmark VALUES (?,?,?,?)", m.round, static_cast<int>(i),
        m.benchmark[i].modulus_pa, m.benchmark[i].toughness_pa);
  }
  const auto keep_fit = [&](std::string_view property, const sysid::GoodnessOfFit& fit) {
    run(db, "INSERT OR REPLACE INTO goodness_of_fit VALUES (?,?,?,?,?,?,?)", m.round, property, fit.count, fit.freedom,
        fit.chi_squared, fit.chi_squared_replicates, fit.p_value);
  };
  keep_fit("E", m.provenance.modulus_fit);
  keep_fit("T", m.provenance.toughness_fit);
}

void keep(SQLite::Database& db, const wire::GamutChunk& g) {
  for (const explore::Evaluated& sample : g.samples) {
    run(db, "INSERT OR REPLACE INTO gamut VALUES (?,?,?,?)", g.round, sample.pattern.key(),
        sample.performance.modulus_pa, sample.performance.toughness_pa);
  }
}

void keep(SQLite::Database& db, const wire::Proposal& p) {
  for (std::size_t i = 0; i < p.designs.size(); ++i) {
    const wire::ProposedDesign& d = p.designs[i];
    run(db, "INSERT OR REPLACE INTO proposal VALUES (?,?,?,?,?,?,?)", p.round, d.design.name(), static_cast<int>(i),
        d.modulus_pa, d.toughness_pa, d.bin, d.reason);
  }
}

void keep(SQLite::Database& db, const wire::Measurement& m) {
  const measurement::SpecimenRecord& r = m.record;
  // The first report of a specimen counts: a different one with the same name is refused by the validation agent, too.
  run(db, "INSERT OR IGNORE INTO measurement VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)", r.specimen, m.round, m.order_id,
      r.design.name(), tester::to_string(r.test), r.conditions.orientation_deg, r.conditions.strain_rate_per_s,
      r.conditions.thickness_mm, r.batch, r.print_order, r.modulus_pa, r.toughness_pa, r.valid, r.note,
      packed(r.curve));
}

void keep(SQLite::Database& db, const wire::Review& r) {
  // Of two with one revision "not valid" stands, whichever came first.
  run(db,
      "INSERT INTO review VALUES (?1,?2,?3,?4,?5) ON CONFLICT (specimen, revision) DO UPDATE SET "
      "valid = ?3, who = ?4, why = ?5 WHERE ?3 < valid",
      r.specimen, r.revision, r.valid != 0, r.by, r.why);
}

void keep(SQLite::Database& db, const wire::Diagnosis& d) {
  const auto when_gained = [&](double wire::DiagnosedGain::*value) {
    return d.gain ? std::optional<double>(*d.gain.*value) : std::nullopt;
  };
  run(db, "INSERT OR REPLACE INTO diagnosis VALUES (?,?,?,?,?,?)", d.round, d.verdict, d.summary,
      when_gained(&wire::DiagnosedGain::held_out_error_before), when_gained(&wire::DiagnosedGain::held_out_error_after),
      when_gained(&wire::DiagnosedGain::relative_reduction));
  std::set<std::string> named;
  for (const wire::DiagnosedEffect& e : d.effects) {
    if (!named.insert(e.name).second) continue;  // a further parameter of the effect
    run(db, "INSERT OR REPLACE INTO diagnosis_effect VALUES (?,?,?,?,?,?)", d.round, e.name, e.parameter,
        e.interval_low, e.interval_high, e.unit);
  }
  for (const wire::DiagnosedCandidate& c : d.candidates) {
    run(db, "INSERT OR REPLACE INTO diagnosis_candidate VALUES (?,?,?,?,?,?)", d.round, c.name, c.status, c.statistic,
        c.p_family_wise, c.absorption);
  }
}

/// Responses to the analyser's own request `analyser/rN/measured`: what the model of round N predicts for the measured
/// designs.
void keep(SQLite::Database& db, const wire::SimulateResult& s) {
  const auto round = number_between("analyser/r", "/measured", s.request_id);
  if (!round) return;
  for (const wire::SimulatedDesign& d : s.results) {
    run(db, "INSERT OR REPLACE INTO simulated VALUES (?,?,?,?,?,?)", *round, d.design.name(), d.modulus_pa,
        d.toughness_pa, d.failure, packed(d.curve));
  }
}

void keep_crack(SQLite::Database& db, const char* table, int number, const wire::Fracture& f) {
  const auto of_path = [&](auto value) {
    return f.crack.path ? std::optional<double>(value(*f.crack.path)) : std::nullopt;
  };
  std::vector<std::int32_t> path, breaks;
  if (f.crack.path) path.assign(f.crack.path->elements.begin(), f.crack.path->elements.end());
  for (const tester::Break& broken : f.crack.order) breaks.push_back(broken.element);
  const std::string insert = fmt::format("INSERT OR REPLACE INTO {} VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)", table);
  run(db, insert.c_str(), number, f.design.name(), f.film, f.crack.columns, f.crack.rows, f.broken, f.crack.branches,
      f.crack.separate_cracks, of_path([](const auto& p) { return p.length_m; }),
      of_path([](const auto& p) { return p.straight_length_m; }),
      of_path([](const auto& p) { return p.bridged_share; }), of_path([](const auto& p) { return p.material[0]; }),
      of_path([](const auto& p) { return p.material[1]; }), of_path([](const auto& p) { return p.material[2]; }),
      f.crack.path && f.crack.path->crosses, path, breaks);
}

/// Responses to the analyser's own requests: how the designs proposed in round N break, and those of family N.
void keep(SQLite::Database& db, const wire::Fracture& f) {
  if (const auto round = number_between("analyser/r", "/films", f.request_id)) keep_crack(db, "crack", *round, f);
  if (const auto family = number_between("analyser/family", "/films", f.request_id))
    keep_crack(db, "family_crack", *family, f);
}

/// A family that is validated is not put back by an older FAMILY.
void keep(SQLite::Database& db, const wire::CalibratedFamily& f) {
  SQLite::Statement known(db, "SELECT is_validated FROM family WHERE number = ?");
  known.bind(1, f.number);
  if (known.executeStep() && known.getColumn(0).getInt() != 0 && !f.is_validated) return;
  run(db, "INSERT OR REPLACE INTO family VALUES (?,?,?,?,?,?,?,?)", f.number, f.name, f.round,
      tester::to_string(f.fidelity), f.count, f.is_validated, f.simulations, f.samples);
  each_parameter(f.parameters, [&](const std::string& name, double value) {
    run(db, "INSERT OR REPLACE INTO family_parameter VALUES (?,?,?)", f.number, name, value);
  });
  for (std::size_t i = 0; i < f.designs.size(); ++i) {
    const game::FamilyDesign& d = f.designs[i];
    run(db, "INSERT OR REPLACE INTO family_design VALUES (?,?,?,?,?,?,?,?,?,?)", f.number, d.pattern.key(),
        static_cast<int>(i), d.is_seed, d.measured.modulus_pa, d.measured.toughness_pa, d.global_model.modulus_pa,
        d.global_model.toughness_pa, d.family_model.modulus_pa, d.family_model.toughness_pa);
  }
}

void keep(SQLite::Database& db, const wire::FamilyGamut& g) {
  for (const explore::Evaluated& sample : g.samples) {
    run(db, "INSERT OR REPLACE INTO family_gamut VALUES (?,?,?,?)", g.number, sample.pattern.key(),
        sample.performance.modulus_pa, sample.performance.toughness_pa);
  }
}

template <class Domain>
void keep_domain(SQLite::Database& db, const std::string& payload) {
  if (const auto value = wire::read<Domain>(payload)) keep(db, *value);
}

void keep_payload(SQLite::Database& db, const std::string& channel, const std::string& payload) {
  if (channel == "ROUND") keep_domain<wire::RoundSummary>(db, payload);
  if (channel == "PARAMETERS") keep_domain<wire::AdoptedModel>(db, payload);
  if (channel == "GAMUT") keep_domain<wire::GamutChunk>(db, payload);
  if (channel == "PROPOSAL") keep_domain<wire::Proposal>(db, payload);
  if (channel == "MEASUREMENT") keep_domain<wire::Measurement>(db, payload);
  if (channel == "SIMULATED") keep_domain<wire::SimulateResult>(db, payload);
  if (channel == "FRACTURE") keep_domain<wire::Fracture>(db, payload);
  if (channel == "FAMILY") keep_domain<wire::CalibratedFamily>(db, payload);
  if (channel == "FAMILY_GAMUT") keep_domain<wire::FamilyGamut>(db, payload);
  if (channel == "REVIEW") keep_domain<wire::Review>(db, payload);
  if (channel == "DIAGNOSIS") keep_domain<wire::Diagnosis>(db, payload);
}

}  // namespace

RunDatabase::RunDatabase(const std::filesystem::path& path) : path_(path) {
  try {
    database_ = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, 30'000);
    distrust(*database_);
    database_->exec("PRAGMA journal_mode = WAL");
    const int version = database_->execAndGet("PRAGMA user_version").getInt();
    if (version == 0) {
      SQLite::Transaction transaction(*database_);
      database_->exec(kRunSchema);
      database_->exec(fmt::format(kCrackSchema, "crack", "round"));
      database_->exec("PRAGMA user_version = " + std::to_string(kRunSchemaVersion));
      transaction.commit();
    } else if (version != kRunSchemaVersion) {
      refuse(path_, fmt::format("it has schema version {}, this program writes {}", version, kRunSchemaVersion));
    }
    database_->exec(kFitSchema);
    database_->exec(kFamilySchema);
    database_->exec(fmt::format(kCrackSchema, "family_crack", "number"));
  } catch (const SQLite::Exception& error) {
    refuse(path_, error);
  }
}

RunDatabase::~RunDatabase() = default;

void RunDatabase::project(const std::string& channel, const std::string& payload) {
  const std::lock_guard lock(mutex_);
  try {
    SQLite::Transaction transaction(*database_);
    keep_payload(*database_, channel, payload);
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

}  // namespace nacre::store
