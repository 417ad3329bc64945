// A fracture film, drawn element by element.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { BREAKING, BREAKING_POINT, elementColours, MATERIAL } from "./colour";
import type { Film } from "./film";
import { figure, mpa } from "./numbers";
import { saveCanvas } from "./save";

const VOID = 3;
const FRAME_MS = 90;

/** Frame in which each element fails; a large number for those that do not. */
function framesOfFailing(film: Film): Int32Array {
  const failing = new Int32Array(film.columns * film.rows).fill(1 << 30);
  let begun = 0;
  film.frames.forEach((frame, f) => {
    for (; begun < frame.broken; ++begun) failing[film.breaks[begun]] = f;
  });
  return failing;
}

class FilmPainter {
  private readonly failing: Int32Array;
  private readonly colours: Uint32Array[];
  constructor(private readonly film: Film) {
    this.failing = framesOfFailing(film);
    this.colours = elementColours(film.levels);
  }

  /** Draws a frame over the whole canvas, transparent where there is nothing. */
  draw(canvas: HTMLCanvasElement, f: number, withPath: boolean, pathColour: string): void {
    const film = this.film;
    const context = canvas.getContext("2d")!;
    const image = context.createImageData(canvas.width, canvas.height);
    const points = new Uint32Array(image.data.buffer);
    const place = this.placement(canvas);
    const xs = new Float32Array((film.columns + 1) * (film.rows + 1));
    const ys = new Float32Array(xs.length);
    const displacement = film.displacement[f];
    const stretch = 1 + film.frames[f].strain;
    for (let node = 0, row = 0; row <= film.rows; ++row)
      for (let column = 0; column <= film.columns; ++column, ++node) {
        xs[node] = place.left + place.scale * (column * film.elementSize + displacement[node]);
        ys[node] = place.bottom - place.scale * (row * film.elementSize * stretch + displacement[xs.length + node]);
      }
    for (let row = 0, e = 0; row < film.rows; ++row)
      for (let column = 0; column < film.columns; ++column, ++e) {
        if (film.material[e] === VOID || this.failing[e] < f) continue;
        const a = row * (film.columns + 1) + column;
        const b = a + film.columns + 1;
        const whole = this.colours[film.material[e]][film.energy[f][e]];
        const colour = this.failing[e] === f && f > 0 ? BREAKING_POINT : whole;
        const x0 = Math.max(0, Math.round(Math.min(xs[a], xs[b])));
        const x1 = Math.min(canvas.width, Math.round(Math.max(xs[a + 1], xs[b + 1])));
        const y0 = Math.max(0, Math.round(Math.min(ys[b], ys[b + 1])));
        const y1 = Math.min(canvas.height, Math.round(Math.max(ys[a], ys[a + 1])));
        for (let y = y0; y < y1; ++y) points.fill(colour, y * canvas.width + x0, y * canvas.width + x1);
      }
    context.putImageData(image, 0, 0);
    this.drawGrips(context, place, stretch);
    if (withPath && film.path) this.drawPath(context, xs, ys, film.path, pathColour);
  }

  private placement(canvas: HTMLCanvasElement) {
    const { columns, rows, elementSize, failureStrain } = this.film;
    const margin = 0.03 * canvas.width;
    const width = columns * elementSize;
    const height = rows * elementSize * (1 + failureStrain);
    const scale = Math.min((canvas.width - 2 * margin) / width, (canvas.height - 2 * margin) / height);
    return {
      scale,
      left: (canvas.width - scale * width) / 2,
      bottom: (canvas.height + scale * height) / 2,
      width: scale * width,
    };
  }

  private drawGrips(
    context: CanvasRenderingContext2D,
    place: { scale: number; left: number; bottom: number; width: number },
    stretch: number,
  ): void {
    const thickness = 0.015 * context.canvas.width;
    const top = place.bottom - place.scale * this.film.rows * this.film.elementSize * stretch;
    context.fillStyle = "#7d8794";
    context.fillRect(place.left - thickness, place.bottom, place.width + 2 * thickness, thickness);
    context.fillRect(place.left - thickness, top - thickness, place.width + 2 * thickness, thickness);
  }

