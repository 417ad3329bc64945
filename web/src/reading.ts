// Reading from the server: what it said last stays until there is something newer, and where it refuses, its sentence is kept.

import { useEffect, useRef, useState } from "preact/hooks";
import { address, get, problemOf, type Query } from "./api";
import { loadGamut, type Gamut } from "./gamut";
import { useRepeated } from "./parts";

/** After which what the server refused is asked for again: it may have been stopped, or busy. */
export const AGAIN_MS = 5000;

interface Reading<T> {
  /** The newest answer; null: none yet. */
  value: T | null;
  /** Why there was no answer the last time; empty: there was one. */
  problem: string;
  /** Asks again. What is known stays meanwhile, and it never throws. */
  read: () => Promise<void>;
}

/** Something that the server says, read whenever `read` is called. Another query begins with nothing. */
export function useAnswer<T>(path: string, query: Query = {}): Reading<T> {
  const question = address(path, query);
  const nothing = { question, value: null as T | null, problem: "" };
  const [kept, setKept] = useState(nothing);
  const turns = useRef({ asked: 0, taken: 0 });
  const take = (turn: number, value: T | null, problem: string) => {
    if (turn < turns.current.taken) return; // a later question was answered first
    turns.current.taken = turn;
    setKept((before) => {
      const now = before.question === question ? before : nothing;
      // The same answer is the same object, so that nothing is drawn anew for it.
      const next = value === null || JSON.stringify(value) === JSON.stringify(now.value) ? now.value : value;
      return now === before && next === now.value && problem === now.problem ? now : { question, value: next, problem };
    });
  };
  const read = async () => {
    const turn = ++turns.current.asked;
    try {
      take(turn, await get<T>(path, query), "");
    } catch (error) {
      take(turn, null, problemOf(error));
    }
  };
  return { ...(kept.question === question ? kept : nothing), read };
}

/** The same, read at once, again with every other `version`, and now and then while the server refuses. */
export function useReading<T>(path: string, query: Query, version: unknown): Reading<T> {
  const answer = useAnswer<T>(path, query);
  useEffect(() => void answer.read(), [address(path, query), version]);
  useRepeated(answer.read, AGAIN_MS, answer.problem !== "");
  return answer;
}

/** A gamut that is to be shown: its name on the page, how many patterns it has, and whose it is. */
interface Wanted {
  name: string;
  count: number;
  which: { round: number } | { family: string };
}

/** Gamuts by name, loaded again once they have grown; where one could not be read, now and then. */
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
