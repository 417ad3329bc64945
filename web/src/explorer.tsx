// Maps of patterns: likeness as nearness, colour as modulus or toughness. A click breaks a pattern, a drag goes between patterns.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { get, problemOf, type Between, type Maps, type Mechanism, type PatternMap, type Rounds } from "./api";
import { axis, basis, ChartBox, type ColourScale, type Option } from "./chart";
import { scaleColour, themeColour } from "./colour";
import { DesignBody, type Chosen } from "./design_panel";
import { figure, GPA, MPA, percent } from "./numbers";
import { Awaited, Problem, Table, Unit } from "./parts";
import { ARROWS, CardTip, placeIn, useDrawn } from "./point_chart";
import { AGAIN_MS, useReading } from "./reading";

type Coloured = "toughness" | "modulus";
type Point = [number, number];
const REACH = 14;
const STEP = 0.02; // of the map's width, per press of an arrow key
const SETTLED_MS = 120;
const LOOK_MS = 400;

/** A place on a map. */
interface Place {
  x: number;
  y: number;
}

/** Where a place lies between patterns: corners by their index in the map. */
interface Mix extends Place {
  corners: number[];
  weights: number[];
}

/** The pattern at a place of a map; null: not known yet, or for the reason in `problem`. */
interface Blend extends Mix {
  map: PatternMap;
  between: Between | null;
  problem: string;
}

/** The triangle that holds a point, with the point's weights; the nearest pattern alone outside all triangles. */
function blendAt(map: PatternMap, x: number, y: number): Mix {
  for (const corners of map.triangles) {
    const [a, b, c] = corners;
    const area = (map.x[b] - map.x[a]) * (map.y[c] - map.y[a]) - (map.x[c] - map.x[a]) * (map.y[b] - map.y[a]);
    if (area === 0) continue;
    const u = ((map.x[b] - x) * (map.y[c] - y) - (map.x[c] - x) * (map.y[b] - y)) / area;
    const v = ((map.x[c] - x) * (map.y[a] - y) - (map.x[a] - x) * (map.y[c] - y)) / area;
    if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9)
      return { x, y, corners, weights: [u, v, 1 - u - v].map((w) => Math.min(1, Math.max(0, w))) };
  }
  let nearest = 0;
  map.x.forEach((each, i) => {
    if (Math.hypot(each - x, map.y[i] - y) < Math.hypot(map.x[nearest] - x, map.y[nearest] - y)) nearest = i;
  });
  return { x: map.x[nearest], y: map.y[nearest], corners: [nearest], weights: [1] };
}

/** The point between a and b that is nearest to (x, y). */
function nearestBetween([ax, ay]: Point, [bx, by]: Point, [x, y]: Point): Point {
  const [dx, dy] = [bx - ax, by - ay];
  const along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1);
  const share = Math.min(1, Math.max(0, along));
  return [ax + share * dx, ay + share * dy];
}

/** The place itself where there are patterns around it; outside, the nearest one at the edge of the map's triangles. */
function withinMap(map: PatternMap, place: Point): Point {
  if (map.triangles.length === 0 || blendAt(map, ...place).corners.length > 1) return place;
  const at = (i: number): Point => [map.x[i], map.y[i]];
  const distance = ([x, y]: Point) => Math.hypot(x - place[0], y - place[1]);
  return map.triangles
    .flatMap(([a, b, c]) => [[a, b], [b, c], [c, a]])
    .map(([a, b]) => nearestBetween(at(a), at(b), place))
    .reduce((best, each) => (distance(each) < distance(best) ? each : best));
}

interface MapState {
  map: PatternMap | null;
  progress: number | null;
  problem: string;
}

/** A map, asked for until it is there. Of another map nothing is known at first. */
function useMap(id: string): MapState {
  const nothing: MapState & { id: string } = { id, map: null, progress: null, problem: "" };
  const [state, setState] = useState(nothing);
  useEffect(() => {
    let dropped = false;
    let timer = 0;
    const look = async () => {
      const next = { ...nothing };
      try {
        const answer = await get<{ map?: PatternMap; progress?: number | null }>("/api/map", { id });
        next.map = answer.map ?? null;
        next.progress = answer.progress ?? null;
      } catch (error) {
        next.problem = problemOf(error);
      }
      if (dropped) return;
      setState(next);
      if (!next.map) timer = window.setTimeout(look, next.problem ? AGAIN_MS : LOOK_MS);
    };
    void look();
    return () => {
      dropped = true;
      clearTimeout(timer);
    };
  }, [id]);
  return state.id === id ? state : nothing;
}

