// The nodes of a run: in short above every view, in full in a view of their own.

import type { Live, NodeState } from "./api";
import { bytes, duration, words } from "./numbers";
import { Bar, Table, type Column } from "./parts";
import { addressOf } from "./route";
import { toApprove } from "./status";

const nameOf = (node: string) => (node === "virtual_lab" ? "virtual laboratory" : words(node));

/** What a node is doing; where designs wait for a person, a link to where they are approved. */
function Phase({ node }: { node: NodeState }) {
  if (toApprove(node) === 0) return <>{node.phase || "\u00a0"}</>;
  return <a href={addressOf("laboratory")}>{node.phase}</a>;
}

export function NodeStrip({ live }: { live: Live }) {
  return (
    <ul class="nodes" aria-label="nodes">
      {live.nodes.map((n) => (
        <li key={n.node} class={n.state} title={n.last_problem || n.work || undefined}>
          <div>
            <span class={`dot ${n.last_problem ? "problem" : n.state}`} aria-hidden="true" />
            <strong>{nameOf(n.node)}</strong>
            <span class="quiet">
              {n.state === "running" ? (n.eta_s !== null && n.eta_s > 0 ? `${duration(n.eta_s)} left` : "") : n.state}
            </span>
          </div>
          <p class="phase" title={n.phase || undefined}>
            <Phase node={n} />
          </p>
          <Bar
            share={n.state === "finished" || n.state === "ended" ? 1 : n.progress}
            label={`progress of the ${nameOf(n.node)}`}
          />
        </li>
      ))}
    </ul>
  );
}

const name: Column<NodeState> = {
  heading: "node",
  hint: "A process with one task.",
  words: true,
  show: (n) => nameOf(n.node),
  value: (n) => n.node,
};

const CHIPS: Record<string, string> = { silent: "rejected", finished: "approved" };

const STATES: Record<NodeState["state"], string> = {
  starting: "Has started, is not ready yet.",
  running: "Does its part of the game.",
  finished: "Has nothing left to do in this run.",
  ended: "Is silent, and the last round is complete.",
  silent: "Has not reported for some seconds, and the game is not over: see its log in the run's folder.",
};

const WORK: Column<NodeState>[] = [
  name,
  {
    heading: "state",
    hint: "starting, running, finished, ended or silent",
    words: true,
    show: (n) => (
      <span class={`chip ${CHIPS[n.state] ?? ""}`} title={STATES[n.state]}>
        {n.state}
      </span>
    ),
    value: (n) => n.state,
  },
  { heading: "round", hint: "The round that it works on.", show: (n) => n.round, value: (n) => n.round },
  { heading: "doing", csv: "phase", words: true, show: (n) => <Phase node={n} />, value: (n) => n.phase },
  {
    heading: "progress",
    hint: "Of what it is doing now.",
    show: (n) => (n.progress === null ? "–" : `${Math.round(100 * n.progress)} %`),
    value: (n) => n.progress,
  },
  {
    heading: "time left",
    hint: "For what it is doing now.",
    csv: "eta_s",
    show: (n) => (n.eta_s === null ? "–" : duration(n.eta_s)),
    value: (n) => n.eta_s,
  },
  { heading: "work", value: (n) => n.work },
  {
    heading: "details, last problem",
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

const count = (heading: string, counter: keyof NodeState, hint: string): Column<NodeState> => ({
  heading,
  hint,
  csv: counter,
  show: (n) => Number(n[counter]).toLocaleString("en"),
  value: (n) => n[counter],
});

const MESSAGES: Column<NodeState>[] = [
  name,
  count("received", "received", "Messages taken as input."),
  count("published", "published", "Messages sent."),
  count("sent again", "retries", "Messages repeated, since a receiver had not acknowledged them."),
  count("duplicates", "duplicates", "Messages received again, and ignored."),
  count("rejected", "rejected", "Messages that were corrupt, foreign or out of range."),
  count("lost", "lost", "Gaps in the numbering of other nodes' messages; what counts is sent again."),
  count("dropped", "dropped", "Datagrams that the system dropped because its buffer was full."),
  count("unacknowledged", "unacknowledged", "Own messages that a receiver has not acknowledged yet."),
  count("unread", "queued", "Datagrams taken from the system and not handled yet."),
  count("to acknowledge", "owed", "Messages of others that it has not acknowledged yet."),
  count("computing", "computing", "Long computations that are running."),
  {
    heading: "journal",
    hint: "Size of the file that keeps all its messages.",
    csv: "journal_bytes",
    show: (n) => bytes(n.journal_bytes),
    value: (n) => n.journal_bytes,
  },
];

/** Two tables, so that each fits a window. */
export function NodesView({ live }: { live: Live }) {
  const empty = "No node reports: the game is not running.";
  const common = { rows: live.nodes, rowKey: (n: NodeState) => n.node, empty };
  return (
    <section class="panel">
      <Table name="nodes" caption="Nodes" columns={WORK} {...common} />
      {live.nodes.length > 0 && <Table name="messages" caption="Messages" columns={MESSAGES} {...common} />}
    </section>
  );
}
