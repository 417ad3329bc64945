// A pattern to draw on: each pixel that is set sets its seven images.

import { useRef, useState } from "preact/hooks";
import { MATERIAL } from "./colour";
import { pixelsOf, rigidPath, SIDE, withPixel } from "./pattern";
import { ARROWS, placeIn } from "./point_chart";

type Pixel = [row: number, column: number];

const isWithin = ([row, column]: Pixel) => row >= 0 && row < SIDE && column >= 0 && column < SIDE;

/** `marked`: key of pixels that break a rule. `draw` gets the pattern while a stroke goes on, `done` what it was before
 *  and behind it. */
export function PixelEditor({
  design,
  marked,
  draw,
  done,
}: {
  design: string;
  marked: string;
  draw: (design: string) => void;
  done: (before: string, after: string) => void;
}) {
  const frame = useRef<HTMLDivElement>(null);
  const [at, setAt] = useState<Pixel | null>(null);
  const stroke = useRef<{ isRigid: boolean; before: string; design: string } | null>(null);
  const pixels = pixelsOf(design)!;
  const isRigid = ([row, column]: Pixel) => pixels[row * SIDE + column] === 1;
  const pixelOf = (event: PointerEvent): Pixel => {
    const [x, y] = placeIn(frame.current!, event);
    const { clientWidth, clientHeight } = frame.current!;
    return [Math.floor((y / clientHeight) * SIDE), Math.floor((x / clientWidth) * SIDE)];
  };
  const paint = (pixel: Pixel) => {
    const now = stroke.current!;
    now.design = withPixel(now.design, ...pixel, now.isRigid);
    draw(now.design);
  };
  const end = () => {
    if (stroke.current) done(stroke.current.before, stroke.current.design);
    stroke.current = null;
  };
  const onKey = (event: KeyboardEvent) => {
    const now: Pixel = at ?? [0, 0];
    if (ARROWS[event.key]) {
      const [dx, dy] = ARROWS[event.key];
      const next: Pixel = at ? [now[0] - dy, now[1] + dx] : now;
      if (isWithin(next)) setAt(next);
    } else if (event.key === " " || event.key === "Enter") {
      setAt(now);
      done(design, withPixel(design, ...now, !isRigid(now)));
    } else return;
    event.preventDefault();
  };
  return (
    <div
      ref={frame}
      class="pixel-editor"
      tabIndex={0}
      role="application"
      aria-label="pixels of the pattern: arrow keys move, Enter changes one and its mirror images"
      data-design={design}
      onKeyDown={onKey}
      onBlur={() => setAt(null)}
      onPointerDown={(event) => {
        const pixel = pixelOf(event);
        if (event.button !== 0 || !isWithin(pixel)) return;
        frame.current!.setPointerCapture(event.pointerId);
        stroke.current = { isRigid: !isRigid(pixel), before: design, design };
        paint(pixel);
      }}
      onPointerMove={(event) => {
        const pixel = pixelOf(event);
        if (stroke.current && isWithin(pixel)) paint(pixel);
      }}
      onPointerUp={end}
      onPointerCancel={end}
    >
      <svg viewBox={`0 0 ${SIDE} ${SIDE}`} aria-hidden="true" shape-rendering="crispEdges">
        <rect width={SIDE} height={SIDE} fill={MATERIAL.soft} />
        <path d={rigidPath(pixels)} fill={MATERIAL.rigid} />
        <path class="grid" d={GRID} />
        <path class="mirrors" d={MIRRORS} />
        <path class="marked" d={rigidPath(pixelsOf(marked) ?? new Uint8Array(SIDE * SIDE))} />
        {at && <rect class="cursor" x={at[1]} y={at[0]} width="1" height="1" />}
      </svg>
      <span class="for-reader" aria-live="polite">
        {at && `row ${at[0] + 1}, column ${at[1] + 1}: ${isRigid(at) ? "rigid" : "soft"}`}
      </span>
    </div>
  );
}

const GRID = Array.from({ length: SIDE - 1 }, (_, i) => `M${i + 1} 0V${SIDE}M0 ${i + 1}H${SIDE}`).join("");
const MIRRORS = `M${SIDE / 2} 0V${SIDE}M0 ${SIDE / 2}H${SIDE}M0 0L${SIDE} ${SIDE}M${SIDE} 0L0 ${SIDE}`;