/** The pattern at a place, asked for once the pointer rests. */
function useBetween(map: PatternMap | null, place: Place | null): Blend | null {
  const [blend, setBlend] = useState<Blend | null>(null);
  useEffect(() => {
    if (!map || !place) return setBlend(null);
    const found = { ...blendAt(map, place.x, place.y), map };
    setBlend((before) => ({ ...found, between: before?.map === map ? before.between : null, problem: "" }));
    let dropped = false;
    const timer = setTimeout(() => {
      get<Between>("/api/between", {
        patterns: found.corners.map((i) => map.pattern[i]).join(),
        weights: found.weights.map((w) => w.toFixed(4)).join(),
      })
        .then((between) => !dropped && setBlend({ ...found, between, problem: "" }))
        .catch((error) => !dropped && setBlend({ ...found, between: null, problem: problemOf(error) }));
    }, SETTLED_MS);
    return () => {
      dropped = true;
      clearTimeout(timer);
    };
  }, [map, place]);
  // The corners of a blend are of its own map: on another one they are other patterns, or none.
  return place && blend?.map === map ? blend : null;
}

function MapChart({
  map,
  coloured,
  place,
  setPlace,
  blend,
  open,
  theme,
}: {
  map: PatternMap;
  coloured: Coloured;
  place: Place | null;
  setPlace: (p: Place) => void;
  blend: Blend | null;
  open: (design: string, index: number | null) => void;
  theme: string;
}) {
  const { chart, onReady } = useDrawn();
  const overlay = useRef<HTMLDivElement>(null);
  const [pointed, setPointed] = useState<number | null>(null);
  const dragging = useRef<{ from: [number, number]; moved: boolean } | null>(null);
  const values = coloured === "modulus" ? map.modulus_pa : map.toughness_pa;
  const [low, high] = useMemo(() => range(values), [values]);
  const option = useMemo<Option>(() => {
    const spare = 0.05 * (Math.max(...map.x) - Math.min(...map.x) || 1);
    const bounds = (v: number[]) => ({ min: Math.min(...v) - spare, max: Math.max(...v) + spare });
    const hidden = { axisLabel: { show: false }, splitLine: { show: false }, axisLine: { show: false }, nameGap: 10 };
    return {
      ...basis({ grid: { left: 26, right: 10, top: 10, bottom: 26 } }),
      xAxis: axis("Isomap 1", { ...hidden, ...bounds(map.x) }),
      yAxis: axis("Isomap 2", { ...hidden, ...bounds(map.y) }),
      series: [
        {
          type: "scatter",
          silent: true,
          symbolSize: map.x.length > 1000 ? 6 : 9,
          data: map.x.map((x, i) => ({
            value: [x, map.y[i]],
            symbol: map.source[i] === "seed" ? "diamond" : "circle",
            symbolSize: map.source[i] === "seed" ? 18 : undefined,
            itemStyle: {
              color: values[i] === null ? "transparent" : scaleColour((values[i]! - low) / (high - low || 1)),
              borderColor:
                values[i] === null
                  ? themeColour("quiet")
                  : map.source[i] === "interpolated"
                    ? themeColour("ink")
                    : themeColour("panel"),
              borderWidth: values[i] === null || map.source[i] === "interpolated" ? 1 : 0.5,
            },
          })),
        },
      ],
    };
  }, [map, coloured, theme]);

  const pixel = (x: number, y: number) => chart.current!.convertToPixel("grid", [x, y]) as [number, number];
  const data = (px: number, py: number) => chart.current!.convertFromPixel("grid", [px, py]) as [number, number];
  const place2 = (event: MouseEvent) => placeIn(overlay.current!, event);
  const patternAt = (px: number, py: number): number | null => {
    let best: number | null = null;
    let least = REACH;
    map.x.forEach((x, i) => {
      const [a, b] = pixel(x, map.y[i]);
      const distance = Math.hypot(a - px, b - py);
      if (distance < least) [best, least] = [i, distance];
    });
    return best;
  };
  const onKey = (event: KeyboardEvent) => {
    const width = Math.max(...map.x) - Math.min(...map.x);
    if (ARROWS[event.key]) {
      const from = place ?? { x: map.x[0], y: map.y[0] };
      const [dx, dy] = ARROWS[event.key];
      const [x, y] = withinMap(map, [from.x + dx * STEP * width, from.y + dy * STEP * width]);
      setPlace({ x, y });
    } else if ((event.key === "Enter" || event.key === " ") && blend?.between?.pattern)
      open(blend.between.pattern, null);
    else return;
    event.preventDefault();
  };
  const handle = blend && chart.current ? pixel(blend.x, blend.y) : null;
  const corners = blend && chart.current ? blend.corners.map((i) => pixel(map.x[i], map.y[i])) : [];
  return (
    <ChartBox
      name={`map-${map.id.replace("/", "-")}`}
      label={`map of ${map.pattern.length} patterns coloured by ${coloured}`}
      option={option}
      height="var(--gamut-height)"
      onReady={onReady}
      table={() => ({
        heading: ["pattern", "source", "x", "y", "modulus_pa", "toughness_pa"],
        rows: map.pattern.map((p, i) => [p, map.source[i], map.x[i], map.y[i], map.modulus_pa[i], map.toughness_pa[i]]),
      })}
      scale={scaleOf(coloured, low, high)}
    >
      <div
        ref={overlay}
        class="catcher map"
        tabIndex={0}
        role="application"
        aria-label="map: arrow keys move between patterns, Enter breaks the one that is there"
        onKeyDown={onKey}
        data-blend={blend?.between?.pattern ?? ""}
        onPointerDown={(event) => {
          dragging.current = { from: place2(event), moved: false };
          overlay.current!.setPointerCapture(event.pointerId);
        }}
        onPointerMove={(event) => {
          const [px, py] = place2(event);
          setPointed(dragging.current ? null : patternAt(px, py));
          if (!dragging.current) return;
          const { from } = dragging.current;
          dragging.current.moved ||= Math.hypot(px - from[0], py - from[1]) > 5;
          if (!dragging.current.moved) return;
          const [x, y] = data(px, py);
          setPlace({ x, y });
        }}
        onPointerUp={(event) => {
          const drag = dragging.current;
          dragging.current = null;
          if (drag && !drag.moved) {
            const index = patternAt(...place2(event));
            if (index !== null) {
              setPlace({ x: map.x[index], y: map.y[index] });
              open(map.pattern[index], index);
            }
          }
        }}
        onPointerLeave={() => setPointed(null)}
      >
        <svg class="overlay" aria-hidden="true">
          {corners.length > 1 && <polygon points={corners.map((c) => c.join()).join(" ")} class="triangle" />}
          {corners.length > 1 &&
            handle &&
            corners.map((c, i) => (
              <line
                key={i}
                x1={handle[0]}
                y1={handle[1]}
                x2={c[0]}
                y2={c[1]}
                class="spoke"
                stroke-width={0.5 + 3 * blend!.weights[i]}
              />
            ))}
          {handle && <circle cx={handle[0]} cy={handle[1]} r="8" class="handle" />}
        </svg>
        {pointed !== null && chart.current && (
          <CardTip
            at={pixel(map.x[pointed], map.y[pointed])}
            width={overlay.current!.clientWidth}
            design={map.pattern[pointed]}
            modulus={(map.modulus_pa[pointed] ?? NaN) * GPA}
            toughness={(map.toughness_pa[pointed] ?? NaN) * MPA}
            of={map.source[pointed]}
          />
        )}
        <span class="for-reader" aria-live="polite">
          {blend?.between?.pattern ? `between ${blend.corners.length} patterns: ${blend.between.pattern}` : ""}
        </span>
      </div>
    </ChartBox>
  );
}

