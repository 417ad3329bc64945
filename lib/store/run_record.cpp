#include "store/run_record.hpp"

#include <SQLiteCpp/SQLiteCpp.h>

#include <charconv>
#include <cstring>

#include "base/result.hpp"
#include "measurement/specimen_checks.hpp"
#include "pattern/pattern_key.hpp"
#include "store/database_care.hpp"

namespace nacre::store {
namespace {

std::optional<double> optional_double(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional<double>(column.getDouble());
}

tester::Curve unpacked(const SQLite::Column& column) {
  std::vector<double> pairs(static_cast<std::size_t>(column.getBytes()) / sizeof(double));
  if (!pairs.empty()) std::memcpy(pairs.data(), column.getBlob(), pairs.size() * sizeof(double));
  tester::Curve curve;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    curve.strain.push_back(pairs[i]);
    curve.stress_pa.push_back(pairs[i + 1]);
  }
  return curve;
}

/// Calls `use` for every row of a query.
template <class Use>
void each_row(SQLite::Database& db, const char* sql, const Use& use) {
  SQLite::Statement query(db, sql);
  while (query.executeStep()) use(query);
}

sysid::PredictionErrors errors_of(SQLite::Statement& q) {
  return {q.getColumn(2).getInt(),    q.getColumn(3).getDouble(), q.getColumn(4).getDouble(), q.getColumn(5).getInt(),
          q.getColumn(6).getDouble(), q.getColumn(7).getDouble(), q.getColumn(8).getDouble()};
}

void read_summaries(SQLite::Database& db, RunRecord& run) {
  each_row(db, "SELECT * FROM round", [&](SQLite::Statement& q) {
    wire::RoundSummary r;
    r.round = q.getColumn(0).getInt();
    r.fidelity = tester::fidelity_from_string(q.getColumn(1).getString()).value_or(tester::Fidelity::tiny);
    r.calibration_count = q.getColumn(2).getInt();
    r.measured_hypervolume_staircase = q.getColumn(3).getDouble();
    r.measured_hypervolume_polygon = q.getColumn(4).getDouble();
    r.gamut_hypervolume_staircase = q.getColumn(5).getDouble();
    r.gamut_hypervolume_polygon = q.getColumn(6).getDouble();
    r.gap = q.getColumn(7).getDouble();
    r.signed_gap = q.getColumn(8).getDouble();
    r.hypervolume_error = q.getColumn(9).getDouble();
    r.equilibrium = q.getColumn(10).getInt() != 0;
    r.last = q.getColumn(11).getInt() != 0;
    r.decided_by = q.getColumn(12).getString();
    run.rounds[r.round].summary = r;
  });
  each_row(db, "SELECT * FROM prediction_error", [&](SQLite::Statement& q) {
    const auto found = run.rounds.find(q.getColumn(0).getInt());
    if (found == run.rounds.end() || !found->second.summary) return;
    const std::string moment = q.getColumn(1).getString();
    wire::RoundSummary& r = *found->second.summary;
    (moment == "before" ? r.before : moment == "after" ? r.after : r.held_out) = errors_of(q);
  });
}

void read_gamuts(SQLite::Database& db, RunRecord& run) {
  each_row(db, "SELECT round, modulus_pa, toughness_pa FROM gamut ORDER BY round, pattern", [&](SQLite::Statement& q) {
    run.rounds[q.getColumn(0).getInt()].gamut.push_back({q.getColumn(1).getDouble(), q.getColumn(2).getDouble()});
  });
}

void read_model(SQLite::Database& db, RunRecord& run) {
  each_row(db, "SELECT round, name, value FROM parameter", [&](SQLite::Statement& q) {
    run.rounds[q.getColumn(0).getInt()].parameters[q.getColumn(1).getString()] = q.getColumn(2).getDouble();
  });
  each_row(db, "SELECT round, modulus_pa, toughness_pa FROM benchmark ORDER BY round, position",
           [&](SQLite::Statement& q) {
             run.rounds[q.getColumn(0).getInt()].benchmark.push_back(
                 {q.getColumn(1).getDouble(), q.getColumn(2).getDouble()});
           });
  each_row(db, "SELECT round, design, reason, modulus_pa, toughness_pa FROM proposal ORDER BY round, position",
           [&](SQLite::Statement& q) {
             run.rounds[q.getColumn(0).getInt()].proposals.push_back(
                 {q.getColumn(1).getString(),
                  q.getColumn(2).getString(),
                  {q.getColumn(3).getDouble(), q.getColumn(4).getDouble()}});
           });
  each_row(db, "SELECT round, design, modulus_pa, toughness_pa, failure, curve FROM simulated",
           [&](SQLite::Statement& q) {
             run.rounds[q.getColumn(0).getInt()].simulated[q.getColumn(1).getString()] = {
                 {q.getColumn(2).getDouble(), q.getColumn(3).getDouble()},
                 q.getColumn(4).getString(),
                 unpacked(q.getColumn(5))};
           });
}

void read_fits(SQLite::Database& db, RunRecord& run) {
  if (!db.tableExists("goodness_of_fit")) return;  // a run of an earlier version
  each_row(
      db, "SELECT round, property, designs, freedom, chi_squared, chi_squared_replicates, p_value FROM goodness_of_fit",
      [&](SQLite::Statement& q) {
        RoundRecord& round = run.rounds[q.getColumn(0).getInt()];
        sysid::GoodnessOfFit& fit = q.getColumn(1).getString() == "E" ? round.modulus_fit : round.toughness_fit;
        fit = {.count = q.getColumn(2).getInt(),
               .freedom = q.getColumn(3).getInt(),
               .chi_squared = q.getColumn(4).getDouble(),
               .chi_squared_replicates = q.getColumn(5).getDouble(),
               .p_value = q.getColumn(6).getDouble()};
      });
}

std::vector<std::int32_t> elements(const SQLite::Column& blob) {
  std::vector<std::int32_t> result(static_cast<std::size_t>(blob.getBytes()) / sizeof(std::int32_t));
  if (!result.empty()) std::memcpy(result.data(), blob.getBlob(), result.size() * sizeof(std::int32_t));
  return result;
}

/// Calls `keep` with round or number of the family, design, and how it breaks.
template <class Keep>
void each_crack(SQLite::Database& db, const char* table, const char* number, const Keep& keep) {
  const std::string cracks = fmt::format(
      "SELECT {}, design, film, columns, rows, broken, branches, separate_cracks, path, breaks, path_length_m, "
      "straight_length_m, bridged_share, "
      "soft_share, rigid_share, interface_share, crosses FROM {}",
      number, table);
  each_row(db, cracks.c_str(), [&](SQLite::Statement& q) {
    RecordedCrack recorded{.crack = {}, .broken = q.getColumn(5).getInt(), .film = q.getColumn(2).getString()};
    crack::CrackRecord& record = recorded.crack;
    record.columns = q.getColumn(3).getInt();
    record.rows = q.getColumn(4).getInt();
    record.branches = q.getColumn(6).getInt();
    record.separate_cracks = q.getColumn(7).getInt();
    for (const std::int32_t element : elements(q.getColumn(9))) record.order.push_back({element, 0.0});
    if (!q.getColumn(10).isNull()) {
      const std::vector<std::int32_t> path = elements(q.getColumn(8));
      record.path = crack::CrackPath{
          .elements = {path.begin(), path.end()},
          .length_m = q.getColumn(10).getDouble(),
          .straight_length_m = q.getColumn(11).getDouble(),
          .bridged_share = q.getColumn(12).getDouble(),
          .material = {q.getColumn(13).getDouble(), q.getColumn(14).getDouble(), q.getColumn(15).getDouble()},
          .crosses = q.getColumn(16).getInt() != 0};
    }
    keep(q.getColumn(0).getInt(), q.getColumn(1).getString(), std::move(recorded));
  });
}

void read_cracks(SQLite::Database& db, RunRecord& run) {
  each_crack(db, "crack", "round", [&](int round, const std::string& design, RecordedCrack crack) {
    run.rounds[round].cracks[design] = std::move(crack);
  });
}

void read_diagnoses(SQLite::Database& db, RunRecord& run) {
  each_row(db, "SELECT round, verdict, summary, held_out_error_before, held_out_error_after FROM diagnosis",
           [&](SQLite::Statement& q) {
             RecordedDiagnosis diagnosis;
             diagnosis.verdict = q.getColumn(1).getString();
             diagnosis.summary = q.getColumn(2).getString();
             diagnosis.held_out_error_before = optional_double(q.getColumn(3));
             diagnosis.held_out_error_after = optional_double(q.getColumn(4));
             run.rounds[q.getColumn(0).getInt()].diagnosis = diagnosis;
           });
  each_row(db, "SELECT round, name, unit, parameter, interval_low, interval_high FROM diagnosis_effect",
           [&](SQLite::Statement& q) {
             if (auto& diagnosis = run.rounds[q.getColumn(0).getInt()].diagnosis) {
               diagnosis->effects.push_back({q.getColumn(1).getString(), q.getColumn(2).getString(),
                                             q.getColumn(3).getDouble(), q.getColumn(4).getDouble(),
                                             q.getColumn(5).getDouble()});
             }
           });
  each_row(db, "SELECT round, name, status, statistic, p_family_wise, absorption FROM diagnosis_candidate",
           [&](SQLite::Statement& q) {
             if (auto& diagnosis = run.rounds[q.getColumn(0).getInt()].diagnosis) {
               diagnosis->candidates.push_back({q.getColumn(1).getString(), q.getColumn(2).getString(),
                                                q.getColumn(3).getDouble(), q.getColumn(4).getDouble(),
                                                q.getColumn(5).getDouble()});
             }
           });
}

game::FamilyDesign family_design(SQLite::Statement& q) {
  const auto values = [&](int first) {
    return game::DesignValues{optional_double(q.getColumn(first)), optional_double(q.getColumn(first + 1))};
  };
  return {.pattern = pattern::pattern_from_key(q.getColumn(1).getString()).value_or(pattern::Pattern()),
          .is_seed = q.getColumn(2).getInt() != 0,
          .measured = values(3),
          .global_model = values(5),
          .family_model = values(7)};
}

void read_families(SQLite::Database& db, RunRecord& run) {
  if (!db.tableExists("family")) return;  // a run of an earlier version
  std::map<int, RecordedFamily> families;
  each_row(db, "SELECT number, name, round, fidelity, count, is_validated, simulations, samples FROM family",
           [&](SQLite::Statement& q) {
             wire::CalibratedFamily& stated = families[q.getColumn(0).getInt()].stated;
             stated.number = q.getColumn(0).getInt();
             stated.name = q.getColumn(1).getString();
             stated.round = q.getColumn(2).getInt();
             stated.fidelity =
                 tester::fidelity_from_string(q.getColumn(3).getString()).value_or(tester::Fidelity::tiny);
             stated.count = q.getColumn(4).getInt();
             stated.is_validated = q.getColumn(5).getInt() != 0;
             stated.simulations = q.getColumn(6).getInt();
             stated.samples = q.getColumn(7).getInt();
           });
  each_row(db, "SELECT number, name, value FROM family_parameter", [&](SQLite::Statement& q) {
    families[q.getColumn(0).getInt()].parameters[q.getColumn(1).getString()] = q.getColumn(2).getDouble();
  });
  each_row(db,
           "SELECT number, pattern, is_seed, measured_modulus_pa, measured_toughness_pa, global_modulus_pa, "
           "global_toughness_pa, family_modulus_pa, "
           "family_toughness_pa FROM family_design ORDER BY number, position",
           [&](SQLite::Statement& q) { families[q.getColumn(0).getInt()].stated.designs.push_back(family_design(q)); });
  each_row(db, "SELECT number, pattern, modulus_pa, toughness_pa FROM family_gamut ORDER BY number, pattern",
           [&](SQLite::Statement& q) {
             if (const auto known = pattern::pattern_from_key(q.getColumn(1).getString()))
               families[q.getColumn(0).getInt()].gamut.push_back(
                   {*known, {q.getColumn(2).getDouble(), q.getColumn(3).getDouble()}});
           });
  if (db.tableExists("family_crack")) {  // absent in a run of an earlier version
    each_crack(db, "family_crack", "number", [&](int number, const std::string& design, RecordedCrack crack) {
      if (families.contains(number)) families[number].cracks[design] = std::move(crack);
    });
  }
  for (auto& [number, family] : families)
    if (!family.stated.name.empty()) run.families.push_back(std::move(family));  // its variants come before its FAMILY
}

/// Validity is the measurement's own unless a review says otherwise; the highest revision wins, "not valid" wins a tie.
constexpr const char* kSpecimens = R"sql(
  SELECT m.round, m.specimen, m.design, m.test, m.orientation_deg, m.strain_rate_per_s, m.thickness_mm, m.batch,
         m.print_order, m.modulus_pa, m.toughness_pa,
         coalesce((SELECT r.valid FROM review r WHERE r.specimen = m.specimen
                   ORDER BY r.revision DESC, r.valid LIMIT 1), m.valid),
         coalesce((SELECT r.why FROM review r WHERE r.specimen = m.specimen
                   ORDER BY r.revision DESC, r.valid LIMIT 1), m.note), m.curve
  FROM measurement m ORDER BY m.specimen
)sql";

