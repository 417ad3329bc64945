// The nodes of a run: in short above every view, in full in a view of their own.

import type { Live, NodeState } from "./api";
import { bytes, duration, words } from "./numbers";
import { Bar, Table, type Column } from "./parts";

const SHORT: Record<string, string> = {
  virtual_lab: "laboratory",
  simulator_farm: "farm",
  proposal_agent: "proposal",
  validation_agent: "validation",
  analyser: "analyser",
};

export function NodeStrip({ live }: { live: Live }) {
  return (
    <ul class="nodes" aria-label="nodes">
      {live.nodes.map((n) => (
        <li key={n.node} class={n.state} title={n.last_problem || n.work || undefined}>
          <div>
            <span class={`dot ${n.last_problem ? "problem" : n.state}`} aria-hidden="true" />
            <strong>{SHORT[n.node] ?? words(n.node)}</strong>
            <span class="quiet">
              {n.state === "running" ? (n.eta_s !== null && n.eta_s > 0 ? `${duration(n.eta_s)} left` : "") : n.state}
            </span>
          </div>
          <p class="phase" title={n.phase || undefined}>
            {n.phase || " "}
          </p>
          <Bar share={n.state === "finished" || n.state === "ended" ? 1 : n.progress} label={`progress of ${words(n.node)}`} />
        </li>
      ))}
    </ul>
  );
}

const name: Column<NodeState> = {
  heading: "node",
  words: true,
  show: (n) => words(n.node),
  value: (n) => n.node,
};

const CHIPS: Record<string, string> = { silent: "rejected", finished: "approved" };

const WORK: Column<NodeState>[] = [
  name,
  {
    heading: "state",
    words: true,
    show: (n) => <span class={`chip ${CHIPS[n.state] ?? ""}`}>{n.state}</span>,
    value: (n) => n.state,
  },
  { heading: "round", show: (n) => n.round, value: (n) => n.round },
  { heading: "phase", words: true, show: (n) => n.phase, value: (n) => n.phase },
  {
    heading: "progress",
    show: (n) => (n.progress === null ? "–" : `${Math.round(100 * n.progress)} %`),
    value: (n) => n.progress,
  },
  {
    heading: "time left",
    csv: "eta_s",
    show: (n) => (n.eta_s === null ? "–" : duration(n.eta_s)),
    value: (n) => n.eta_s,
  },
  { heading: "work", value: (n) => n.work },
  {
    heading: "work, last problem",
    csv: "last_problem",
    words: true,
    show: (n) => (
      <>
        {n.work} {n.last_problem && <strong class="bad">{n.last_problem}</strong>}
      </>
    ),
    value: (n) => n.last_problem,
  },
];

const count = (heading: string, counter: keyof NodeState): Column<NodeState> => ({
  heading,
  csv: counter,
  show: (n) => Number(n[counter]).toLocaleString("en"),
  value: (n) => n[counter],
});

const MESSAGES: Column<NodeState>[] = [
  name,
  count("received", "received"),
  count("published", "published"),
  count("sent again", "retries"),
  count("repeated", "duplicates"),
  count("rejected", "rejected"),
  count("lost", "lost"),
  count("dropped by the system", "dropped"),
  count("waiting for ACK", "unacknowledged"),
  count("to read", "queued"),
  count("to acknowledge", "owed"),
  count("computing", "computing"),
  { heading: "journal", csv: "journal_bytes", show: (n) => bytes(n.journal_bytes), value: (n) => n.journal_bytes },
];

/** Two tables, so that each fits a window. */
export function Nodes({ live }: { live: Live }) {
  const empty = "No node speaks: this run does not play.";
  const common = { rows: live.nodes, rowKey: (n: NodeState) => n.node, empty };
  return (
    <section class="panel">
      <Table name="nodes" caption="Nodes" columns={WORK} {...common} />
      {live.nodes.length > 0 && <Table name="messages" caption="Messages" columns={MESSAGES} {...common} />}
    </section>
  );
}
