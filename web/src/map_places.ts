// Places on a map of patterns, and what lies there between them.

import { useEffect, useState } from "preact/hooks";
import { get, problemOf, type Between, type PatternMap } from "./api";

type Point = [number, number];
const SETTLED_MS = 120;

/** A place on a map. */
export interface Place {
  x: number;
  y: number;
}

/** Where a place lies between patterns: corners by their index in the map. */
interface Mix extends Place {
  corners: number[];
  weights: number[];
}

/** The pattern at a place of a map; null: not known yet, or for the reason in `problem`. */
export interface Blend extends Mix {
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
export function withinMap(map: PatternMap, place: Point): Point {
  if (map.triangles.length === 0 || blendAt(map, ...place).corners.length > 1) return place;
  const at = (i: number): Point => [map.x[i], map.y[i]];
  const distance = ([x, y]: Point) => Math.hypot(x - place[0], y - place[1]);
  return map.triangles
    .flatMap(([a, b, c]) => [[a, b], [b, c], [c, a]])
    .map(([a, b]) => nearestBetween(at(a), at(b), place))
    .reduce((best, each) => (distance(each) < distance(best) ? each : best));
}

/** The pattern at a place, asked for once the pointer rests. */
export function useBetween(map: PatternMap | null, place: Place | null): Blend | null {
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
