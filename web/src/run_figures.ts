// The figures of a round that are followed from round to round.

import type { Errors, Round, Rounds, Summary } from "./api";

/** A round that is complete. */
export type ClosedRound = Round & { summary: Summary };

export const closedRounds = ({ rounds }: Rounds) => rounds.filter((r): r is ClosedRound => r.summary !== null);

/** The value; null in a round before anything was measured. */
const ofMeasured = ({ summary }: ClosedRound, value: number) =>
  summary.measured_hypervolume_staircase > 0 ? value : null;

const someE = (e: Errors | null) => (e && e.n_modulus > 0 ? e.modulus_mean : null);
const someT = (e: Errors | null) => (e && e.n_toughness > 0 ? e.toughness_mean : null);

type Figure = (round: ClosedRound) => number | null;

export const FIGURES = {
  predictedHypervolume: (r) => r.summary.gamut_hypervolume_staircase,
  measuredHypervolume: (r) => ofMeasured(r, r.summary.measured_hypervolume_staircase),
  hypervolumeError: (r) => ofMeasured(r, r.summary.hypervolume_error),
  gap: (r) => ofMeasured(r, r.summary.gap),
  modulusError: (r) => someE(r.summary.held_out),
  toughnessError: (r) => someT(r.summary.held_out),
  modulusFit: (r) => someE(r.summary.after),
  toughnessFit: (r) => someT(r.summary.after),
  /** From three designs on: of two a rank correlation means nothing. */
  toughnessRank: ({ summary: { held_out: e } }) => (e && e.n_toughness >= 3 ? e.toughness_spearman : null),
} satisfies Record<string, Figure>;

export type FigureName = keyof typeof FIGURES;

/** Names of columns in the files, the same wherever they are written. */
export const CSV: Record<FigureName, string> = {
  predictedHypervolume: "gamut_hypervolume_gpa_mpa",
  measuredHypervolume: "measured_hypervolume_gpa_mpa",
  hypervolumeError: "hypervolume_error_gpa_mpa",
  gap: "gap_gpa_mpa",
  modulusError: "modulus_error_held_out",
  toughnessError: "toughness_error_held_out",
  modulusFit: "modulus_error_after",
  toughnessFit: "toughness_error_after",
  toughnessRank: "toughness_spearman_held_out",
};

/** The figure by round, with its error. */
export const pointsOf = (closed: ClosedRound[], figure: FigureName, error?: FigureName) =>
  closed.map((r) => ({ round: r.round, value: FIGURES[figure](r), error: error && FIGURES[error](r) }));
