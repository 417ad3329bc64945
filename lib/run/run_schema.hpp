#pragma once
// Tables and views of run.db. The views are for people: nacre itself never asks them, and store::distrust() knows their
// names.

namespace nacre::run {

inline constexpr int kRunSchemaVersion = 6;

/// `messages` holds what the analyser was sent and what it found, in that order. `payload`: the LCM encoding with blank
/// header, `hash` its identity, `content` the same as JSON by the .lcm file, without the header and without columns of
/// numbers (curves, cracks, gamuts); `reading`: what is read from a curve. `samples` are those of gamuts.
inline constexpr const char* kRunTables = R"sql(
  CREATE TABLE messages (
    id INTEGER PRIMARY KEY, channel TEXT NOT NULL, round INTEGER, hash TEXT NOT NULL UNIQUE, payload BLOB NOT NULL,
    content TEXT NOT NULL, reading TEXT
  ) STRICT;
  CREATE INDEX messages_of_channel ON messages (channel, round);
  CREATE TABLE samples (
    message INTEGER NOT NULL, place INTEGER NOT NULL, pattern INTEGER NOT NULL, modulus_pa REAL NOT NULL,
    toughness_pa REAL NOT NULL, PRIMARY KEY (message, place)
  ) STRICT, WITHOUT ROWID;
)sql";

/// SI units; hypervolumes and gap in GPa MPa; errors relative. A ROUND that says `last` stands, whatever comes after.
inline constexpr const char* kRoundsView = R"sql(
  CREATE VIEW rounds AS
  WITH closing AS (SELECT *, row_number() OVER (PARTITION BY round ORDER BY content->>'last' DESC, id DESC) AS place
                   FROM messages WHERE channel = 'ROUND')
  SELECT round, content->>'n_calibration' AS calibration_count,
         content->>'measured_hypervolume_staircase' AS measured_hypervolume,
         content->>'gamut_hypervolume_staircase' AS gamut_hypervolume,
         content->>'hypervolume_error' AS hypervolume_error,
         content->>'gap' AS gap, content->>'signed_gap' AS signed_gap,
         content->>'$.held_out.modulus_mean' AS held_out_modulus_error,
         content->>'$.held_out.toughness_mean' AS held_out_toughness_error,
         content->>'$.after.modulus_mean' AS fitted_modulus_error,
         content->>'$.after.toughness_mean' AS fitted_toughness_error,
         (SELECT d.content->>'verdict' FROM messages d WHERE d.channel = 'DIAGNOSIS' AND d.round = closing.round
          ORDER BY d.id DESC LIMIT 1) AS verdict,
         content->>'equilibrium' AS equilibrium, content->>'last' AS last, content->>'decided_by' AS decided_by
  FROM closing WHERE place = 1;
)sql";

/// Of the MEASUREMENTs of a name the highest revision counts, of two the first; of its reviews the highest revision,
/// "not valid" wins a tie. `round`: in which it was measured first, whoever ordered it.
inline constexpr const char* kSpecimensView = R"sql(
  CREATE VIEW specimens AS
  WITH report AS (SELECT *, row_number() OVER (PARTITION BY content->>'specimen'
                                               ORDER BY content->>'revision' DESC, id) AS place,
                         min(reading->>'measured_in') OVER (PARTITION BY content->>'specimen') AS measured_in
                  FROM messages WHERE channel = 'MEASUREMENT'),
       review AS (SELECT content, row_number() OVER (PARTITION BY content->>'specimen'
                                                     ORDER BY content->>'revision' DESC, content->>'valid') AS place
                  FROM messages WHERE channel = 'REVIEW')
  SELECT report.content->>'specimen' AS specimen, report.measured_in AS round,
         report.reading->>'design' AS design, report.reading->>'test' AS test,
         report.content->>'$.conditions.orientation_deg' AS orientation_deg,
         report.content->>'$.conditions.strain_rate_per_s' AS strain_rate_per_s,
         report.content->>'$.conditions.thickness_mm' AS thickness_mm, report.reading->>'standard' AS standard,
         report.content->>'batch' AS batch, report.content->>'print_order' AS print_order,
         report.content->>'order_id' AS order_id, report.reading->>'modulus_pa' AS modulus_pa,
         report.reading->>'toughness_pa' AS toughness_pa,
         coalesce(review.content->>'valid', report.content->>'valid') AND report.reading->>'usable' AS valid,
         coalesce(review.content->>'why', report.content->>'note') AS note, review.content->>'by' AS reviewed_by,
         report.content->>'revision' AS revision, nullif(report.content->>'by', '') AS amended_by,
         nullif(report.content->>'why', '') AS amended_why
  FROM report LEFT JOIN review ON review.content->>'specimen' = report.content->>'specimen' AND review.place = 1
  WHERE report.place = 1;
)sql";

