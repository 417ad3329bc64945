// Modulus against toughness: the clouds of the rounds, their fronts, what is proposed and measured. Pointer, touch and keys find points.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Rounds } from "./api";
import { axis, basis, ChartBox, type Chart, type Option } from "./chart";
import { roundColour, themeColour } from "./colour";
import type { Chosen } from "./design_panel";
import { keyAt, PointIndex, staircase, type Gamut } from "./gamut";
import { figure, GPA, MPA } from "./numbers";
import { Unit } from "./parts";

export interface Layers {
  cloud: boolean;
  fronts: boolean;
  proposals: boolean;
  measured: boolean;
  mixtures: boolean;
}

/** A point that can be pointed at. x in GPa, y in MPa. */
interface Spot {
  x: number;
  y: number;
  design: string;
  of: string;
  model: number;
}

const REACH = 16; // points on the screen within which the pointer catches
const LARGE = 3000; // from here on a cloud is drawn in one go

/** Few points that lie above the clouds: measured ones and proposals. */
function marks(rounds: Rounds, layers: Layers, shown: Set<number>): Spot[] {
  const newestModel = Math.max(0, ...rounds.rounds.map((r) => r.round));
  const proposals = layers.proposals
    ? rounds.rounds
        .filter((r) => shown.has(r.round))
        .flatMap((r) =>
          r.proposals.map((p) => ({
            x: p.modulus_pa * GPA,
            y: p.toughness_pa * MPA,
            design: p.design,
            of: `proposed in round ${r.round}`,
            model: r.round,
          })),
        )
    : [];
  const measured = layers.measured
    ? rounds.measured.map((m) => ({
        x: m.modulus_pa * GPA,
        y: m.toughness_pa * MPA,
        design: m.design,
        of: `measured in round ${m.round}`,
        model: newestModel,
      }))
    : [];
  return [...measured, ...proposals];
}

function cloudSeries(gamut: Gamut, newest: number): Option {
  const count = gamut.patterns.length;
  const colour = roundColour("sim", gamut.round, newest);
  const size = count > 20_000 ? 2 : count > 2000 ? 3 : 4.5;
  return {
    type: "scatter",
    name: `gamut ${gamut.round}`,
    data: gamut.points,
    dimensions: ["x", "y"],
    large: count > LARGE,
    largeThreshold: LARGE,
    progressive: 0,
    silent: true,
    symbolSize: size,
    itemStyle: { color: colour, opacity: count > 20_000 ? 0.35 : 0.55, borderWidth: 0 },
    z: 2,
  };
}

const line = (name: string, data: [number, number][], colour: string, more: Option = {}): Option => ({
  type: "line",
  name,
  data,
  symbol: "none",
  silent: true,
  lineStyle: { color: colour, width: 1.8, ...(more.lineStyle as Option) },
  z: 4,
});

function seriesOf(rounds: Rounds, gamuts: Gamut[], layers: Layers): Option[] {
  const newest = Math.max(0, ...rounds.rounds.map((r) => r.round));
  const series: Option[] = [];
  if (layers.cloud) for (const gamut of gamuts) series.push(cloudSeries(gamut, newest));
  const units = (points: [number, number][]) => points.map(([e, t]) => [e * GPA, t * MPA] as [number, number]);
  const byRound = rounds.rounds.filter((r) => gamuts.some((g) => g.round === r.round));
  if (layers.mixtures) {
    const benchmark = [...rounds.rounds].reverse().find((r) => r.benchmark.length > 0)?.benchmark ?? [];
    if (benchmark.length > 0)
      series.push({
        ...line("mixtures", units(benchmark), themeColour("homo"), { lineStyle: { type: "dashed", width: 1.4 } }),
        symbol: "circle",
        symbolSize: 4,
        itemStyle: { color: themeColour("homo") },
      });
  }
  if (layers.fronts) {
    for (const gamut of gamuts)
      series.push(
        line(
          `front of gamut ${gamut.round}`,
          staircase(gamut.front.map((i) => [gamut.points[2 * i], gamut.points[2 * i + 1]])),
          roundColour("sim", gamut.round, newest),
        ),
      );
    if (layers.measured)
      for (const round of byRound)
        if (round.measured_front.length > 0)
          series.push(
            line(
              `measured front ${round.round}`,
              staircase(units(round.measured_front)),
              roundColour("meas", round.round, newest),
            ),
          );
  }
  if (layers.measured) {
    const error = rounds.measured.flatMap((m) => [
      [
        [(m.modulus_pa - m.modulus_sd_pa) * GPA, m.toughness_pa * MPA],
        [(m.modulus_pa + m.modulus_sd_pa) * GPA, m.toughness_pa * MPA],
      ],
      [
        [m.modulus_pa * GPA, (m.toughness_pa - m.toughness_sd_pa) * MPA],
        [m.modulus_pa * GPA, (m.toughness_pa + m.toughness_sd_pa) * MPA],
      ],
    ]);
    const broken = error.flatMap((ends) => [...ends, [null, null]]);
    series.push({
      type: "line",
      name: "spread",
      data: broken,
      symbol: "none",
      silent: true,
      connectNulls: false,
      lineStyle: { color: themeColour("meas"), width: 1, opacity: 0.55 },
      z: 5,
    });
    series.push({
      type: "scatter",
      name: "measured",
      data: rounds.measured.map((m) => [m.modulus_pa * GPA, m.toughness_pa * MPA]),
      silent: true,
      symbolSize: 9,
      itemStyle: { color: themeColour("meas"), borderColor: themeColour("panel"), borderWidth: 1 },
      z: 6,
    });
  }
  if (layers.proposals) {
    const proposals = byRound.flatMap((r) => r.proposals.map((p) => [p.modulus_pa * GPA, p.toughness_pa * MPA]));
    series.push({
      type: "scatter",
      name: "proposals",
      data: proposals,
      silent: true,
      symbolSize: 11,
      symbol: "circle",
      itemStyle: { color: "transparent", borderColor: themeColour("sim"), borderWidth: 2 },
      z: 7,
    });
  }
  return series;
}

