// The newest of a game: a round that has begun need not have its model or its proposals yet.

import type { Round, Rounds } from "./api";

/** The newest round with an adopted model, which simulates what belongs to no round; 0 before there is one. */
export function newestModel({ rounds }: Rounds): number {
  return Math.max(0, ...rounds.filter((r) => Object.keys(r.parameters).length > 0).map((r) => r.round));
}

/** The last round with proposals; null: none has any. */
export function lastProposing({ rounds }: Rounds): Round | null {
  return rounds.filter((r) => r.proposals.length > 0).at(-1) ?? null;
}
