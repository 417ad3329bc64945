// The game: gamut and fronts by round, one design at a time, and hypervolume, gap and errors by round.

import { useMemo, useState } from "preact/hooks";
import type { Errors, Measured, Rounds } from "./api";
import { axis, basis, ChartBox, type Option } from "./chart";
import { roundColour, themeColour } from "./colour";
import { DesignPanel, FirstFracture, NewestProposals, showDesignPanel, type Chosen } from "./design_panel";
import type { Gamut } from "./gamut";
import { GamutChart, type Layers } from "./gamut_chart";
import { figure, GPA, MPA, percent, tick, withError } from "./numbers";
import { Problem, Table } from "./parts";
import { useGamuts } from "./reading";
import { lastProposing, newestModel } from "./rounds";
import { AREA, TERMS } from "./terms";

/** A line over rounds: its name on the screen and in the file, a colour, and a value per round. */
interface Trend {
  name: string;
  csv: string;
  colour: string;
  dashed?: boolean;
  value: (round: Rounds["rounds"][number]) => number | null | undefined;
  error?: (round: Rounds["rounds"][number]) => number | null;
  csvOfError?: string;
}

function TrendChart({
  title,
  name,
  unit,
  rounds,
  trends,
  hint,
  empty,
  logarithmic,
}: {
  title: string;
  /** What the values mean, as a tooltip. */
  hint: string;
  /** Why there is no value, where there is none. */
  empty: string;
  name: string;
  unit: string;
  rounds: Rounds;
  trends: Trend[];
  logarithmic?: boolean;
}) {
  const closed = rounds.rounds.filter((r) => r.summary);
  const option = useMemo<Option>(
    () => ({
      ...basis({ grid: { left: 52, right: 14, top: 12, bottom: 40 } }),
      xAxis: axis("round", { min: 0, max: Math.max(1, closed.length - 1), minInterval: 1, nameGap: 24 }),
      // Errors of the first rounds are many times those of the last.
      yAxis: axis(unit, {
        ...(logarithmic ? { type: "log", logBase: 10 } : { min: 0 }),
        nameGap: 38,
        axisLabel: {
          color: themeColour("quiet"),
          fontSize: 11,
          formatter: (v: number) => tick(logarithmic ? 100 * v : v),
        },
      }),
      series: trends.flatMap((trend) => {
        const points = closed
          .map((r) => [r.round, trend.value(r)])
          .filter(([, v]) => v !== null && v !== undefined && (!logarithmic || v > 0));
        const bars = trend.error
          ? closed
              .filter((r) => trend.value(r))
              .map((r) => [
                [r.round, trend.value(r)! - trend.error!(r)!],
                [r.round, trend.value(r)! + trend.error!(r)!],
              ])
          : [];
        return [
          {
            type: "line",
            name: trend.name,
            data: points,
            symbol: "circle",
            symbolSize: 7,
            itemStyle: { color: trend.colour },
            lineStyle: { color: trend.colour, width: 2, type: trend.dashed ? "dashed" : "solid" },
          },
          ...bars.map((ends) => ({
            type: "line",
            data: ends,
            symbol: "none",
            silent: true,
            lineStyle: { color: trend.colour, width: 1.2, opacity: 0.7 },
          })),
        ];
      }),
    }),
    [rounds, trends],
  );
  return (
    <section class="panel trend">
      <h3>
        <span class="term" title={hint}>
          {title}
        </span>
      </h3>
      <ul class="keys">
        {trends.map((t) => (
          <li key={t.name}>
            <span class={t.dashed ? "line dashed" : "line"} style={{ color: t.colour }} />
            {t.name}
          </li>
        ))}
      </ul>
      {closed.length === 0 ? (
        <p class="awaited">No round is complete yet.</p>
      ) : (
        <ChartBox
          name={name}
          label={`${title} by round`}
          empty={empty}
          option={option}
          height={190}
          table={() => ({
            heading: ["round", ...trends.flatMap((t) => (t.csvOfError ? [t.csv, t.csvOfError] : [t.csv]))],
            rows: closed.map((r) => [
              r.round,
              ...trends.flatMap((t) => (t.error ? [t.value(r), t.error(r)] : [t.value(r)])),
            ]),
          })}
        />
      )}
    </section>
  );
}