/** Where a value lies on the screen, and the other way round. */
interface Frame {
  chart: Chart;
  scale: [number, number];
}

function frameOf(chart: Chart): Frame {
  const [a, b] = [chart.convertToPixel("grid", [0, 0]), chart.convertToPixel("grid", [1, 1])];
  return { chart, scale: [Math.abs(b[0] - a[0]), Math.abs(b[1] - a[1])] };
}

export function GamutChart({
  rounds,
  gamuts,
  layers,
  chosen,
  choose,
  theme,
}: {
  rounds: Rounds;
  gamuts: Gamut[];
  layers: Layers;
  chosen: Chosen | null;
  choose: (c: Chosen) => void;
  theme: string;
}) {
  const chart = useRef<Chart | undefined>(undefined);
  const overlay = useRef<HTMLDivElement>(null);
  const [pointed, setPointed] = useState<Spot | null>(null);
  const [, redraw] = useState(0);
  const shown = useMemo(
    () => new Set(gamuts.map((g) => g.round)),
    [gamuts.map((g) => `${g.round}:${g.patterns.length}`).join()],
  );
  const indices = useMemo(() => gamuts.map((gamut) => ({ gamut, index: new PointIndex(gamut.points) })), [shown]);
  const spots = useMemo(() => marks(rounds, layers, shown), [rounds, layers, shown]);
  const option = useMemo<Option>(
    () => ({
      ...basis(),
      xAxis: axis("Young's modulus E / GPa", { min: 0 }),
      yAxis: axis("toughness T / MPa", { min: 0, nameGap: 40 }),
      dataZoom: [
        {
          type: "inside",
          xAxisIndex: 0,
          filterMode: "none",
          zoomOnMouseWheel: "ctrl",
          moveOnMouseMove: true,
          moveOnMouseWheel: false,
          preventDefaultMouseMove: false,
        },
        {
          type: "inside",
          yAxisIndex: 0,
          filterMode: "none",
          zoomOnMouseWheel: "ctrl",
          moveOnMouseMove: true,
          moveOnMouseWheel: false,
          preventDefaultMouseMove: false,
        },
      ],
      series: seriesOf(rounds, gamuts, layers),
    }),
    [rounds, shown, layers, theme],
  );

  const spotAt = (px: number, py: number): Spot | null => {
    const { chart: c, scale } = frameOf(chart.current!);
    if (!c.containPixel("grid", [px, py])) return null;
    const [x, y] = c.convertFromPixel("grid", [px, py]);
    let best: Spot | null = null;
    let least = 1.0;
    for (const spot of spots) {
      const distance = Math.hypot((spot.x - x) * scale[0], (spot.y - y) * scale[1]) / REACH;
      if (distance < least) [best, least] = [spot, distance];
    }
    if (best && least < 0.6) return best; // marks lie on top
    if (layers.cloud)
      for (const { gamut, index } of indices) {
        const found = index.nearest(x, y, REACH / scale[0], REACH / scale[1]);
        if (found && found.distance < least) [best, least] = [spotOf(gamut, found.index), found.distance];
      }
    return best;
  };

  /** The nearest point in a direction, among all that are shown. */
  const step = (dx: number, dy: number) => {
    const { scale } = frameOf(chart.current!);
    const from = pointed ?? spots[0] ?? (gamuts[0] && spotOf(gamuts[0], gamuts[0].front[0]));
    if (!from) return;
    if (!pointed) return setPointed(from);
    let best: Spot | null = null;
    let least = Infinity;
    const weigh = (x: number, y: number, make: () => Spot) => {
      const [along, across] = [
        (x - from.x) * dx * scale[0] + (y - from.y) * dy * scale[1],
        Math.abs((x - from.x) * dy * scale[0]) + Math.abs((y - from.y) * dx * scale[1]),
      ];
      if (along <= 0.5 || along + 2 * across >= least) return;
      least = along + 2 * across;
      best = make();
    };
    for (const spot of spots) weigh(spot.x, spot.y, () => spot);
    if (layers.cloud)
      for (const gamut of gamuts)
        for (let i = 0; i < gamut.patterns.length; ++i)
          weigh(gamut.points[2 * i], gamut.points[2 * i + 1], () => spotOf(gamut, i));
    if (best) setPointed(best);
  };

  const take = (spot: Spot | null) =>
    spot &&
    choose({ design: spot.design, model: spot.model, modulus: spot.x / GPA, toughness: spot.y / MPA, of: spot.of });
  const place = (event: MouseEvent): [number, number] => {
    const box = overlay.current!.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const zoom = (factor: number) => {
    const c = chart.current!;
    const now = c.getOption() as { dataZoom: { start: number; end: number }[] };
    now.dataZoom.forEach((each, dataZoomIndex) => {
      const half = Math.min(50, ((each.end - each.start) / 2) * factor);
      const middle = Math.min(100 - half, Math.max(half, (each.start + each.end) / 2));
      c.dispatchAction({ type: "dataZoom", dataZoomIndex, start: middle - half, end: middle + half });
    });
  };
  const onKey = (event: KeyboardEvent) => {
    const arrows: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    if (arrows[event.key]) step(...arrows[event.key]);
    else if (event.key === "Enter" || event.key === " ") take(pointed);
    else if (event.key === "+") zoom(0.7);
    else if (event.key === "-") zoom(1 / 0.7);
    else if (event.key === "0") zoom(100);
    else if (event.key === "Escape") setPointed(null);
    else return;
    event.preventDefault();
  };
  useEffect(() => setPointed(null), [shown]);

  const pressed = useRef<[number, number] | null>(null);
  const at = (x: number, y: number): [number, number] | null => {
    if (!chart.current) return null;
    const pixel = chart.current.convertToPixel("grid", [x, y]);
    return chart.current.containPixel("grid", pixel) ? [pixel[0], pixel[1]] : null;
  };
  const ring = pointed && at(pointed.x, pointed.y);
  const chosenRing = chosen && at(chosen.modulus * GPA, chosen.toughness * MPA);
  return (
    <ChartBox
      name="gamut"
      label="Gamut: Young's modulus against toughness"
      option={option}
      height="var(--gamut-height)"
      onReady={(made) => {
        chart.current = made;
        made.off("finished");
        made.on("finished", () => redraw((n) => n + 1));
      }}
      table={() => ({
        heading: ["round", "pattern", "modulus_pa", "toughness_pa"],
        rows: gamuts.flatMap((g) =>
          Array.from(g.patterns, (_, i) => [g.round, keyAt(g, i), g.points[2 * i] / GPA, g.points[2 * i + 1] / MPA]),
        ),
      })}
      tools={
        <span class="zoom">
          <button type="button" class="quiet" aria-label="zoom in" onClick={() => zoom(0.7)}>
            +
          </button>
          <button type="button" class="quiet" aria-label="zoom out" onClick={() => zoom(1 / 0.7)}>
            −
          </button>
          <button type="button" class="quiet" aria-label="show everything" onClick={() => zoom(100)}>
            all
          </button>
          <span class="quiet hint">drag, Ctrl + wheel; keys: arrows, Enter, + − 0</span>
        </span>
      }
    >
      <div
        ref={overlay}
        class="catcher"
        tabIndex={0}
        role="application"
        aria-label="points of the gamut: arrow keys move, Enter opens"
        onKeyDown={onKey}
        data-pointed={pointed?.design ?? ""}
        onPointerMove={(event) => setPointed(spotAt(...place(event)))}
        onPointerLeave={() => setPointed(null)}
        onPointerDown={(event) => (pressed.current = place(event))}
        onClick={(event) => {
          const [x, y] = place(event);
          const moved = pressed.current && Math.hypot(x - pressed.current[0], y - pressed.current[1]) > 5;
          if (!moved) take(spotAt(x, y));
        }}
      >
        {chosenRing && <span class="ring chosen" style={{ left: `${chosenRing[0]}px`, top: `${chosenRing[1]}px` }} />}
        {ring && <span class="ring" style={{ left: `${ring[0]}px`, top: `${ring[1]}px` }} />}
        {ring && pointed && (
          <div
            class="card-tip"
            style={{
              left: `${Math.min(ring[0] + 14, overlay.current!.clientWidth - 236)}px`,
              top: `${Math.max(ring[1] - 60, 4)}px`,
            }}
          >
            <Unit design={pointed.design} size={72} label={false} />
            <div>
              <code class="key">{pointed.design.slice(0, 20)}</code>
              <br />E {figure(pointed.x)} GPa
              <br />T {figure(pointed.y)} MPa
              <br />
              <span class="quiet">{pointed.of}</span>
            </div>
          </div>
        )}
        <span class="for-reader" aria-live="polite">
          {pointed ? `${pointed.of}: E ${figure(pointed.x)} gigapascal, T ${figure(pointed.y)} megapascal` : ""}
        </span>
      </div>
    </ChartBox>
  );
}

const spotOf = (gamut: Gamut, index: number): Spot => ({
  x: gamut.points[2 * index],
  y: gamut.points[2 * index + 1],
  design: keyAt(gamut, index),
  of: `gamut of round ${gamut.round}`,
  model: gamut.round,
});
