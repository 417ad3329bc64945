// What a run is doing, in one line.

import type { Live, NodeState, Rounds, RunInfo } from "./api";
import { duration } from "./numbers";
import { addressOf } from "./route";

export interface RunStatus {
  text: string;
  kind: "good" | "done" | "rest" | "bad";
  /** Where to go on, where somebody is waited for. */
  link?: string;
}

/** How many designs a node holds back until a person has approved them. */
export function toApprove(node: NodeState): number {
  if (node.state !== "running" || !/approv/.test(node.phase)) return 0;
  return Number(/(\d+) designs?\b/.exec(node.phase)?.[1] ?? 1);
}

/** Whose phase says best what the game is doing, the first of them that does not wait for another node. */
const LEADERS = ["validation_agent", "proposal_agent", "analyser", "simulator_farm", "virtual_lab"];
const isBusy = (node: NodeState) =>
  node.state === "running" && node.phase !== "" && !/^(waiting|idle|following|the |over)/.test(node.phase);

/** "searching the gamut, about 4 min left"; empty: nobody is busy. */
function activityOf(nodes: NodeState[]): string {
  const busy = LEADERS.map((name) => nodes.find((n) => n.node === name)).find((n) => n && isBusy(n));
  if (!busy) return "";
  return busy.eta_s !== null && busy.eta_s > 0 ? `${busy.phase}, about ${duration(busy.eta_s)} left` : busy.phase;
}

function playingStatus(info: RunInfo, live: Live): RunStatus {
  const nodes = live.nodes.filter((n) => n.state === "running");
  const round = Math.max(0, ...nodes.map((n) => n.round));
  const place =
    round === 0 ? `preparing round 1 of ${info.rounds}` : `round ${round} of ${Math.max(info.rounds, round)}`;
  const waiting = Math.max(0, ...nodes.map(toApprove));
  if (waiting > 0)
    return {
      text: `${place}: waits for you, ${waiting} ${waiting === 1 ? "design" : "designs"} to approve`,
      kind: "good",
      link: addressOf("laboratory"),
    };
  return { text: `${place}: ${activityOf(nodes) || "running"}`, kind: "good" };
}

export function statusOf(info: RunInfo, rounds: Rounds, live: Live | null, problem: string): RunStatus {
  const complete = rounds.rounds.filter((r) => r.summary);
  const last = complete.at(-1);
  if (problem) return { text: problem, kind: "bad" };
  if (last?.summary!.last)
    return {
      text: `finished after round ${last.round}${last.summary!.equilibrium ? ": equilibrium is reached" : ""}`,
      kind: "done",
    };
  if (live?.playing) return playingStatus(info, live);
  return {
    text: last ? `not running; round ${last.round} of ${info.rounds} is complete` : "not running; no round is complete",
    kind: "rest",
  };
}