function range(values: (number | null)[]): [number, number] {
  const known = values.filter((v): v is number => v !== null);
  return known.length > 0 ? [Math.min(...known), Math.max(...known)] : [0, 1];
}

function scaleOf(coloured: Coloured, low: number, high: number): ColourScale {
  const [factor, unit] = coloured === "modulus" ? [GPA, "GPa"] : [MPA, "MPa"];
  return { name: coloured === "modulus" ? "E" : "T", low: low * factor, high: high * factor, unit };
}

/** Which map, and what its colour shows. */
function Choices({
  maps,
  id,
  pick,
  coloured,
  setColoured,
}: {
  maps: Maps;
  id: string;
  pick: (id: string) => void;
  coloured: Coloured;
  setColoured: (c: Coloured) => void;
}) {
  return (
    <div class="toggles">
      <label>
        map{" "}
        <select value={id} onChange={(e) => pick(e.currentTarget.value)}>
          {maps.families
            .flatMap((f) => f.map_ids)
            .map((each) => (
              <option key={each} value={each}>
                {each.replace("/", ", around ")}
              </option>
            ))}
          {maps.gamuts.map((each) => (
            <option key={each} value={each}>
              best patterns of gamut {each.split("/")[1]}
            </option>
          ))}
        </select>
      </label>
      <fieldset>
        <legend>colour</legend>
        {(["toughness", "modulus"] as const).map((c) => (
          <label key={c} class="toggle">
            <input type="radio" name="colour" checked={coloured === c} onChange={() => setColoured(c)} />
            <span>{c === "modulus" ? "E" : "T"}</span>
          </label>
        ))}
      </fieldset>
    </div>
  );
}

