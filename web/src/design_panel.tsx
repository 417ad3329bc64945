// One design: pattern, E and T as predicted, simulated and measured, stress-strain curves, and its fracture.

import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useState } from "preact/hooks";
import { address, get, getBytes, post, problemOf, type Design, type Query, type Round, type Simulation } from "./api";
import type { Chosen } from "./chosen";
import { axis, basis, ChartBox, type Option } from "./chart";
import { themeColour } from "./colour";
import { readFilm, type Film } from "./film";
import { FilmPlayer } from "./film_player";
import { Measure } from "./measure";
import { Notes } from "./notes";
import { duration, gpa, MPA, mpa, percent } from "./numbers";
import { Awaited, MaterialKey, Name, Problem, Reason, saveUnit, Unit, UnitButton } from "./parts";
import { useReading } from "./reading";
import type { Listed } from "./shortlist";

const WAIT_MS = 500;

type FilmState = { film?: Film; simulation?: Simulation; problem?: string };

/** The film of a design: from the run, or simulated now. */
function useFilm({ design, model, map }: Pick<Chosen, "design" | "model" | "map">): FilmState {
  const [state, setState] = useState<FilmState>({});
  useEffect(() => {
    setState({});
    let dropped = false;
    let timer = 0;
    const look = async () => {
      const wanted = { design, model: String(model) };
      const origin: Query = map ? { map } : {};
      const query = { ...wanted, ...origin };
      try {
        let simulation = await get<Simulation>("/api/simulation", query);
        if (simulation.state === "absent")
          simulation = await post<Simulation>(address("/api/simulate", origin), wanted);
        if (dropped) return;
        if (simulation.state === "ready") {
          const film = await readFilm(await getBytes("/api/film", query));
          if (!dropped) setState({ film, simulation });
        } else if (simulation.state === "failed") {
          setState({ simulation, problem: simulation.problem });
        } else {
          setState({ simulation });
          timer = window.setTimeout(look, WAIT_MS);
        }
      } catch (error) {
        if (!dropped) setState({ problem: problemOf(error) });
      }
    };
    void look();
    return () => {
      dropped = true;
      clearTimeout(timer);
    };
  }, [design, model, map]);
  return state;
}

function CurveChart({ design, film, frame }: { design: Design | null; film?: Film; frame: number }) {
  const measured = design?.specimens.filter((s) => s.curve && s.test === "toughness" && isStandard(s)) ?? [];
  const simulated = design?.simulated.filter((s) => s.curve) ?? [];
  const points = (c: { strain: number[]; stress_pa: number[] }) =>
    c.strain.map((s, i) => [100 * s, c.stress_pa[i] * MPA]);
  const option = useMemo<Option>(() => {
    const [sim, meas] = [themeColour("sim"), themeColour("meas")];
    const atTheEdge = { show: true, onZero: false, lineStyle: { color: themeColour("rule") } };
    const series: Option[] = measured.map((s) => ({
      type: "line",
      name: s.specimen,
      data: points(s.curve!),
      symbol: "none",
      silent: true,
      lineStyle: { color: meas, width: 1.2, opacity: s.valid ? 0.75 : 0.25, type: s.valid ? "solid" : "dotted" },
    }));
    if (simulated.length > 0)
      series.push({
        type: "line",
        name: `simulated in round ${simulated[simulated.length - 1].round}`,
        data: points(simulated[simulated.length - 1].curve!),
        symbol: "none",
        silent: true,
        lineStyle: { color: sim, width: 1.6, type: "dashed" },
      });
    if (film)
      series.push({
        type: "line",
        name: "this film",
        data: points(film.curve),
        symbol: "none",
        silent: true,
        lineStyle: { color: sim, width: 2 },
      });
    return {
      ...basis({ grid: { left: 48, right: 12, top: 10, bottom: 40 } }),
      // Both hold zero, and go below it where a curve does.
      xAxis: axis("strain / %", { nameGap: 24, axisLine: atTheEdge }),
      yAxis: axis("stress / MPa", { nameGap: 34, axisLine: atTheEdge }),
      series,
    };
  }, [design, film, document.documentElement.dataset.theme]);
  const withMarker = useMemo<Option>(() => {
    const moment = film?.frames[Math.min(frame, film.frames.length - 1)];
    const marker = moment
      ? [
          {
            type: "scatter",
            name: "moment",
            data: [[100 * moment.strain, moment.stress_pa * MPA]],
            symbolSize: 10,
            silent: true,
            z: 9,
            itemStyle: { color: themeColour("panel"), borderColor: themeColour("sim"), borderWidth: 2.5 },
          },
        ]
      : [{ type: "scatter", name: "moment", data: [] }];
    return { ...option, series: [...(option.series as Option[]), ...marker] };
  }, [option, film, frame]);
  if (measured.length === 0 && simulated.length === 0 && !film) return null;
  return (
    <ChartBox
      name={`curves-${design?.design ?? "design"}`}
      label={`Stress-strain curves of ${design?.design ?? "the design"}`}
      empty="There is no curve of this design yet."
      option={withMarker}
      height={190}
      table={() => ({
        heading: ["curve", "strain", "stress_pa"],
        rows: [
          ...measured.map((s) => [s.specimen, s.curve!] as const),
          ...simulated.map((s) => [`simulated ${s.round}`, s.curve!] as const),
          ...(film ? [["film", film.curve] as const] : []),
        ].flatMap(([name, c]) => c.strain.map((s, i) => [name, s, c.stress_pa[i]])),
      })}
      tools={
        <ul class="keys">
          {film && (
            <li>
              <span class="line" style={{ color: "var(--sim)" }} />
              this film
            </li>
          )}
          {simulated.length > 0 && (
            <li>
              <span class="line dashed" style={{ color: "var(--sim)" }} />
              simulated in round {simulated[simulated.length - 1].round}
            </li>
          )}
          {measured.length > 0 && (
            <li>
              <span class="line" style={{ color: "var(--meas)" }} />
              measured ({measured.length})
            </li>
          )}
        </ul>
      }
    />
  );
}

