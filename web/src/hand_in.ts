// Handing something in: what people decide and measure goes to the game and counts once it has been taken.

import { useState } from "preact/hooks";
import { post, problemOf } from "./api";
import type { Said } from "./parts";

type Answer = { answer: string; doubts?: string[] };

/** Hands something in and says what came of it. `refresh` never throws. */
export function useHandIn(
  refresh: () => Promise<void>,
  meanwhile = "waiting for the validation agent …",
): [Said | null, boolean, (path: string, body: unknown, done: string) => Promise<boolean>] {
  const [said, setSaid] = useState<Said | null>(null);
  const [busy, setBusy] = useState(false);
  const handIn = async (path: string, body: unknown, done: string) => {
    setBusy(true);
    setSaid({ kind: "busy", text: meanwhile });
    try {
      const { answer, doubts = [] } = await post<Answer>(path, body);
      await refresh(); // where the page cannot read it yet, that is said beside it: it has been taken all the same
      const taken = answer === "repeated" ? "The run has this already." : done;
      setSaid({ kind: doubts.length ? "bad" : "good", text: [taken, ...doubts].join(" ") });
      return true;
    } catch (error) {
      setSaid({ kind: "bad", text: problemOf(error) });
      return false;
    } finally {
      setBusy(false);
    }
  };
  return [said, busy, handIn];
}
