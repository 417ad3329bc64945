// Reading from the server: the last response stays until there is a newer one; where it refuses, its sentence is kept.

import { useEffect, useRef, useState } from "preact/hooks";
import { address, get, ofRun, openedRun, problemOf, type Query } from "./api";
import { loadGamut, type Gamut } from "./gamut";
import { useRepeated } from "./parts";

/** After so long a refused request is sent again: the server may have been stopped, or busy. */
export const AGAIN_MS = 5000;

interface Reading<T> {
  /** The newest response; null: none yet. */
  value: T | null;
  /** Why the last request failed; empty: it did not. */
  problem: string;
  /** Sends the request again. What is known stays meanwhile, and it never throws. */
  read: () => Promise<void>;
}

/** A response of the server, read whenever `read` is called. Another query begins with nothing. `run` empty: none. */
export function useResponse<T>(path: string, query: Query = {}, run = openedRun()): Reading<T> {
  const request = ofRun(address(path, query), run);
  const nothing = { request, value: null as T | null, problem: "" };
  const [kept, setKept] = useState(nothing);
  const turns = useRef({ sent: 0, taken: 0 });
  const take = (turn: number, value: T | null, problem: string) => {
    if (turn < turns.current.taken) return; // a later request was answered first
    turns.current.taken = turn;
    setKept((before) => {
      const now = before.request === request ? before : nothing;
      // An equal response is the same object, so that nothing is drawn again for it.
      const next = value === null || JSON.stringify(value) === JSON.stringify(now.value) ? now.value : value;
      return now === before && next === now.value && problem === now.problem ? now : { request, value: next, problem };
    });
  };
  const read = async () => {
    const turn = ++turns.current.sent;
    try {
      take(turn, await get<T>(path, query, run), "");
    } catch (error) {
      take(turn, null, problemOf(error));
    }
  };
  return { ...(kept.request === request ? kept : nothing), read };
}

/** The same, read at once, again whenever `version` changes, and every few seconds while the server refuses. Not
 *  `wanted`: nothing is read. */
export function useReading<T>(path: string, query: Query, version: unknown, wanted = true): Reading<T> {
  const response = useResponse<T>(path, query);
  useEffect(() => void (wanted && response.read()), [address(path, query), version, wanted]);
  useRepeated(response.read, AGAIN_MS, wanted && response.problem !== "");
  return response;
}

/** A gamut to show: its name on the page, how many patterns it has, and whose it is. */
interface Wanted {
  name: string;
  count: number;
  which: { round: number } | { family: string };
}

/** Gamuts by name, loaded again once they have grown, and every few seconds where one could not be read. */
export function useGamuts(wanted: Wanted[]): { gamuts: Map<string, Gamut>; problem: string } {
  const [gamuts, setGamuts] = useState(new Map<string, Gamut>());
  const [problems, setProblems] = useState(new Map<string, string>());
  const [attempt, setAttempt] = useState(0);
  const loading = useRef(new Set<string>());
  const missing = wanted.filter((w) => w.count > 0 && gamuts.get(w.name)?.patterns.length !== w.count);
  const keyOf = (w: Wanted) => `${w.name}:${w.count}`;
  useEffect(() => {
    for (const each of missing.filter((w) => !loading.current.has(keyOf(w)))) {
      loading.current.add(keyOf(each));
      loadGamut(each.which)
        .then((gamut) => setGamuts((before) => new Map(before).set(each.name, gamut)))
        .catch((error) => setProblems((before) => new Map(before).set(each.name, problemOf(error))))
        .finally(() => loading.current.delete(keyOf(each)));
    }
  }, [missing.map(keyOf).join(), attempt]);
  const problem = missing.map((w) => problems.get(w.name)).find(Boolean) ?? "";
  useRepeated(async () => setAttempt((n) => n + 1), AGAIN_MS, problem !== "");
  return { gamuts, problem };
}
