// The game: gamut and fronts by round, one design at a time, and hypervolume, gap and errors by round.

import { useMemo, useState } from "preact/hooks";
import type { Measured, Rounds } from "./api";
import { BrushBox } from "./brush_box";
import { BrushPanel, useBrush } from "./brush_panel";
import { chosenInGame } from "./chosen";
import { roundColour, themeColour } from "./colour";
import { DesignPanel, FirstFracture, NewestProposals, showDesignPanel } from "./design_panel";
import type { Gamut } from "./gamut";
import { GamutChart, type Layers } from "./gamut_chart";
import { RoundNotes } from "./notes";
import { figure, GPA, MPA, percent, withError } from "./numbers";
import { WorthOfNext } from "./next_round";
import { NoSuchRound, Problem, Table } from "./parts";
import { useGamuts } from "./reading";
import { addressOf, type Looking } from "./route";
import { lastProposing, newestModel } from "./rounds";
import { closedRounds, CSV, FIGURES, pointsOf, type FigureName } from "./run_figures";
import { ShortlistPanel } from "./shortlist_panel";
import { AREA, TERMS } from "./terms";
import { TrendChart } from "./trend_chart";

function Trends({ rounds, theme, isOver }: { rounds: Rounds; theme: string; isOver: boolean }) {
  const closed = useMemo(() => closedRounds(rounds), [rounds]);
  const numbers = useMemo(() => closed.map((r) => r.round), [closed]);
  const unmeasured = isOver
    ? "No proposed design was measured in this game."
    : "Known once proposed designs have been measured.";
  const trends = useMemo(() => {
    const [sim, meas, homo] = ["sim", "meas", "homo"].map(themeColour);
    return {
      hypervolume: [
        {
          name: "predicted",
          csv: CSV.predictedHypervolume,
          colour: sim,
          points: pointsOf(closed, "predictedHypervolume"),
        },
        {
          name: "measured",
          csv: CSV.measuredHypervolume,
          colour: meas,
          points: pointsOf(closed, "measuredHypervolume", "hypervolumeError"),
          csvOfError: CSV.hypervolumeError,
        },
      ],
      gap: [{ name: "gap", csv: CSV.gap, colour: homo, points: pointsOf(closed, "gap") }],
      errors: [
        {
          name: TERMS.modulusError.heading,
          csv: CSV.modulusError,
          colour: sim,
          points: pointsOf(closed, "modulusError"),
        },
        {
          name: TERMS.toughnessError.heading,
          csv: CSV.toughnessError,
          colour: meas,
          points: pointsOf(closed, "toughnessError"),
        },
        {
          name: TERMS.toughnessFit.heading,
          csv: CSV.toughnessFit,
          colour: meas,
          dashed: true,
          points: pointsOf(closed, "toughnessFit").map((p) => (p.round > 0 ? p : { ...p, value: null })),
        },
      ],
    };
  }, [closed, theme]);
  return (
    <div class="trends">
      <TrendChart
        title="Hypervolume"
        hint="Area under a Pareto front, down to E = T = 0: how good the best designs are."
        empty="There is no gamut yet."
        name="hypervolume"
        unit={AREA}
        rounds={numbers}
        trends={trends.hypervolume}
      />
      <TrendChart
        title="Gap to the laboratory"
        hint={TERMS.gap.hint}
        empty={unmeasured}
        name="gap"
        unit={AREA}
        rounds={numbers}
        trends={trends.gap}
      />
      <TrendChart
        title="Errors of the model"
        hint="Of designs that were predicted before they were measured, and of designs that the model was fitted to."
        empty={unmeasured}
        name="errors"
        unit="%"
        rounds={numbers}
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

/** The rounds that an address names; until it does, that of the newest gamut: the rounds before it would hide it. */
function roundsShown(round: string | undefined, { rounds }: Rounds): Set<number> {
  if (round) return new Set(round === NONE ? [] : round.split(",").map(Number));
  const newest = rounds.filter((r) => r.gamut_count > 0).at(-1);
  return new Set(newest ? [newest.round] : []);
}

/** How an address says that no round is shown. */
const NONE = "none";

export function Game({
  rounds,
  data,
  theme,
  playing,
  isOver,
  looking: { at, look },
}: {
  rounds: Rounds;
  playing: boolean;
  isOver: boolean;
  data: string | null;
  theme: "light" | "dark";
  looking: Looking;
}) {
  const shown = useMemo(() => roundsShown(at.round, rounds), [at.round, rounds]);
  const setShown = (next: Set<number>) => look({ ...at, round: [...next].sort((a, b) => a - b).join() || NONE });
  const choose = ({ design, model }: { design: string; model: number | string }) =>
    look({ ...at, design, model: String(model) });
  const [layers, setLayers] = useState<Layers>({
    cloud: true,
    fronts: true,
    proposals: true,
    measured: true,
    mixtures: true,
  });
  const wanted = rounds.rounds
    .filter((r) => shown.has(r.round))
    .map((r) => ({ name: String(r.round), count: r.gamut_count, which: { round: r.round } }));
  const { gamuts, problem } = useGamuts(wanted);
  const chosen = useMemo(() => chosenInGame(at, rounds, gamuts), [at.design, at.model, rounds, gamuts]);
  const visible = [...shown].map((round) => gamuts.get(String(round))).filter((g): g is Gamut => g !== undefined);
  const brushing = useBrush(rounds, visible, data);
  const unknown = data === null ? [] : [...shown].filter((n) => !rounds.rounds.some((r) => r.round === n));
  if (unknown.length > 0)
    return (
      <NoSuchRound rounds={rounds.rounds.map((r) => r.round)} wanted={at.round!} link={addressOf("game")} />
    );
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
              <Toggles rounds={rounds} shown={shown} setShown={setShown} layers={layers} setLayers={setLayers} />
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
              choose={choose}
              theme={theme}
              picked={brushing.chosen}
              over={(chart) =>
                brushing.choice.isOpen && (
                  <BrushBox
                    chart={chart}
                    box={brushing.brush}
                    isDrawing={brushing.choice.isDrawing}
                    draw={brushing.draw}
                  />
                )
              }
            />
            <BrushPanel brushing={brushing} />
          </section>
          <Trends rounds={rounds} theme={theme} isOver={isOver} />
        </div>
        <DesignPanel chosen={chosen} data={data}>
          {beginning ? (
            <FirstFracture data={data} />
          ) : (
            <NewestProposals round={lastProposing(rounds)} choose={choose} />
          )}
        </DesignPanel>
      </div>
      <ShortlistPanel
        data={data}
        choose={(design) => {
          choose({ design, model: newestModel(rounds) });
          showDesignPanel();
        }}
      />
      <section class="panel">
        <WorthOfNext rounds={rounds} />
        <RoundTable rounds={rounds} />
        {rounds.rounds.length > 0 && <RoundNotes rounds={rounds.rounds.map((r) => r.round)} />}
      </section>
      <section class="panel">
        <MeasuredTable
          measured={rounds.measured}
          isOver={isOver}
          choose={(m) => choose({ design: m.design, model: newestModel(rounds) })}
        />
      </section>
    </>
  );
}

function RoundTable({ rounds }: { rounds: Rounds }) {
  const closed = closedRounds(rounds);
  const figureOf = (name: FigureName) => ({ csv: CSV[name], value: FIGURES[name] });
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
          ...figureOf("predictedHypervolume"),
          show: (r) => figure(FIGURES.predictedHypervolume(r)),
        },
        {
          ...TERMS.measuredHypervolume,
          ...figureOf("measuredHypervolume"),
          show: (r) => withError(FIGURES.measuredHypervolume(r) ?? NaN, r.summary.hypervolume_error),
        },
        { heading: CSV.hypervolumeError, value: FIGURES.hypervolumeError },
        { ...TERMS.gap, ...figureOf("gap"), show: (r) => figure(FIGURES.gap(r)) },
        { ...TERMS.modulusError, ...figureOf("modulusError"), show: (r) => percent(FIGURES.modulusError(r)) },
        { ...TERMS.toughnessError, ...figureOf("toughnessError"), show: (r) => percent(FIGURES.toughnessError(r)) },
        { ...TERMS.toughnessRank, ...figureOf("toughnessRank"), show: (r) => figure(FIGURES.toughnessRank(r), 2) },
        { ...TERMS.modulusFit, ...figureOf("modulusFit"), show: (r) => percent(FIGURES.modulusFit(r)) },
        { ...TERMS.toughnessFit, ...figureOf("toughnessFit"), show: (r) => percent(FIGURES.toughnessFit(r)) },
        {
          ...TERMS.equilibrium,
          csv: "decided_by",
          words: true,
          show: (r) => `${r.summary.equilibrium ? "yes" : "no"}: ${r.summary.decided_by}`,
          value: (r) => r.summary.decided_by,
        },
      ]}
    />
  );
}

function MeasuredTable({
  measured,
  isOver,
  choose,
}: {
  measured: Measured[];
  isOver: boolean;
  choose: (m: Measured) => void;
}) {
  const sorted = [...measured].sort((a, b) => b.toughness_pa - a.toughness_pa);
  return (
    <Table
      name="measured"
      caption="Measured patterns"
      rows={sorted}
      rowKey={(m) => m.design}
      empty={`No pattern ${isOver ? "was" : "has been"} measured in both tests${isOver ? "" : " yet"}.`}
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
        {
          ...TERMS.specimens,
          show: (m) => `${m.modulus_count} for E, ${m.toughness_count} for T`,
          order: (m) => m.modulus_count + m.toughness_count,
        },
        { heading: "modulus_count", value: (m) => m.modulus_count },
        { heading: "toughness_count", value: (m) => m.toughness_count },
      ]}
    />
  );
}
