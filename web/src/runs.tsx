// Several runs beside each other: a list, and their fronts, gaps and errors in one picture each.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { get, problemOf, type ListedRun, type Rounds } from "./api";
import { axis, basis, ChartBox, type Option } from "./chart";
import { themeColour } from "./colour";
import { staircase } from "./gamut";
import { figure, GPA, MPA, withError } from "./numbers";
import { Problem, Table } from "./parts";
import { addressOf } from "./route";
import { closedRounds, CSV, pointsOf, type ClosedRound, type FigureName } from "./run_figures";
import { AREA, TERMS } from "./terms";
import { TrendChart } from "./trend_chart";

/** Looks of a run in every picture, by its place in the list; colours are --run-1 to --run-8 of the page. */
const SYMBOLS = ["circle", "rect", "triangle", "diamond"];
const variableOf = (place: number) => `run-${place + 1}`;
const looksOf = (place: number) => ({
  colour: themeColour(variableOf(place)),
  symbol: SYMBOLS[place % SYMBOLS.length],
  dashed: place >= SYMBOLS.length,
});

/** The run's mark, as the pictures have it. */
function Mark({ place }: { place: number }) {
  const style = { "--c": `var(--${variableOf(place)})` } as never;
  return <i class={`mark ${looksOf(place).symbol}`} style={style} aria-hidden="true" />;
}

/** A run that can be read, its place in the list, and its rounds. */
interface Compared {
  name: string;
  place: number;
  closed: ClosedRound[];
}

/** The rounds of the runs by name, read again whenever a run has new data. */
function useRoundsOf(runs: ListedRun[]): { rounds: Map<string, Rounds>; problem: string } {
  const [rounds, setRounds] = useState(new Map<string, Rounds>());
  const [problem, setProblem] = useState("");
  const read = useRef(new Map<string, string>());
  const readable = runs.filter((r) => r.state !== "unreadable");
  useEffect(() => {
    for (const { run, data } of readable) {
      if (read.current.get(run) === data) continue;
      read.current.set(run, data);
      get<Rounds>("/api/rounds", {}, run)
        .then((next) => {
          setRounds((before) => new Map(before).set(run, next));
          setProblem("");
        })
        .catch((error) => {
          read.current.delete(run);
          setProblem(`${run}: ${problemOf(error)}`);
        });
    }
  }, [runs]);
  return { rounds, problem };
}

const STATES: Record<ListedRun["state"], { text: string; chip: string; hint: string }> = {
  playing: { text: "playing", chip: "approved", hint: "Its nodes report." },
  finished: { text: "finished", chip: "printed", hint: "The last round is complete." },
  stopped: { text: "stopped", chip: "", hint: "No node reports; nacre launch --resume goes on with it." },
  unreadable: { text: "cannot be read", chip: "rejected", hint: "See what is wrong." },
};