interface Values {
  modulus_pa?: number | null;
  toughness_pa?: number | null;
}

/** The prediction that was made before the design was measured, by the model that is looked at or by the newest one. */
function predictionOf(chosen: Chosen, design: Design | null): Values | undefined {
  const proposals = design?.proposals ?? [];
  const byModel = proposals.find((p) => p.round === chosen.model);
  return byModel ?? (typeof chosen.model === "number" ? proposals.at(-1) : undefined);
}

/** One simulation of the design by the model that is looked at; by the newest model only where that one has none. */
function simulationOf(chosen: Chosen, design: Design | null): Values {
  const byModel = design?.simulated.find((s) => s.round === chosen.model);
  if (byModel) return byModel;
  if (chosen.isSimulated) return { modulus_pa: chosen.modulus, toughness_pa: chosen.toughness };
  return (typeof chosen.model === "number" && design?.simulated.at(-1)) || {};
}

/** Specimens tested faster, thicker or turned do not count for the mean. */
const isStandard = (s: Design["specimens"][number]) => s.orientation_deg === 0 && s.standard !== false;

const HINTS = {
  predicted:
    "Predicted before it was measured. T is a mean of several simulations, each with slightly different parameters.",
  simulated: "One simulation of one specimen: the film, where there is one. Its T differs from the predicted mean.",
  measured: "Mean of the valid specimens, tested upright at the usual rate and thickness.",
};

function ValuesRow({ name, hint, values }: { name: string; hint: string; values: Values }) {
  return (
    <tr>
      <th scope="row">
        <span class="term" title={hint}>
          {name}
        </span>
      </th>
      <td>{gpa(values.modulus_pa)}</td>
      <td>{mpa(values.toughness_pa)}</td>
    </tr>
  );
}

function Facts({ chosen, design, state }: { chosen: Chosen; design: Design | null; state: FilmState }) {
  const counted = design?.specimens.filter((s) => s.valid && isStandard(s)) ?? [];
  const ofTest = (test: string) => counted.filter((s) => s.test === test);
  const [forE, forT] = [ofTest("modulus"), ofTest("toughness")];
  const measured = {
    modulus_pa: mean(forE.map((s) => s.modulus_pa)),
    toughness_pa: mean(forT.map((s) => s.toughness_pa)),
  };
  const prediction = predictionOf(chosen, design);
  const simulated = simulationOf(chosen, design);
  const film = {
    modulus_pa: state.simulation?.modulus_pa ?? simulated.modulus_pa,
    toughness_pa: state.film?.toughness ?? simulated.toughness_pa,
  };
  return (
    <table class="facts">
      <thead>
        <tr>
          <td />
          <th scope="col">E / GPa</th>
          <th scope="col">T / MPa</th>
        </tr>
      </thead>
      <tbody>
        {prediction && <ValuesRow name="predicted mean" hint={HINTS.predicted} values={prediction} />}
        <ValuesRow name={state.film ? "this film" : "one simulation"} hint={HINTS.simulated} values={film} />
        <ValuesRow name="measured mean" hint={HINTS.measured} values={measured} />
        <tr>
          <th scope="row">specimens</th>
          <td>{forE.length}</td>
          <td>{forT.length}</td>
        </tr>
        <tr>
          <th scope="row">rigid share</th>
          <td colSpan={2}>{percent(design?.rigid_fraction)}</td>
        </tr>
      </tbody>
    </table>
  );
}

function mean(values: (number | null)[]): number | null {
  const known = values.filter((v): v is number => v !== null);
  return known.length > 0 ? known.reduce((a, b) => a + b, 0) / known.length : null;
}

/** In place of the film until it is there. */
function FilmWait({ state }: { state: FilmState }) {
  if (state.problem)
    return (
      <p class="notice bad" role="status">
        There is no film: {state.problem}
      </p>
    );
  const s = state.simulation;
  const text = !s
    ? "looking for its film"
    : s.state === "queued"
      ? "waiting for another simulation to end"
      : `being simulated, since the game kept no film of it (${duration(s.working_s ?? 0)})`;
  return (
    <div class="waiting" role="status">
      <span class="spinner" aria-hidden="true" />
      {text}
    </div>
  );
}