/** Names of columns in the files, the same wherever they are written. */
const CSV = {
  gamut: "gamut_hypervolume_gpa_mpa",
  measured: "measured_hypervolume_gpa_mpa",
  hypervolumeError: "hypervolume_error_gpa_mpa",
  gap: "gap_gpa_mpa",
  predictionE: "modulus_error_held_out",
  predictionT: "toughness_error_held_out",
  afterE: "modulus_error_after",
  afterT: "toughness_error_after",
};

/** The value; null in a round before anything was measured. */
const ofMeasured = (r: Rounds["rounds"][number], value: number) =>
  r.summary!.measured_hypervolume_staircase > 0 ? value : null;

const someE = (e: Errors | null) => (e && e.n_modulus > 0 ? e.modulus_mean : null);
const someT = (e: Errors | null) => (e && e.n_toughness > 0 ? e.toughness_mean : null);

/** Rank correlation, from three designs on: of two it means nothing. */
const rankT = (e: Errors | null) => (e && e.n_toughness >= 3 ? e.toughness_spearman : null);

function Trends({ rounds, theme }: { rounds: Rounds; theme: string }) {
  const trends = useMemo(() => {
    const [sim, meas, homo] = ["sim", "meas", "homo"].map(themeColour);
    return {
      hypervolume: [
        { name: "predicted", csv: CSV.gamut, colour: sim, value: (r) => r.summary!.gamut_hypervolume_staircase },
        {
          name: "measured",
          csv: CSV.measured,
          colour: meas,
          value: (r) => ofMeasured(r, r.summary!.measured_hypervolume_staircase),
          error: (r) => ofMeasured(r, r.summary!.hypervolume_error),
          csvOfError: CSV.hypervolumeError,
        },
      ] as Trend[],
      gap: [{ name: "gap", csv: CSV.gap, colour: homo, value: (r) => ofMeasured(r, r.summary!.gap) }] as Trend[],
      errors: [
        {
          name: TERMS.modulusError.heading,
          csv: CSV.predictionE,
          colour: sim,
          value: (r) => someE(r.summary!.held_out),
        },
        {
          name: TERMS.toughnessError.heading,
          csv: CSV.predictionT,
          colour: meas,
          value: (r) => someT(r.summary!.held_out),
        },
        {
          name: TERMS.toughnessFit.heading,
          csv: CSV.afterT,
          colour: meas,
          dashed: true,
          value: (r) => (r.round > 0 ? someT(r.summary!.after) : null),
        },
      ] as Trend[],
    };
  }, [theme]);
  return (
    <div class="trends">
      <TrendChart
        title="Hypervolume"
        hint="Area under a Pareto front, down to E = T = 0: how good the best designs are."
        empty="There is no gamut yet."
        name="hypervolume"
        unit={AREA}
        rounds={rounds}
        trends={trends.hypervolume}
      />
      <TrendChart
        title="Gap to the laboratory"
        hint={TERMS.gap.hint}
        empty="Known once proposed designs have been measured."
        name="gap"
        unit={AREA}
        rounds={rounds}
        trends={trends.gap}
      />
      <TrendChart
        title="Errors of the model"
        hint="Of designs that were predicted before they were measured, and of designs that the model was fitted to."
        empty="Known once proposed designs have been measured."
        name="errors"
        unit="%"
        rounds={rounds}
        trends={trends.errors}
        logarithmic
      />
    </div>
  );
}

const LAYERS: Record<keyof Layers, { label: string; hint: string }> = {
  cloud: { label: "simulated", hint: "every simulated pattern of the gamut" },
  fronts: { label: "fronts", hint: "Pareto fronts: no other pattern is both stiffer and tougher" },
  proposals: { label: "proposals", hint: "designs that the round proposes to measure, as predicted" },
  measured: { label: "measured", hint: "means of measured designs, with their standard deviation" },
  mixtures: { label: "mixtures", hint: "both materials mixed at random, without a pattern" },
};

/** Why the chart of the gamut has no point. */
function whyEmpty(rounds: Rounds, wanted: unknown[], visible: Gamut[]): string {
  if (rounds.rounds.every((r) => r.gamut_count === 0))
    return "No pattern has been simulated yet. Points appear here as the search goes on.";
  if (wanted.length === 0) return "No round is shown: choose one above.";
  return visible.length === 0 ? "reading the gamut …" : "Everything is switched off: choose what to show above.";
}

