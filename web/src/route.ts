// Addresses of the page: `#/runs`, the list, and `#/run/NAME/VIEW`, with pairs of a key and its value behind it, such
// as `#/run/demo/game/round/2/design/577fffe9fffdef`.

import { useEffect, useState } from "preact/hooks";
import { openedRun } from "./api";

export const VIEWS = {
  game: "Game",
  laboratory: "Laboratory",
  diagnosis: "Diagnosis",
  families: "Families",
  explorer: "Explorer",
  editor: "Editor",
  nodes: "Nodes",
  words: "Words",
} as const;
export type View = keyof typeof VIEWS;

/** What is looked at within a view. `model`: the round, or the family, whose model simulates the design. */
export type At = Partial<Record<"round" | "design" | "model" | "map" | "specimen", string>>;

const KEYS: Record<View, (keyof At)[]> = {
  game: ["round", "design", "model"],
  laboratory: ["specimen"],
  diagnosis: ["round"],
  families: ["design", "model"],
  explorer: ["map", "design"],
  editor: ["design"],
  nodes: [],
  words: [],
};

/** Where the page is. `start`: nothing is said. An address of `view` without a run means the first one. */
export type Route =
  | { page: "start" }
  | { page: "runs" }
  | { page: "view"; run: string | null; view: View; at: At }
  | { page: "nowhere"; run: string | null; why: string };

const isView = (name: string): name is View => Object.hasOwn(VIEWS, name);

/** The text that was encoded, or as it stands where it cannot have been. */
function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

function viewRoute(run: string | null, view: string, rest: string[]): Route {
  if (!isView(view)) return { page: "nowhere", run, why: `There is no view “${view}”.` };
  const at: At = {};
  for (let i = 0; i < rest.length; i += 2) {
    const key = KEYS[view].find((each) => each === rest[i]);
    if (!key) return { page: "nowhere", run, why: `The view “${VIEWS[view]}” shows no “${rest[i]}”.` };
    if (!rest[i + 1]) return { page: "nowhere", run, why: `The address does not say which ${key} is meant.` };
    at[key] = rest[i + 1];
  }
  return { page: "view", run, view, at };
}

export function routeOf(hash: string): Route {
  const parts = hash.replace(/^#/, "").replace(/\/$/, "").split("/").map(decoded);
  if (parts[0] !== "") return viewRoute(null, parts[0], parts.slice(1));
  if (parts.length === 1) return { page: "start" };
  if (parts[1] === "runs" && parts.length === 2) return { page: "runs" };
  if (parts[1] === "run" && parts[2]) return viewRoute(parts[2], parts[3] ?? "game", parts.slice(4));
  return { page: "nowhere", run: null, why: "There is nothing at this address." };
}

export const RUNS = "#/runs";

/** Commas and colons may stand in an address. */
const encoded = (part: string) => encodeURIComponent(part).replace(/%2C|%3A/g, decodeURIComponent);

/** The address of a view of a run; of the open one where none is named. */
export function addressOf(view: View, at: At = {}, run = openedRun()): string {
  const pairs = KEYS[view].flatMap((key) => (at[key] ? [key, at[key]!] : []));
  return `#/${["run", run, view, ...pairs].map(encoded).join("/")}`;
}

/** The route of the page's address, followed. */
export function useRoute(): Route {
  const [hash, setHash] = useState(location.hash);
  useEffect(() => {
    const follow = () => setHash(location.hash);
    addEventListener("hashchange", follow);
    return () => removeEventListener("hashchange", follow);
  }, []);
  return routeOf(hash);
}

/** What a view looks at, and how it looks at something else: the address follows. */
export interface Looking {
  at: At;
  look: (at: At) => void;
}

export const lookingAt = (view: View, at: At): Looking => ({
  at,
  look: (next) => {
    location.hash = addressOf(view, next);
  },
});