  private drawPath(
    context: CanvasRenderingContext2D,
    xs: Float32Array,
    ys: Float32Array,
    path: number[],
    colour: string,
  ): void {
    const { columns } = this.film;
    context.beginPath();
    path.forEach((e, i) => {
      const a = Math.floor(e / columns) * (columns + 1) + (e % columns);
      const b = a + columns + 2;
      context[i === 0 ? "moveTo" : "lineTo"]((xs[a] + xs[b]) / 2, (ys[a] + ys[b]) / 2);
    });
    context.strokeStyle = colour;
    context.lineWidth = 0.006 * context.canvas.width;
    context.lineJoin = "round";
    context.stroke();
  }
}

export function FilmPlayer({ film, onFrame }: { film: Film; onFrame?: (frame: number) => void }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useMemo(() => new FilmPainter(film), [film]);
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const [frame, setFrame] = useState(0);
  const [playing, setPlaying] = useState(!calm);
  const [withPath, setWithPath] = useState(false);
  const last = film.frames.length - 1;
  useEffect(() => {
    setFrame(0);
    setPlaying(!calm);
  }, [film]);
  useEffect(() => {
    if (!playing) return;
    const timer = setInterval(() => setFrame((now) => (now >= last ? 0 : now + 1)), FRAME_MS);
    return () => clearInterval(timer);
  }, [playing, last]);
  useEffect(() => {
    if (playing && frame === last) setPlaying(false);
    painter.draw(canvas.current!, Math.min(frame, last), withPath, "#ff5a36");
    onFrame?.(Math.min(frame, last));
  }, [frame, painter, withPath]);
  const shown = film.frames[Math.min(frame, last)];
  const aspect = (film.rows * (1 + film.failureStrain)) / film.columns;
  const width = 900;
  return (
    <div class="film">
      <canvas
        ref={canvas}
        width={width}
        height={Math.round(width * aspect)}
        role="img"
        aria-label={`fracture of ${film.design} at a strain of ${percentOf(shown.strain)}`}
        data-frame={frame}
      />
      <Legend />
      <div class="controls">
        <button
          type="button"
          onClick={() => {
            if (!playing && frame >= last) setFrame(0);
            setPlaying(!playing);
          }}
          aria-label={playing ? "pause the film" : "play the film"}
        >
          {playing ? "❚❚" : "▶"}
        </button>
        <input
          type="range"
          min={0}
          max={last}
          value={frame}
          aria-label="moment of the film"
          onInput={(event) => {
            setPlaying(false);
            setFrame(Number(event.currentTarget.value));
          }}
        />
        <output>
          strain {percentOf(shown.strain)} · stress {mpa(shown.stress_pa)} MPa
        </output>
      </div>
      <div class="tools">
        {film.path && (
          <label class="check">
            <input
              type="checkbox"
              checked={withPath}
              onChange={(event) => setWithPath(event.currentTarget.checked)}
            />{" "}
            crack path
          </label>
        )}
        <span class="spring" />
        <button
          type="button"
          class="quiet"
          aria-label="picture of the film as PNG"
          onClick={() => saveCanvas(`film-${film.design}-${frame}`, canvas.current!)}
        >
          PNG
        </button>
      </div>
    </div>
  );
}

/** Materials have the same colours as in the pictures of patterns. */
function Legend() {
  const colours = { ...MATERIAL, breaking: BREAKING };
  return (
    <ul class="keys" aria-label="colours of the film">
      {Object.entries(colours).map(([name, colour]) => (
        <li key={name}>
          <span class="swatch" style={{ "--c": colour } as never} /> {name}
        </li>
      ))}
      <li>glow: stored strain energy</li>
    </ul>
  );
}

const percentOf = (strain: number) => `${figure(100 * strain, 3)} %`;