/// Means of valid specimens under standard conditions; what was predicted when the design was proposed.
inline constexpr const char* kDesignsView = R"sql(
  CREATE VIEW designs AS
  WITH proposed AS (SELECT m.round, d.value->>'design' AS design, d.value->>'modulus_pa' AS modulus_pa,
                           d.value->>'toughness_pa' AS toughness_pa, d.value->>'reason' AS reason,
                           row_number() OVER (PARTITION BY d.value->>'design' ORDER BY m.round, m.id) AS place
                    FROM messages m, json_each(m.content, '$.designs') d WHERE m.channel = 'PROPOSAL'),
       measured AS (SELECT design, min(round) AS round, count(*) AS specimens,
                           avg(modulus_pa) FILTER (WHERE test = 'modulus') AS modulus_pa,
                           avg(toughness_pa) FILTER (WHERE test = 'toughness') AS toughness_pa
                    FROM specimens WHERE valid AND standard AND orientation_deg = 0 GROUP BY design),
       name AS (SELECT design FROM proposed UNION SELECT design FROM measured)
  SELECT name.design, proposed.round AS proposed_in, measured.round AS measured_in,
         coalesce(measured.specimens, 0) AS specimens, measured.modulus_pa, measured.toughness_pa,
         proposed.modulus_pa AS predicted_modulus_pa, proposed.toughness_pa AS predicted_toughness_pa, proposed.reason
  FROM name LEFT JOIN proposed ON proposed.design = name.design AND proposed.place = 1
            LEFT JOIN measured ON measured.design = name.design;
)sql";

/// `family`: whose variants they are; NULL: the gamut of the round, put together from its bases: of one pattern the
/// sample of the latest counts (SQLite takes it from the row of the max).
inline constexpr const char* kGamutView = R"sql(
  CREATE VIEW gamut AS
  WITH RECURSIVE own AS (SELECT id, round, content->>'base' AS base FROM messages WHERE channel = 'GAMUT'),
       part (round, source, base) AS (SELECT round, round, base FROM own
                                      UNION SELECT part.round, own.round, own.base
                                            FROM part JOIN own ON own.round = part.base)
  SELECT round, NULL AS family, printf('%014x', pattern) AS pattern, modulus_pa, toughness_pa
  FROM (SELECT part.round, s.pattern, s.modulus_pa, s.toughness_pa, max(part.source)
        FROM part JOIN own ON own.round = part.source JOIN samples s ON s.message = own.id
        GROUP BY part.round, s.pattern)
  UNION ALL
  SELECT m.round, (SELECT f.content->>'name' FROM messages f WHERE f.channel = 'FAMILY'
                   AND f.content->>'number' = m.content->>'number' LIMIT 1),
         printf('%014x', s.pattern), s.modulus_pa, s.toughness_pa
  FROM messages m JOIN samples s ON s.message = m.id WHERE m.channel = 'FAMILY_GAMUT';
)sql";

/// Pareto fronts of a round, stiffest first: `simulated`, and `measured` up to then (patterns alone).
inline constexpr const char* kFrontsView = R"sql(
  CREATE VIEW fronts AS
  WITH points AS (SELECT round, 'simulated' AS kind, pattern AS design, modulus_pa, toughness_pa
                  FROM gamut WHERE family IS NULL AND round IS NOT NULL
                  UNION ALL
                  SELECT rounds.round, 'measured', design, modulus_pa, toughness_pa FROM rounds JOIN designs
                  ON measured_in <= rounds.round
                  WHERE modulus_pa > 0 AND toughness_pa > 0 AND length(design) = 14 AND design NOT LIKE 'mix:%'),
       stiffer AS (SELECT *, max(toughness_pa) OVER (PARTITION BY round, kind
                                                     ORDER BY modulus_pa DESC, toughness_pa DESC
                                                     ROWS BETWEEN UNBOUNDED PRECEDING AND 1 PRECEDING) AS toughest
                   FROM points)
  SELECT round, kind, design, modulus_pa, toughness_pa FROM stiffer
  WHERE toughest IS NULL OR toughness_pa > toughest ORDER BY round, kind, modulus_pa DESC;
)sql";

/// Effects weighed in the diagnosis of a round; those that it names have a parameter.
inline constexpr const char* kEffectsView = R"sql(
  CREATE VIEW effects AS
  WITH found AS (SELECT *, row_number() OVER (PARTITION BY round ORDER BY id DESC) AS place
                 FROM messages WHERE channel = 'DIAGNOSIS')
  SELECT found.round, c.value->>'name' AS name, c.value->>'status' AS status, c.value->>'statistic' AS statistic,
         c.value->>'p_family_wise' AS p_family_wise, c.value->>'absorption' AS absorption,
         e.value->>'parameter' AS parameter, e.value->>'interval_low' AS interval_low,
         e.value->>'interval_high' AS interval_high, e.value->>'unit' AS unit
  FROM found JOIN json_each(found.content, '$.candidates') c
       LEFT JOIN json_each(found.content, '$.effects') e ON e.value->>'name' = c.value->>'name'
  WHERE found.place = 1;
)sql";

}  // namespace nacre::run
