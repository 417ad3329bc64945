// A plane of points, modulus against toughness: pointer, touch and keys find them, Enter and click open them.

import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { axis, basis, ChartBox, type Chart, type Option } from "./chart";
import type { Chosen } from "./chosen";
import { keyAt, PointIndex, type Gamut } from "./gamut";
import { figure, GPA, MPA } from "./numbers";
import { Unit } from "./parts";

/** A point that can be pointed at. x in GPa, y in MPa. `model`: the round, or the family, whose model simulates it. */
export interface Spot {
  x: number;
  y: number;
  design: string;
  of: string;
  model: number | string;
}

/** Many points of one kind. */
interface Cloud {
  gamut: Gamut;
  of: string;
  model: number | string;
}

const REACH = 16; // points on the screen within which the pointer catches
const LARGE = 3000; // from here on a cloud is drawn in one go

/** The steps of the arrow keys, y upwards. */
export const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Where an event happened within an element, in points. */
export function placeIn(element: HTMLElement, event: MouseEvent): [number, number] {
  const box = element.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** What an overlay on a chart needs: the chart's handle, and to be painted again whenever the chart has been drawn. */
export function useDrawn(): { chart: { current: Chart | undefined }; onReady: (made: Chart) => void } {
  const chart = useRef<Chart | undefined>(undefined);
  const [, repaint] = useState(0);
  return {
    chart,
    onReady: (made) => {
      chart.current = made;
      made.off("finished");
      made.on("finished", () => repaint((n) => n + 1));
    },
  };
}

/** The card next to the point under the pointer. */
export function CardTip({
  at,
  width,
  design,
  modulus,
  toughness,
  of,
}: {
  at: [number, number];
  width: number;
  design: string;
  modulus: number;
  toughness: number;
  of: string;
}) {
  return (
    <div
      class="card-tip"
      style={{ left: `${Math.max(2, Math.min(at[0] + 14, width - 236))}px`, top: `${Math.max(at[1] - 60, 4)}px` }}
    >
      <Unit design={design} size={72} label={false} />
      <div>
        <code class="key">{design.slice(0, 20)}</code>
        <br />E {figure(modulus)} GPa
        <br />T {figure(toughness)} MPa
        <br />
        <span class="quiet">{of}</span>
      </div>
    </div>
  );
}

/** A scatter of a cloud in one colour; nothing in it answers the pointer, PointChart does. */
export function cloudSeries(name: string, gamut: Gamut, colour: string): Option {
  const count = gamut.patterns.length;
  const size = count > 20_000 ? 2 : count > 2000 ? 3 : 4.5;
  return {
    type: "scatter",
    name,
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

/** Dragging moves, Ctrl and the wheel zoom; the page scrolls by itself. */
const zoomAlong = (axisIndex: "xAxisIndex" | "yAxisIndex"): Option => ({
  type: "inside",
  [axisIndex]: 0,
  filterMode: "none",
  zoomOnMouseWheel: "ctrl",
  moveOnMouseMove: true,
  moveOnMouseWheel: false,
  preventDefaultMouseMove: false,
});

/** Where a value lies on the screen, and the other way round. */
interface Frame {
  chart: Chart;
  scale: [number, number];
}

function frameOf(chart: Chart): Frame {
  const [a, b] = [chart.convertToPixel("grid", [0, 0]), chart.convertToPixel("grid", [1, 1])];
  return { chart, scale: [Math.abs(b[0] - a[0]), Math.abs(b[1] - a[1])] };
}

export function PointChart({
  name,
  label,
  series,
  clouds,
  spots,
  chosen,
  choose,
  table,
  empty,
  over,
}: {
  name: string;
  label: string;
  empty: string;
  series: Option[];
  clouds: Cloud[];
  spots: Spot[];
  chosen: Chosen | null;
  choose: (spot: Spot) => void;
  table: () => { heading: string[]; rows: unknown[][] };
  /** What lies above the points, drawn anew with them. */
  over?: (chart: Chart) => ComponentChildren;
}) {
  const { chart, onReady } = useDrawn();
  const overlay = useRef<HTMLDivElement>(null);
  const [pointed, setPointed] = useState<Spot | null>(null);
  const shown = clouds.map((c) => `${c.of}:${c.gamut.patterns.length}`).join();
  const indices = useMemo(() => clouds.map((cloud) => ({ cloud, index: new PointIndex(cloud.gamut.points) })), [shown]);
  const option = useMemo<Option>(
    () => ({
      ...basis(),
      xAxis: axis("Young's modulus E / GPa", { min: 0 }),
      yAxis: axis("toughness T / MPa", { min: 0, nameGap: 40 }),
      dataZoom: [zoomAlong("xAxisIndex"), zoomAlong("yAxisIndex")],
      series,
    }),
    [series],
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
    for (const { cloud, index } of indices) {
      const found = index.nearest(x, y, REACH / scale[0], REACH / scale[1]);
      if (found && found.distance < least) [best, least] = [spotOf(cloud, found.index), found.distance];
    }
    return best;
  };

  /** The nearest point in a direction, among all that are shown. */
  const step = (dx: number, dy: number) => {
    const { scale } = frameOf(chart.current!);
    const from = pointed ?? spots[0] ?? (clouds[0] && spotOf(clouds[0], clouds[0].gamut.front[0]));
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
    for (const cloud of clouds)
      for (let i = 0; i < cloud.gamut.patterns.length; ++i)
        weigh(cloud.gamut.points[2 * i], cloud.gamut.points[2 * i + 1], () => spotOf(cloud, i));
    if (best) setPointed(best);
  };

  const take = (spot: Spot | null) => spot && choose(spot);
  const place = (event: MouseEvent) => placeIn(overlay.current!, event);
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
    if (ARROWS[event.key]) step(...ARROWS[event.key]);
    else if (event.key === "Enter" || event.key === " ") take(pointed);
    else if (event.key === "+") zoom(0.7);
    else if (event.key === "-") zoom(1 / 0.7);
    else if (event.key === "0") zoom(100);
    else if (event.key === "Escape") setPointed(null);
    else return;
    event.preventDefault();
  };
  // Points of a live game arrive while somebody points: a point that is still shown stays pointed at.
  useEffect(
    () =>
      setPointed((now) => {
        const kept = now && (clouds.some((c) => c.of === now.of) || spots.some((s) => isSame(s, now)));
        return kept ? now : null;
      }),
    [shown, spots],
  );

  const pressed = useRef<[number, number] | null>(null);
  const at = (x: number, y: number): [number, number] | null => {
    if (!chart.current || Number.isNaN(x + y)) return null;
    const pixel = chart.current.convertToPixel("grid", [x, y]);
    return chart.current.containPixel("grid", pixel) ? [pixel[0], pixel[1]] : null;
  };
  const ring = pointed && at(pointed.x, pointed.y);
  const chosenRing = chosen && at(chosen.modulus * GPA, chosen.toughness * MPA);
  return (
    <ChartBox
      name={name}
      label={label}
      empty={empty}
      option={option}
      height="var(--gamut-height)"
      onReady={onReady}
      table={table}
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
          <span class="quiet hint">drag to move, Ctrl + wheel to zoom; keys: arrows, Enter, + − 0</span>
        </span>
      }
    >
      <div
        ref={overlay}
        class="catcher"
        tabIndex={0}
        role="application"
        aria-label={`points of the ${name}: arrow keys move, Enter opens`}
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
          <CardTip
            at={ring}
            width={overlay.current!.clientWidth}
            design={pointed.design}
            modulus={pointed.x}
            toughness={pointed.y}
            of={pointed.of}
          />
        )}
        <span class="for-reader" aria-live="polite">
          {pointed ? `${pointed.of}: E ${figure(pointed.x)} gigapascal, T ${figure(pointed.y)} megapascal` : ""}
        </span>
      </div>
      {chart.current && over?.(chart.current)}
    </ChartBox>
  );
}

const isSame = (a: Spot, b: Spot) => a.design === b.design && a.of === b.of;

const spotOf = ({ gamut, of, model }: Cloud, index: number): Spot => ({
  x: gamut.points[2 * index],
  y: gamut.points[2 * index + 1],
  design: keyAt(gamut, index),
  of,
  model,
});