function RunTable({ runs }: { runs: ListedRun[] }) {
  const rows = runs.map((run, place) => ({ ...run, place }));
  type Row = (typeof rows)[number];
  const isKnown = (r: Row) => r.scenario !== "";
  const problems = {
    heading: "what is wrong",
    words: true,
    show: (r: Row) => <span class="doubt">{r.problem}</span>,
    value: (r: Row) => r.problem,
  };
  return (
    <Table
      name="runs"
      caption="All runs"
      rows={rows}
      rowKey={(r) => String(r.place)}
      empty="There is no run."
      columns={[
        {
          ...TERMS.run,
          words: true,
          show: (r) => (
            <span class="with-unit">
              {r.state !== "unreadable" && <Mark place={r.place} />}
              {r.state === "unreadable" ? r.run : <a href={addressOf("game", {}, r.run)}>{r.run}</a>}
            </span>
          ),
          value: (r) => r.run,
        },
        { ...TERMS.scenario, words: true, show: (r) => r.scenario || "–", value: (r) => r.scenario },
        {
          ...TERMS.fidelity,
          words: true,
          show: (r) => (isKnown(r) ? r.fidelity : "–"),
          value: (r) => (isKnown(r) ? r.fidelity : ""),
        },
        {
          ...TERMS.runState,
          words: true,
          show: (r) => (
            <span class={`chip ${STATES[r.state].chip}`} title={STATES[r.state].hint}>
              {STATES[r.state].text}
            </span>
          ),
          value: (r) => r.state,
        },
        {
          ...TERMS.roundsDone,
          csv: "round",
          show: (r) => (isKnown(r) ? `${r.round ?? "none"} of ${Math.max(r.rounds, r.round ?? 0)}` : "–"),
          value: (r) => r.round,
        },
        { heading: "rounds", value: (r) => (isKnown(r) ? r.rounds : "") },
        {
          ...TERMS.measuredHypervolume,
          csv: CSV.measuredHypervolume,
          show: (r) => withError(r.measured_hypervolume ?? NaN, r.hypervolume_error ?? 0),
          value: (r) => r.measured_hypervolume,
        },
        { heading: CSV.hypervolumeError, value: (r) => r.hypervolume_error },
        { ...TERMS.gap, csv: CSV.gap, show: (r) => figure(r.gap), value: (r) => r.gap },
        ...(rows.some((r) => r.problem) ? [problems] : []),
      ]}
    />
  );
}

/** The measured front of the last complete round that has one; empty: nothing is measured. */
const frontOf = ({ closed }: Compared): [number, number][] =>
  (closed.filter((r) => r.measured_front.length > 0).at(-1)?.measured_front ?? []).map(([e, t]) => [e * GPA, t * MPA]);

function FrontChart({ runs, theme }: { runs: Compared[]; theme: string }) {
  const option = useMemo<Option>(
    () => ({
      ...basis(),
      xAxis: axis("Young's modulus E / GPa", { min: 0 }),
      yAxis: axis("toughness T / MPa", { min: 0, nameGap: 40 }),
      series: runs.flatMap((run) => {
        const { colour, symbol, dashed } = looksOf(run.place);
        const front = frontOf(run);
        const lineStyle = { color: colour, width: 2, type: dashed ? "dashed" : "solid", cap: "square" };
        const itemStyle = { color: colour, borderColor: themeColour("panel"), borderWidth: 1 };
        return [
          { type: "line", data: staircase(front), symbol: "none", silent: true, connectNulls: false, lineStyle, z: 4 },
          { type: "scatter", name: run.name, data: front, symbol, symbolSize: 10, silent: true, itemStyle, z: 5 },
        ];
      }),
    }),
    [runs, theme],
  );
  return (
    <ChartBox
      name="fronts"
      label="Measured Pareto fronts: toughness against Young's modulus"
      empty="No run has measured a pattern in both tests yet."
      option={option}
      height="var(--gamut-height)"
      table={() => ({
        heading: ["run", "modulus_pa", "toughness_pa"],
        rows: runs.flatMap((run) => frontOf(run).map(([e, t]) => [run.name, e / GPA, t / MPA])),
      })}
    />
  );
}

/** "a and b have nothing here yet."; empty: every run has something, or none has. */
function whoLacks(runs: Compared[], has: (run: Compared) => boolean): string {
  const without = runs.filter((run) => !has(run)).map((run) => run.name);
  if (without.length === 0 || without.length === runs.length) return "";
  const names = without.length === 1 ? without[0] : `${without.slice(0, -1).join(", ")} and ${without.at(-1)}`;
  return `${names} ${without.length === 1 ? "has" : "have"} nothing to show here so far.`;
}