function MapWait({ progress }: { progress: number | null }) {
  return (
    <div class="waiting tall" role="status">
      <span class="spinner" aria-hidden="true" />
      measuring the distances between patterns {progress !== null && percent(progress, 0)}
    </div>
  );
}

/** Patterns around a place, and what lies between them. */
function BlendCard({ blend, open }: { blend: Blend; open: (design: string, index: number | null) => void }) {
  const { map, corners, weights, between, problem } = blend;
  return (
    <>
      <div class="blend">
        <div class="sources">
          {corners.map((i, k) => (
            <figure key={i}>
              <Unit design={map.pattern[i]} size={54} />
              <figcaption>{percent(weights[k], 0)}</figcaption>
            </figure>
          ))}
        </div>
        <span aria-hidden="true" class="arrow">
          →
        </span>
        {between?.pattern ? (
          <Unit design={between.pattern} size={96} />
        ) : (
          <span class="quiet">{between?.violation ?? (problem ? "?" : "…")}</span>
        )}
        <div>
          {between?.pattern && (
            <button type="button" onClick={() => open(between.pattern!, null)}>
              Break it
            </button>
          )}
          {between?.pattern && between.violation && (
            <p class="quiet">outside the design space: {between.violation}</p>
          )}
        </div>
      </div>
      <Problem text={problem} />
    </>
  );
}

/** What somebody has come to on one map. */
interface Visit {
  id: string;
  place: Place | null;
  chosen: Chosen | null;
}

/** The visit to the map `id`; on another one nothing is chosen yet. */
function useVisit(id: string): [Visit, (more: Partial<Visit>) => void] {
  const [kept, setKept] = useState<Visit>({ id, place: null, chosen: null });
  const of = (visit: Visit) => (visit.id === id ? visit : { id, place: null, chosen: null });
  return [of(kept), (more) => setKept((before) => ({ ...of(before), ...more }))];
}

/** Whose model breaks what is chosen. */
type Whose = Pick<Chosen, "model" | "map">;

/** What a click on a pattern of the map opens. */
const chosenOn = (map: PatternMap, index: number, whose: Whose): Chosen => ({
  design: map.pattern[index],
  ...whose,
  modulus: map.modulus_pa[index] ?? NaN,
  toughness: map.toughness_pa[index] ?? NaN,
  of: map.source[index] === "gamut" ? `gamut of round ${whose.model}` : map.source[index],
});

const chosenBetween = (design: string, whose: Whose): Chosen => ({
  design,
  ...whose,
  modulus: NaN,
  toughness: NaN,
  of: "between patterns of the map",
});

export function Explorer({ rounds, data, theme }: { rounds: Rounds; data: string | null; theme: string }) {
  const known = rounds.rounds.map((r) => `${r.round}:${r.gamut_count}`).join();
  const { value: maps, problem } = useReading<Maps>("/api/maps", {}, known);
  const [picked, setPicked] = useState<string | null>(null);
  if (!maps) return <Awaited problem={problem} />;
  const ids = [...maps.families.flatMap((f) => f.map_ids), ...maps.gamuts];
  const newest = maps.families[0]?.map_ids[0] ?? maps.gamuts.at(-1);
  const id = picked && ids.includes(picked) ? picked : newest;
  if (!id) return <p class="awaited wait">No gamut yet: the map of its best patterns appears here.</p>;
  return (
    <>
      <Problem text={problem} />
      <MapView maps={maps} id={id} pick={setPicked} data={data} theme={theme} />
    </>
  );
}