/** Rounds and layers that are shown, as toggles; the rounds carry their colour. */
function Toggles({
  rounds,
  shown,
  setShown,
  layers,
  setLayers,
}: {
  rounds: Rounds;
  shown: Set<number>;
  setShown: (s: Set<number>) => void;
  layers: Layers;
  setLayers: (l: Layers) => void;
}) {
  const newest = Math.max(0, ...rounds.rounds.map((r) => r.round));
  const flip = (round: number) => {
    const next = new Set(shown);
    if (!next.delete(round)) next.add(round);
    setShown(next);
  };
  return (
    <div class="toggles">
      {rounds.rounds.length > 0 && (
        <fieldset>
          <legend>rounds</legend>
          {rounds.rounds.map((r) => (
            <label key={r.round} class="toggle" style={{ "--c": roundColour("sim", r.round, newest) } as never}>
              <input type="checkbox" checked={shown.has(r.round)} onChange={() => flip(r.round)} />
              <span>{r.round}</span>
            </label>
          ))}
        </fieldset>
      )}
      <fieldset>
        <legend>show</legend>
        {(Object.keys(layers) as (keyof Layers)[]).map((layer) => (
          <label
            key={layer}
            class="toggle"
            title={LAYERS[layer].hint}
            style={
              { "--c": `var(--${layer === "measured" ? "meas" : layer === "mixtures" ? "homo" : "sim"})` } as never
            }
          >
            <input
              type="checkbox"
              checked={layers[layer]}
              onChange={() => setLayers({ ...layers, [layer]: !layers[layer] })}
            />
            <span>{LAYERS[layer].label}</span>
          </label>
        ))}
      </fieldset>
    </div>
  );
}

export function Game({
  rounds,
  data,
  theme,
  playing,
}: {
  rounds: Rounds;
  playing: boolean;
  data: string | null;
  theme: "light" | "dark";
}) {
  const [picked, setPicked] = useState<Set<number> | null>(null);
  // Until somebody picks, the newest gamut: the rounds before it would hide it.
  const shown = useMemo(
    () =>
      picked ??
      new Set(
        rounds.rounds
          .filter((r) => r.gamut_count > 0)
          .slice(-1)
          .map((r) => r.round),
      ),
    [picked, rounds],
  );
  const [layers, setLayers] = useState<Layers>({
    cloud: true,
    fronts: true,
    proposals: true,
    measured: true,
    mixtures: true,
  });
  const [chosen, setChosen] = useState<Chosen | null>(null);
  const wanted = rounds.rounds
    .filter((r) => shown.has(r.round))
    .map((r) => ({ name: String(r.round), count: r.gamut_count, which: { round: r.round } }));
  const { gamuts, problem } = useGamuts(wanted);
  const visible = [...shown].map((round) => gamuts.get(String(round))).filter((g): g is Gamut => g !== undefined);
  const beginning = lastProposing(rounds) === null;
  const newest = rounds.rounds.at(-1);
  const searched = playing && newest && newest.gamut_count > 0 && newest.proposals.length === 0 ? newest : null;
  return (
    <>
      <div class="split">
        <div class="stack">
          <section class="panel gamut">
            <div class="panel-head">
              <h2>Gamut</h2>
              <Toggles rounds={rounds} shown={shown} setShown={setPicked} layers={layers} setLayers={setLayers} />
            </div>
            <p class="quiet">
              A point is a pattern: how stiff (E) and how tough (T). A staircase is a Pareto front: no other pattern is
              both stiffer and tougher.
              {searched && ` The search goes on: ${searched.gamut_count} patterns so far.`}
            </p>
            <Problem text={problem} />
            <GamutChart
              rounds={rounds}
              gamuts={visible}
              empty={whyEmpty(rounds, wanted, visible)}
              layers={layers}
              chosen={chosen}
              choose={setChosen}
              theme={theme}
            />
          </section>
          <Trends rounds={rounds} theme={theme} />
        </div>
        <DesignPanel chosen={chosen} data={data}>
          {beginning ? (
            <FirstFracture data={data} />
          ) : (
            <NewestProposals round={lastProposing(rounds)} choose={setChosen} />
          )}
        </DesignPanel>
      </div>
      <section class="panel">
        <RoundTable rounds={rounds} />
      </section>
      <section class="panel">
        <MeasuredTable
          measured={rounds.measured}
          choose={(m) =>
            setChosen({
              design: m.design,
              model: newestModel(rounds),
              modulus: m.modulus_pa,
              toughness: m.toughness_pa,
              of: `measured in round ${m.round}`,
            })
          }
        />
      </section>
    </>
  );
}

