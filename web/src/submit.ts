// What people enter goes to the game and counts once the nodes have confirmed it.

import { useState } from "preact/hooks";
import { post, problemOf } from "./api";
import type { NoticeText } from "./parts";

type Confirmation = { answer: string; doubts?: string[] };

/** Sends `body` to `path` and says what came of it: `done` where it was taken, else why not; `explain` may put the
 *  server's sentence into the words of a form. */
type Submit = (
  path: string,
  body: unknown,
  done: string,
  explain?: (sentence: string) => string,
) => Promise<boolean>;

/** What there is to say about the last thing submitted, whether it is on its way, and how to submit. `refresh` never
 *  throws. */
export function useSubmit(
  refresh: () => Promise<void>,
  meanwhile = "waiting for the validation agent …",
): [NoticeText | null, boolean, Submit] {
  const [notice, setNotice] = useState<NoticeText | null>(null);
  const [busy, setBusy] = useState(false);
  const submit: Submit = async (path, body, done, explain = (sentence) => sentence) => {
    setBusy(true);
    setNotice({ kind: "busy", text: meanwhile });
    try {
      const { answer, doubts = [] } = await post<Confirmation>(path, body);
      await refresh(); // it has been taken, even where the page cannot read it yet
      const taken = answer === "repeated" ? "The run has this already." : done;
      setNotice({ kind: doubts.length ? "bad" : "good", text: [taken, ...doubts.map(explain)].join(" ") });
      return true;
    } catch (error) {
      setNotice({ kind: "bad", text: explain(problemOf(error)) });
      return false;
    } finally {
      setBusy(false);
    }
  };
  return [notice, busy, submit];
}
