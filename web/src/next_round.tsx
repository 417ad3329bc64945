// Is another round worth it, and what the round at hand costs: the server's sentences.

import type { NextRound, RoundPrice, Rounds } from "./api";
import { sentence } from "./numbers";
import { useReading } from "./reading";
import { closedRounds } from "./run_figures";

const readable = (text: string) => sentence(text.replaceAll("+-", "±")) + ".";

/** What the last rounds brought, what the next is expected to bring, and its price. */
export function WorthOfNext({ rounds }: { rounds: Rounds }) {
  const version = `${closedRounds(rounds).length}/${rounds.measured.length}`;
  const next = useReading<NextRound>("/api/next", {}, version).value;
  return next && <p class="next-round">{readable(next.sentence)}</p>;
}

export function PriceOfRound({ price }: { price: RoundPrice | null }) {
  return price && <p class="price">{readable(price.sentence)}</p>;
}
