// A box on a chart of E and T: it is drawn with the pointer, and shown where it is.

import { useRef, useState } from "preact/hooks";
import type { Brush } from "./brush";
import type { Chart } from "./chart";
import { placeIn } from "./point_chart";

export type Box = Pick<Brush, "modulus" | "toughness">;

/** Pixels of the chart: left, top, right, bottom. */
type Corners = [number, number, number, number];

const SMALLEST = 6;

/** Where the box lies; its open sides end with the chart. */
function cornersOf(chart: Chart, { modulus, toughness }: Box): Corners | null {
  if ([modulus.low, modulus.high, toughness.low, toughness.high].every((bound) => bound === null)) return null;
  const far = 1e6; // GPa, MPa
  const [left, bottom] = chart.convertToPixel("grid", [modulus.low ?? -far, toughness.low ?? -far]);
  const [right, top] = chart.convertToPixel("grid", [modulus.high ?? far, toughness.high ?? far]);
  const [width, height] = [chart.getWidth(), chart.getHeight()];
  return [Math.max(left, 0), Math.max(top, 0), Math.min(right, width), Math.min(bottom, height)];
}

/** Three significant digits, as they will be read in a field. */
const rounded = (value: number) => Number(Math.max(value, 0).toPrecision(3));

function boxOf(chart: Chart, [left, top, right, bottom]: Corners): Box {
  const [e0, t0] = chart.convertFromPixel("grid", [left, bottom]);
  const [e1, t1] = chart.convertFromPixel("grid", [right, top]);
  return {
    modulus: { low: rounded(e0), high: rounded(e1) },
    toughness: { low: rounded(t0), high: rounded(t1) },
  };
}

/** `isDrawing`: the pointer draws a new box; else it passes through. */
export function BrushBox({
  chart,
  box,
  isDrawing,
  draw,
}: {
  chart: Chart;
  box: Box;
  isDrawing: boolean;
  draw: (box: Box) => void;
}) {
  const overlay = useRef<HTMLDivElement>(null);
  const [drawn, setDrawn] = useState<Corners | null>(null);
  const start = useRef<[number, number] | null>(null);
  const corners = drawn ?? cornersOf(chart, box);
  const to = (event: PointerEvent): Corners => {
    const [[x0, y0], [x1, y1]] = [start.current!, placeIn(overlay.current!, event)];
    return [Math.min(x0, x1), Math.min(y0, y1), Math.max(x0, x1), Math.max(y0, y1)];
  };
  return (
    <div
      ref={overlay}
      class={`brush-box ${isDrawing ? "drawing" : ""}`}
      aria-hidden="true"
      onPointerDown={(event) => {
        overlay.current!.setPointerCapture(event.pointerId);
        start.current = placeIn(overlay.current!, event);
      }}
      onPointerMove={(event) => start.current && setDrawn(to(event))}
      onPointerUp={(event) => {
        if (!start.current) return;
        const end = to(event);
        start.current = null;
        setDrawn(null);
        if (end[2] - end[0] >= SMALLEST && end[3] - end[1] >= SMALLEST) draw(boxOf(chart, end));
      }}
      onPointerCancel={() => {
        start.current = null;
        setDrawn(null);
      }}
    >
      {corners && corners[2] > corners[0] && corners[3] > corners[1] && (
        <span
          style={{
            left: `${corners[0]}px`,
            top: `${corners[1]}px`,
            width: `${corners[2] - corners[0]}px`,
            height: `${corners[3] - corners[1]}px`,
          }}
        />
      )}
    </div>
  );
}