void read_specimens(SQLite::Database& db, RunRecord& run) {
  each_row(db, kSpecimens, [&](SQLite::Statement& q) {
    const auto design = pattern::design_from_name(q.getColumn(2).getString());
    const auto test = tester::test_kind_from_string(q.getColumn(3).getString());
    if (!design || !test) return;
    MeasuredSpecimen m;
    m.round = q.getColumn(0).getInt();
    m.record.specimen = q.getColumn(1).getString();
    m.record.design = *design;
    m.record.test = *test;
    m.record.conditions = {q.getColumn(4).getDouble(), q.getColumn(5).getDouble(), q.getColumn(6).getDouble()};
    m.record.batch = q.getColumn(7).getString();
    m.record.print_order = q.getColumn(8).getInt();
    m.record.modulus_pa = optional_double(q.getColumn(9));
    m.record.toughness_pa = optional_double(q.getColumn(10));
    m.record.note = q.getColumn(12).getString();
    m.record.curve = unpacked(q.getColumn(13));
    // As for the validation agent: a review makes no specimen valid that has no usable value.
    m.record.valid = q.getColumn(11).getInt() != 0 && !measurement::why_unusable(m.record);
    run.specimens.push_back(std::move(m));
  });
}

/// What `read` makes of the file, opened read-only.
template <class Read>
auto read_from(const std::filesystem::path& path, const Read& read) {
  try {
    SQLite::Database db(path.string(), SQLite::OPEN_READONLY, 10'000);
    distrust(db);
    return read(db);
  } catch (const SQLite::Exception& error) {
    throw InputError::format("{}: cannot be read: {}", path.string(), error.what());
  }
}

}  // namespace

