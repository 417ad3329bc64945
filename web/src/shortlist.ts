// The shortlist of a run: designs that somebody wants to keep in sight, in this browser's storage.

import { useEffect, useState } from "preact/hooks";
import { useOpenRun } from "./run_context";

/** A design with what was known of it when it was put on the list; null: unknown. */
export interface Listed {
  design: string;
  /** Where it was found. */
  of: string;
  rigid_fraction: number | null;
  modulus_pa: number | null;
  toughness_pa: number | null;
}

/** So many designs are as many as anybody prints. */
export const MOST_LISTED = 200;

const CHANGED = "nacre-shortlist";

function stored(key: string): Listed[] {
  try {
    const list = JSON.parse(localStorage.getItem(key) ?? "[]") as unknown;
    const isListed = (each: unknown): each is Listed => typeof (each as Listed | null)?.design === "string";
    return Array.isArray(list) ? list.filter(isListed).slice(0, MOST_LISTED) : [];
  } catch {
    return []; // somebody else's
  }
}

export interface Shortlist {
  list: Listed[];
  has: (design: string) => boolean;
  /** Adds what is not there yet, up to MOST_LISTED; how many were new. */
  add: (designs: Listed[]) => number;
  remove: (designs: string[]) => void;
}

/** The open run's shortlist, the same in every part and every tab of the page. A run that was played again under the
 *  same name has another one. */
export function useShortlist(): Shortlist {
  const run = useOpenRun();
  const key = `nacre.shortlist.${run?.run}.${run?.started}`;
  const [list, setList] = useState(() => stored(key));
  useEffect(() => {
    const follow = () => setList(stored(key));
    follow();
    for (const event of [CHANGED, "storage"]) addEventListener(event, follow);
    return () => {
      for (const event of [CHANGED, "storage"]) removeEventListener(event, follow);
    };
  }, [key]);
  const keep = (next: Listed[]) => {
    localStorage.setItem(key, JSON.stringify(next));
    dispatchEvent(new Event(CHANGED));
  };
  return {
    list,
    has: (design) => list.some((each) => each.design === design),
    add: (designs) => {
      const before = stored(key);
      const known = new Set(before.map((each) => each.design));
      const fresh = designs.filter((each) => !known.has(each.design)).slice(0, MOST_LISTED - before.length);
      keep([...before, ...fresh]);
      return fresh.length;
    },
    remove: (designs) => keep(stored(key).filter((each) => !designs.includes(each.design))),
  };
}