function MapView({
  maps,
  id,
  pick,
  data,
  theme,
}: {
  maps: Maps;
  id: string;
  pick: (id: string) => void;
  data: string | null;
  theme: string;
}) {
  const [coloured, setColoured] = useState<Coloured>("toughness");
  const [{ place, chosen }, setVisit] = useVisit(id);
  const { map, progress, problem } = useMap(id);
  const blend = useBetween(map, place);
  const [of, which] = id.split("/");
  const family = of === "gamut" ? null : of;
  const whose: Whose = family ? { model: family, map: id } : { model: Number(which) };
  // Whoever has begun to look around stays on the map when the gamut of another round comes.
  const visit = (more: Partial<Visit>) => {
    pick(id);
    setVisit(more);
  };
  const open = (design: string, index: number | null) =>
    visit({ chosen: map && index !== null ? chosenOn(map, index, whose) : chosenBetween(design, whose) });
  const isBetween = blend !== null && blend.corners.length > 1;
  const mechanisms = maps.families.find((f) => f.name === family)?.mechanisms ?? [];
  return (
    <>
      <div class="split">
        <section class="panel gamut">
          <div class="panel-head">
            <h2>Explorer</h2>
            <Choices maps={maps} id={id} pick={pick} coloured={coloured} setColoured={setColoured} />
          </div>
          <p class="quiet">
            Patterns that resemble each other lie near each other (earth mover's distance, Isomap). Click one to break
            it; drag across the map to go between patterns, and break what you find.
          </p>
          <Problem text={problem} />
          {map ? (
            <MapChart
              key={id}
              map={map}
              coloured={coloured}
              place={place}
              setPlace={(to) => visit({ place: to })}
              blend={blend}
              open={open}
              theme={theme}
            />
          ) : (
            !problem && <MapWait progress={progress} />
          )}
          {map && (
            <p class="quiet">
              {map.pattern.length} patterns
              {map.residual_variance !== null &&
                `; the map keeps ${percent(1 - map.residual_variance, 0)} of the variance of their distances`}
            </p>
          )}
        </section>
        <section class="panel design" aria-label="design">
          <div class="panel-head">
            <h2>{isBetween ? "Between" : "Design"}</h2>
          </div>
          {isBetween && <BlendCard blend={blend} open={open} />}
          {chosen ? (
            <DesignBody key={`${chosen.design}@${chosen.map ?? chosen.model}`} chosen={chosen} data={data} />
          ) : (
            !blend && <p class="quiet">Nothing chosen yet.</p>
          )}
        </section>
      </div>
      {mechanisms.length > 0 && (
        <section class="panel">
          <MechanismTable family={family!} mechanisms={mechanisms} />
        </section>
      )}
    </>
  );
}

/** Which mechanism goes with toughness among the patterns of a family. */
export function MechanismTable({ family, mechanisms }: { family: string; mechanisms: Mechanism[] }) {
  return (
    <Table
      name={`mechanisms-${family}`}
      caption={`What goes with toughness in ${family}, at equal rigid fraction and modulus (evidence, not cause)`}
      rows={mechanisms}
      rowKey={(m) => m.mechanism}
      empty="No cracks of this family were looked at (nacre families --cracks)."
      columns={[
        { heading: "mechanism", words: true, show: (m) => m.mechanism.replace("_", " "), value: (m) => m.mechanism },
        { heading: "patterns", show: (m) => m.patterns, value: (m) => m.patterns },
        {
          heading: "rank correlation",
          csv: "spearman_with_toughness",
          show: (m) => figure(m.spearman_with_toughness, 2),
          value: (m) => m.spearman_with_toughness,
        },
        { heading: "partial", show: (m) => figure(m.partial, 2), value: (m) => m.partial },
        {
          heading: "p, family-wise",
          csv: "p_family_wise",
          show: (m) => figure(m.p_family_wise, 2),
          value: (m) => m.p_family_wise,
        },
      ]}
    />
  );
}