const known = (pa: number | null | undefined) => (pa === undefined || Number.isNaN(pa) ? null : pa);

/** As the shortlist has it, with what is known of it. */
function listedOf(chosen: Chosen, design: Design): Listed {
  const values = predictionOf(chosen, design) ?? simulationOf(chosen, design);
  return {
    design: chosen.design,
    of: chosen.of,
    rigid_fraction: design.rigid_fraction,
    modulus_pa: known(values.modulus_pa),
    toughness_pa: known(values.toughness_pa),
  };
}

/** A chosen design, read again whenever the run's `data` change. */
export function DesignBody({ chosen, data }: { chosen: Chosen; data: string | null }) {
  const { value: design, problem } = useReading<Design>("/api/design", { design: chosen.design }, data);
  if (!design) return <Awaited problem={problem && `“${chosen.design}” cannot be shown. ${problem}`} />;
  return <DesignRead chosen={chosen} design={design} problem={problem} data={data} />;
}

/** The same, once the run has said what it knows of the design. */
function DesignRead({
  chosen,
  design,
  problem,
  data,
}: {
  chosen: Chosen;
  design: Design;
  problem: string;
  data: string | null;
}) {
  const [frame, setFrame] = useState(0);
  const state = useFilm(chosen);
  return (
    <>
      <div class="design-head">
        <Unit design={chosen.design} size={124} />
        <div>
          <p class="eyebrow">{chosen.of}</p>
          <p class="keyline">
            <Name design={chosen.design} />{" "}
            <button type="button" class="quiet" aria-label="pattern as SVG" onClick={() => saveUnit(chosen.design)}>
              SVG
            </button>
          </p>
          <Facts chosen={chosen} design={design} state={state} />
        </div>
      </div>
      <Problem text={problem} />
      <Measure listed={listedOf(chosen, design)} data={data} />
      {design.proposals.map((p) => (
        <Reason
          key={p.round}
          before={`Proposed in round ${p.round}, predicted E ${gpa(p.modulus_pa)} GPa, T ${mpa(p.toughness_pa)} MPa.`}
          text={p.reason}
        />
      ))}
      {design.violation && <p class="reason">Outside the design space: {design.violation}</p>}
      <CurveChart design={design} film={state.film} frame={frame} />
      {state.film ? <FilmPlayer film={state.film} onFrame={setFrame} /> : <FilmWait state={state} />}
      {state.film && (
        <p class="quiet">
          The film shows one specimen, T {mpa(state.film.toughness)} MPa.
          {state.simulation?.source === "here" &&
            ` Simulated just now with the model of ${
              typeof chosen.model === "number"
                ? `round ${chosen.model}`
                : chosen.model === FIRST.model
                  ? "the start of the game"
                  : `the family ${chosen.model}`
            }, since the game kept no film of it.`}
        </p>
      )}
      <Notes about="design" name={design.design} />
    </>
  );
}

/** Scrolls to the panel: on a narrow screen it stands below the chart. */
export function showDesignPanel() {
  document.querySelector("section.design")?.scrollIntoView({ block: "start", behavior: "smooth" });
}

/** The design that was chosen; `children` until one is. */
export function DesignPanel({
  chosen,
  data,
  children,
}: {
  chosen: Chosen | null;
  data: string | null;
  children: ComponentChildren;
}) {
  return (
    <section class="panel design" aria-label="design">
      <div class="panel-head">
        <h2>Design</h2>
        <MaterialKey />
      </div>
      {chosen ? (
        <DesignBody key={`${chosen.design}@${chosen.map ?? chosen.model}`} chosen={chosen} data={data} />
      ) : (
        children
      )}
    </section>
  );
}

const FIRST: Chosen = {
  design: "rigid",
  model: "start",
  modulus: NaN,
  toughness: NaN,
  isSimulated: false,
  of: "base material",
};

/** What a toughness test is, while there is nothing else to see break. */
export function FirstFracture({ data }: { data: string | null }) {
  return (
    <>
      <p class="quiet">
        Until designs are proposed: the rigid base material with a notch, pulled until it separates. The toughness T is
        the energy that this takes. Click a point of the gamut to see that pattern break.
      </p>
      <DesignBody chosen={FIRST} data={data} />
    </>
  );
}

/** Designs to choose from before anything is chosen: what a round proposed. */
export function NewestProposals({
  round,
  choose,
}: {
  round: Round | null;
  choose: (c: Pick<Chosen, "design" | "model">) => void;
}) {
  return (
    <>
      <p class="quiet">Point at the gamut to see a pattern. Click, or press Enter, to see it break.</p>
      {round && <h3>Newest proposals</h3>}
      <ul class="units">
        {round?.proposals.map((p) => (
          <li key={p.design}>
            <UnitButton
              design={p.design}
              values={[gpa(p.modulus_pa), mpa(p.toughness_pa)]}
              choose={() => choose({ design: p.design, model: round.round })}
            />
          </li>
        ))}
      </ul>
    </>
  );
}
