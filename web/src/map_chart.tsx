// The map of patterns as a chart: similar patterns are near, colour is modulus or toughness.

import { useMemo, useRef, useState } from "preact/hooks";
import type { PatternMap } from "./api";
import { axis, basis, ChartBox, type ColourScale, type Option } from "./chart";
import { scaleColour, themeColour } from "./colour";
import { withinMap, type Blend, type Place } from "./map_places";
import { GPA, MPA } from "./numbers";
import { ARROWS, CardTip, placeIn, useDrawn } from "./point_chart";

export type Coloured = "toughness" | "modulus";
const REACH = 14;
const STEP = 0.02; // of the map's width, per press of an arrow key

export function MapChart({
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
  open: (design: string) => void;
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
      xAxis: axis("Isomap coordinate 1", { ...hidden, ...bounds(map.x) }),
      yAxis: axis("Isomap coordinate 2", { ...hidden, ...bounds(map.y) }),
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
  const placeOf = (event: MouseEvent) => placeIn(overlay.current!, event);
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
      open(blend.between.pattern);
    else return;
    event.preventDefault();
  };
  const handle = blend && chart.current ? pixel(blend.x, blend.y) : null;
  const corners = blend && chart.current ? blend.corners.map((i) => pixel(map.x[i], map.y[i])) : [];
  return (
    <ChartBox
      name={`map-${map.id.replace("/", "-")}`}
      label={`Map of ${map.pattern.length} patterns, coloured by ${coloured}`}
      empty="This map has no patterns."
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
        aria-label="map: arrow keys move between patterns, Enter shows the fracture of the one that is there"
        onKeyDown={onKey}
        data-blend={blend?.between?.pattern ?? ""}
        onPointerDown={(event) => {
          dragging.current = { from: placeOf(event), moved: false };
          overlay.current!.setPointerCapture(event.pointerId);
        }}
        onPointerMove={(event) => {
          const [px, py] = placeOf(event);
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
            const index = patternAt(...placeOf(event));
            if (index !== null) {
              setPlace({ x: map.x[index], y: map.y[index] });
              open(map.pattern[index]);
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