function RoundTable({ rounds }: { rounds: Rounds }) {
  const closed = rounds.rounds.filter((r) => r.summary);
  return (
    <Table
      name="rounds"
      caption="Rounds"
      rows={closed}
      rowKey={(r) => String(r.round)}
      empty="No round is complete yet."
      columns={[
        { ...TERMS.round, show: (r) => r.round, value: (r) => r.round },
        {
          ...TERMS.predictedHypervolume,
          csv: CSV.gamut,
          show: (r) => figure(r.summary!.gamut_hypervolume_staircase),
          value: (r) => r.summary!.gamut_hypervolume_staircase,
        },
        {
          ...TERMS.measuredHypervolume,
          csv: CSV.measured,
          show: ({ summary }) =>
            summary!.measured_hypervolume_staircase > 0
              ? withError(summary!.measured_hypervolume_staircase, summary!.hypervolume_error)
              : "–",
          value: (r) => ofMeasured(r, r.summary!.measured_hypervolume_staircase),
        },
        { heading: CSV.hypervolumeError, value: (r) => ofMeasured(r, r.summary!.hypervolume_error) },
        {
          ...TERMS.gap,
          csv: CSV.gap,
          show: (r) => figure(ofMeasured(r, r.summary!.gap)),
          value: (r) => ofMeasured(r, r.summary!.gap),
        },
        {
          ...TERMS.modulusError,
          csv: CSV.predictionE,
          show: (r) => percent(someE(r.summary!.held_out)),
          value: (r) => someE(r.summary!.held_out),
        },
        {
          ...TERMS.toughnessError,
          csv: CSV.predictionT,
          show: (r) => percent(someT(r.summary!.held_out)),
          value: (r) => someT(r.summary!.held_out),
        },
        {
          ...TERMS.toughnessRank,
          csv: "toughness_spearman_held_out",
          show: (r) => figure(rankT(r.summary!.held_out), 2),
          value: (r) => rankT(r.summary!.held_out),
        },
        {
          ...TERMS.modulusFit,
          csv: CSV.afterE,
          show: (r) => percent(someE(r.summary!.after)),
          value: (r) => someE(r.summary!.after),
        },
        {
          ...TERMS.toughnessFit,
          csv: CSV.afterT,
          show: (r) => percent(someT(r.summary!.after)),
          value: (r) => someT(r.summary!.after),
        },
        {
          ...TERMS.equilibrium,
          csv: "decided_by",
          words: true,
          show: (r) => `${r.summary!.equilibrium ? "yes" : "no"}: ${r.summary!.decided_by}`,
          value: (r) => r.summary!.decided_by,
        },
      ]}
    />
  );
}

function MeasuredTable({ measured, choose }: { measured: Measured[]; choose: (m: Measured) => void }) {
  const sorted = [...measured].sort((a, b) => b.toughness_pa - a.toughness_pa);
  return (
    <Table
      name="measured"
      caption="Measured patterns"
      rows={sorted}
      rowKey={(m) => m.design}
      empty="No pattern has been measured in both tests yet."
      columns={[
        {
          ...TERMS.design,
          words: true,
          show: (m) => (
            <button
              type="button"
              class="link"
              onClick={() => {
                choose(m);
                showDesignPanel();
              }}
            >
              <code class="key">{m.design}</code>
            </button>
          ),
          value: (m) => m.design,
        },
        { ...TERMS.round, show: (m) => m.round, value: (m) => m.round },
        {
          ...TERMS.rigid,
          csv: "rigid_fraction",
          show: (m) => percent(m.rigid_fraction, 0),
          value: (m) => m.rigid_fraction,
        },
        {
          ...TERMS.modulus,
          csv: "modulus_pa",
          show: (m) => withError(m.modulus_pa * GPA, m.modulus_sd_pa * GPA),
          value: (m) => m.modulus_pa,
        },
        { heading: "modulus_sd_pa", value: (m) => m.modulus_sd_pa },
        {
          ...TERMS.toughness,
          csv: "toughness_pa",
          show: (m) => withError(m.toughness_pa * MPA, m.toughness_sd_pa * MPA),
          value: (m) => m.toughness_pa,
        },
        { heading: "toughness_sd_pa", value: (m) => m.toughness_sd_pa },
        { ...TERMS.specimens, show: (m) => `${m.modulus_count} for E, ${m.toughness_count} for T` },
        { heading: "modulus_count", value: (m) => m.modulus_count },
        { heading: "toughness_count", value: (m) => m.toughness_count },
      ]}
    />
  );
}
