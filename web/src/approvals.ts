// Having designs measured: in the proposal that waits for them, or in addition to it.

import { useEffect } from "preact/hooks";
import { post, problemOf, Refusal, type Families, type Laboratory } from "./api";
import { offerOf } from "./proposals";
import { useResponse } from "./reading";
import { useOpenRun } from "./run_context";

interface Approvals {
  /** The round of the proposal in which a design waits for a yes; -1: none, it would be a design of one's own. */
  roundOf: (design: string) => number;
  /** How far a design has got; null: nobody has proposed or measured it. */
  stateOf: (design: string) => string | null;
  /** Why that is not known; empty: it is, or is being read. */
  problem: string;
  isRead: boolean;
  read: () => Promise<void>;
}

/** Read at once, and again whenever the run's `data` change. */
export function useApprovals(data: string | null): Approvals {
  const run = useOpenRun();
  const laboratory = useResponse<Laboratory>("/api/laboratory");
  const families = useResponse<Families>("/api/families");
  const read = async () => {
    await families.read();
    await laboratory.read();
  };
  useEffect(() => void read(), [data]);
  const book = laboratory.value;
  const offer = book && families.value && offerOf(book, families.value.stage, Infinity);
  const stateOf = (design: string) => book?.designs.find((d) => d.design === design)?.state ?? null;
  const waits = (design: string) => (stateOf(design) ?? "pending") === "pending";
  return {
    roundOf: (design) =>
      run?.approval && offer?.designs.some((d) => d.design === design) && waits(design) ? offer.round : -1,
    stateOf,
    problem: laboratory.problem || families.problem,
    isRead: book !== null && families.value !== null,
    read,
  };
}

/** What came of approving several designs. */
export interface Approved {
  taken: string[];
  refused: { design: string; reason: string }[];
  /** Why it ended before the last one; empty: it did not. */
  stopped: string;
}

/** Approves one design after the other; a refusal is kept and the next one follows, where nobody answers it ends. */
export async function approveEach(
  designs: string[],
  roundOf: (design: string) => number,
  words: { by: string; why: string },
  progress: (done: number) => void,
): Promise<Approved> {
  const result: Approved = { taken: [], refused: [], stopped: "" };
  for (const [done, design] of designs.entries()) {
    progress(done);
    try {
      await post("/api/approval", { design, round: roundOf(design), approved: true, ...words });
      result.taken.push(design);
    } catch (error) {
      const isAnswer = error instanceof Refusal && error.status < 500;
      if (!isAnswer) return { ...result, stopped: problemOf(error) };
      result.refused.push({ design, reason: problemOf(error) });
    }
  }
  return result;
}