const TRENDS: { figure: FigureName; title: string; hint: string; unit: string; logarithmic?: boolean }[] = [
  { figure: "gap", title: "Gap to the laboratory", hint: TERMS.gap.hint, unit: AREA },
  {
    figure: "modulusError",
    title: "Prediction error of E",
    hint: TERMS.modulusError.hint,
    unit: "%",
    logarithmic: true,
  },
  {
    figure: "toughnessError",
    title: "Prediction error of T",
    hint: TERMS.toughnessError.hint,
    unit: "%",
    logarithmic: true,
  },
];

function Trends({ runs, theme }: { runs: Compared[]; theme: string }) {
  const numbers = useMemo(
    () => [...new Set(runs.flatMap((run) => run.closed.map((r) => r.round)))].sort((a, b) => a - b),
    [runs],
  );
  const trends = useMemo(
    () =>
      TRENDS.map(({ figure: which }) =>
        runs.map((run) => ({
          ...looksOf(run.place),
          name: run.name,
          csv: `${CSV[which]}_${run.name}`,
          points: pointsOf(run.closed, which),
        })),
      ),
    [runs, theme],
  );
  return (
    <div class="trends">
      {TRENDS.map(({ figure: which, ...words }, i) => (
        <TrendChart
          key={which}
          {...words}
          name={which}
          rounds={numbers}
          trends={trends[i]}
          empty="No proposed design has been measured in any run yet."
          note={whoLacks(runs, (run) => pointsOf(run.closed, which).some((p) => p.value !== null))}
          keys={false}
        />
      ))}
    </div>
  );
}

/** Which run has which colour; switches it off and on. */
function Legend({ runs, hidden, flip }: { runs: Compared[]; hidden: Set<string>; flip: (name: string) => void }) {
  return (
    <fieldset class="run-keys">
      <legend>show</legend>
      {runs.map((run) => (
        <label key={run.name} class="toggle run">
          <input type="checkbox" checked={!hidden.has(run.name)} onChange={() => flip(run.name)} />
          <span>
            <Mark place={run.place} /> {run.name}
          </span>
        </label>
      ))}
    </fieldset>
  );
}

export function RunsView({ runs, theme }: { runs: ListedRun[]; theme: "light" | "dark" }) {
  const { rounds, problem } = useRoundsOf(runs);
  const [hidden, setHidden] = useState<Set<string>>(new Set());
  const all = useMemo(
    () =>
      runs.flatMap((run, place): Compared[] => {
        const known = run.state === "unreadable" ? undefined : rounds.get(run.run);
        return known ? [{ name: run.run, place, closed: closedRounds(known) }] : [];
      }),
    [runs, rounds],
  );
  const shown = useMemo(() => all.filter((run) => !hidden.has(run.name)), [all, hidden]);
  const flip = (name: string) => {
    const next = new Set(hidden);
    if (!next.delete(name)) next.add(name);
    setHidden(next);
  };
  const fidelities = new Set(runs.filter((r) => r.state !== "unreadable").map((r) => r.fidelity));
  return (
    <>
      <section class="panel">
        <RunTable runs={runs} />
      </section>
      <Problem text={problem} />
      {fidelities.has("tiny") && (
        <p class="awaited">Tiny specimens, for trying things out: their numbers mean nothing.</p>
      )}
      {fidelities.size > 1 && (
        <p class="doubt">These runs differ in fidelity: their E, T and hypervolumes cannot be compared.</p>
      )}
      <Legend runs={all} hidden={hidden} flip={flip} />
      <section class="panel">
        <h2>Measured fronts</h2>
        <p class="quiet">
          A mark is a measured pattern that no other of its run beats in both E and T, as of the last complete round.
        </p>
        {shown.length === 0 ? (
          <p class="awaited">
            {all.length === 0 ? "reading the runs …" : "Every run is switched off: choose one above."}
          </p>
        ) : (
          <>
            <FrontChart runs={shown} theme={theme} />
            <p class="quiet">{whoLacks(shown, (run) => frontOf(run).length > 0)}</p>
          </>
        )}
      </section>
      {shown.length > 0 && <Trends runs={shown} theme={theme} />}
    </>
  );
}
