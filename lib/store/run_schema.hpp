#pragma once

namespace nacre::store {

inline constexpr int kRunSchemaVersion = 3;

/// Tables of run.db. SI units; hypervolumes and gap in GPa MPa; curves as pairs (strain, stress_pa) of double,
/// little-endian.
inline constexpr const char* kRunSchema = R"sql(
  CREATE TABLE round (
    round INTEGER PRIMARY KEY, fidelity TEXT NOT NULL, calibration_count INTEGER NOT NULL,
    measured_hypervolume_staircase REAL NOT NULL, measured_hypervolume_polygon REAL NOT NULL,
    gamut_hypervolume_staircase REAL NOT NULL, gamut_hypervolume_polygon REAL NOT NULL,
    gap REAL NOT NULL, signed_gap REAL NOT NULL, hypervolume_error REAL NOT NULL,
    equilibrium INTEGER NOT NULL, last INTEGER NOT NULL, decided_by TEXT NOT NULL
  ) STRICT;
  CREATE TABLE prediction_error (
    round INTEGER NOT NULL, moment TEXT NOT NULL,  -- before, after, held_out
    modulus_count INTEGER NOT NULL, modulus_mean REAL NOT NULL, modulus_max REAL NOT NULL,
    toughness_count INTEGER NOT NULL, toughness_mean REAL NOT NULL, toughness_max REAL NOT NULL,
    toughness_spearman REAL NOT NULL, PRIMARY KEY (round, moment)
  ) STRICT;
  CREATE TABLE parameter (
    round INTEGER NOT NULL, name TEXT NOT NULL, value REAL NOT NULL, PRIMARY KEY (round, name)
  ) STRICT;
  CREATE TABLE benchmark (
    round INTEGER NOT NULL, position INTEGER NOT NULL, modulus_pa REAL NOT NULL, toughness_pa REAL NOT NULL,
    PRIMARY KEY (round, position)
  ) STRICT;
  CREATE TABLE gamut (
    round INTEGER NOT NULL, pattern TEXT NOT NULL, modulus_pa REAL NOT NULL, toughness_pa REAL NOT NULL,
    PRIMARY KEY (round, pattern)
  ) STRICT, WITHOUT ROWID;
  CREATE TABLE proposal (
    round INTEGER NOT NULL, design TEXT NOT NULL, position INTEGER NOT NULL, modulus_pa REAL NOT NULL,
    toughness_pa REAL NOT NULL, bin INTEGER NOT NULL, reason TEXT NOT NULL, PRIMARY KEY (round, design)
  ) STRICT;
  CREATE TABLE measurement (
    specimen TEXT PRIMARY KEY, round INTEGER NOT NULL, order_id TEXT NOT NULL, design TEXT NOT NULL, test TEXT NOT NULL,
    orientation_deg REAL NOT NULL, strain_rate_per_s REAL NOT NULL, thickness_mm REAL NOT NULL, batch TEXT NOT NULL,
    print_order INTEGER NOT NULL, modulus_pa REAL, toughness_pa REAL, valid INTEGER NOT NULL, note TEXT NOT NULL,
    curve BLOB NOT NULL
  ) STRICT;
  CREATE TABLE review (
    specimen TEXT NOT NULL, revision INTEGER NOT NULL, valid INTEGER NOT NULL, who TEXT NOT NULL, why TEXT NOT NULL,
    PRIMARY KEY (specimen, revision)
  ) STRICT;
  CREATE TABLE diagnosis (
    round INTEGER PRIMARY KEY, verdict TEXT NOT NULL, summary TEXT NOT NULL,
    held_out_error_before REAL, held_out_error_after REAL, relative_reduction REAL
  ) STRICT;
  CREATE TABLE diagnosis_effect (
    round INTEGER NOT NULL, name TEXT NOT NULL, parameter REAL NOT NULL, interval_low REAL NOT NULL,
    interval_high REAL NOT NULL, unit TEXT NOT NULL, PRIMARY KEY (round, name)
  ) STRICT;
  CREATE TABLE diagnosis_candidate (
    round INTEGER NOT NULL, name TEXT NOT NULL, status TEXT NOT NULL, statistic REAL NOT NULL,
    p_family_wise REAL NOT NULL, absorption REAL NOT NULL, PRIMARY KEY (round, name)
  ) STRICT;
  CREATE TABLE simulated (  -- what the model of a round predicts for measured designs
    round INTEGER NOT NULL, design TEXT NOT NULL, modulus_pa REAL NOT NULL, toughness_pa REAL NOT NULL,
    failure TEXT NOT NULL, curve BLOB NOT NULL, PRIMARY KEY (round, design)
  ) STRICT;
)sql";