RunRecord read_run_record(const std::filesystem::path& path, bool with_gamuts) {
  return read_from(path, [&](SQLite::Database& db) {
    RunRecord run;
    read_summaries(db, run);
    read_model(db, run);
    read_fits(db, run);
    if (with_gamuts) read_gamuts(db, run);
    read_cracks(db, run);
    read_diagnoses(db, run);
    read_specimens(db, run);
    read_families(db, run);
    return run;
  });
}

std::map<int, int> read_gamut_sizes(const std::filesystem::path& path) {
  return read_from(path, [](SQLite::Database& db) {
    std::map<int, int> sizes;
    each_row(db, "SELECT round, count(*) FROM gamut GROUP BY round",
             [&](SQLite::Statement& q) { sizes[q.getColumn(0).getInt()] = q.getColumn(1).getInt(); });
    return sizes;
  });
}

RecordedGamut read_gamut(const std::filesystem::path& path, int round) {
  return read_from(path, [&](SQLite::Database& db) {
    RecordedGamut gamut;
    SQLite::Statement query(db, "SELECT pattern, modulus_pa, toughness_pa FROM gamut WHERE round = ? ORDER BY pattern");
    query.bind(1, round);
    while (query.executeStep()) {
      const std::string key = query.getColumn(0).getString();
      std::uint64_t bits = 0;
      const auto [end, fault] = std::from_chars(key.data(), key.data() + key.size(), bits, 16);
      if (fault != std::errc{} || end != key.data() + key.size() || bits >> pattern::kFreePixels != 0) continue;
      gamut.patterns.push_back(bits);
      gamut.performances.push_back({query.getColumn(1).getDouble(), query.getColumn(2).getDouble()});
    }
    return gamut;
  });
}

}  // namespace nacre::store