/// Whether the calibration of a round explains E and T; made where absent, as below.
inline constexpr const char* kFitSchema = R"sql(
  CREATE TABLE IF NOT EXISTS goodness_of_fit (
    round INTEGER NOT NULL, property TEXT NOT NULL,  -- E, T
    designs INTEGER NOT NULL, freedom INTEGER NOT NULL, chi_squared REAL NOT NULL, chi_squared_replicates REAL NOT NULL,
    p_value REAL NOT NULL, PRIMARY KEY (round, property)
  ) STRICT;
)sql";

/// The family stage after the game; made where absent, for runs that an earlier version began.
inline constexpr const char* kFamilySchema = R"sql(
  CREATE TABLE IF NOT EXISTS family (
    number INTEGER PRIMARY KEY, name TEXT NOT NULL, round INTEGER NOT NULL, fidelity TEXT NOT NULL,
    count INTEGER NOT NULL, is_validated INTEGER NOT NULL, simulations INTEGER NOT NULL, samples INTEGER NOT NULL
  ) STRICT;
  CREATE TABLE IF NOT EXISTS family_parameter (
    number INTEGER NOT NULL, name TEXT NOT NULL, value REAL NOT NULL, PRIMARY KEY (number, name)
  ) STRICT;
  CREATE TABLE IF NOT EXISTS family_design (  -- seeds and chosen designs, in order
    number INTEGER NOT NULL, pattern TEXT NOT NULL, position INTEGER NOT NULL, is_seed INTEGER NOT NULL,
    measured_modulus_pa REAL, measured_toughness_pa REAL, global_modulus_pa REAL, global_toughness_pa REAL,
    family_modulus_pa REAL, family_toughness_pa REAL, PRIMARY KEY (number, pattern)
  ) STRICT;
  CREATE TABLE IF NOT EXISTS family_gamut (  -- variants by the family's own model
    number INTEGER NOT NULL, pattern TEXT NOT NULL, modulus_pa REAL NOT NULL, toughness_pa REAL NOT NULL,
    PRIMARY KEY (number, pattern)
  ) STRICT, WITHOUT ROWID;
)sql";

/// How designs break by a model, {1} saying which: `crack` has proposals by the model of their round, `family_crack`
/// the designs of a family by its own. Path and breaks: int32 elements; film: file in films/.
inline constexpr const char* kCrackSchema = R"sql(
  CREATE TABLE IF NOT EXISTS {0} (
    {1} INTEGER NOT NULL, design TEXT NOT NULL, film TEXT NOT NULL, columns INTEGER NOT NULL, rows INTEGER NOT NULL,
    broken INTEGER NOT NULL, branches INTEGER NOT NULL, separate_cracks INTEGER NOT NULL, path_length_m REAL,
    straight_length_m REAL, bridged_share REAL, soft_share REAL, rigid_share REAL, interface_share REAL,
    crosses INTEGER, path BLOB NOT NULL, breaks BLOB NOT NULL, PRIMARY KEY ({1}, design)
  ) STRICT;
)sql";

}  // namespace nacre::store
