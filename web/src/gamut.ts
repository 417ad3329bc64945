// Gamuts as the server sends them, and finding points in them.

import { getBytes } from "./api";
import { GPA, MPA } from "./numbers";
import { keyOfBits } from "./pattern";

export interface Gamut {
  round: number;
  patterns: BigUint64Array;
  /** GPa and MPa in turn. */
  points: Float64Array;
  /** Indices of the Pareto front, by increasing modulus. */
  front: number[];
}

/** The gamut of a round, or the variants of a family. */
export async function loadGamut(which: { round: number } | { family: string }): Promise<Gamut> {
  const buffer = await getBytes("/api/gamut", { ...which });
  const view = new DataView(buffer);
  if (new TextDecoder().decode(buffer.slice(0, 8)) !== "NACREGMT" || view.getUint32(8, true) !== 1)
    throw new Error("the gamut has an unknown format");
  const length = view.getUint32(12, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 16, length))) as {
    round: number;
    count: number;
    front: number[];
  };
  const begin = 16 + length;
  const modulus = new Float32Array(buffer, begin + 8 * header.count, header.count);
  const toughness = new Float32Array(buffer, begin + 12 * header.count, header.count);
  const points = new Float64Array(2 * header.count);
  for (let i = 0; i < header.count; ++i) {
    points[2 * i] = modulus[i] * GPA;
    points[2 * i + 1] = toughness[i] * MPA;
  }
  header.front.sort((a, b) => modulus[a] - modulus[b]);
  const patterns = new BigUint64Array(buffer, begin, header.count);
  return { round: header.round, patterns, points, front: header.front };
}

export const keyAt = (gamut: Gamut, index: number) => keyOfBits(gamut.patterns[index]);

/** Buckets over the plane, so that the pointer finds its point among 100,000 at once. */
export class PointIndex {
  private static readonly cells = 192;
  private readonly starts: Uint32Array;
  private readonly order: Uint32Array;
  private readonly low: [number, number] = [Infinity, Infinity];
  private readonly size: [number, number] = [0, 0];

  constructor(private readonly points: Float64Array) {
    const count = points.length / 2;
    const high = [-Infinity, -Infinity];
    for (let i = 0; i < points.length; ++i) {
      this.low[i & 1] = Math.min(this.low[i & 1], points[i]);
      high[i & 1] = Math.max(high[i & 1], points[i]);
    }
    for (const axis of [0, 1]) this.size[axis] = (high[axis] - this.low[axis]) / PointIndex.cells || 1;
    this.starts = new Uint32Array(PointIndex.cells * PointIndex.cells + 1);
    const cellOf = new Uint32Array(count);
    for (let i = 0; i < count; ++i) {
      cellOf[i] = this.cell(0, points[2 * i]) + PointIndex.cells * this.cell(1, points[2 * i + 1]);
      this.starts[cellOf[i] + 1]++;
    }
    for (let i = 1; i < this.starts.length; ++i) this.starts[i] += this.starts[i - 1];
    const next = this.starts.slice();
    this.order = new Uint32Array(count);
    for (let i = 0; i < count; ++i) this.order[next[cellOf[i]]++] = i;
  }

  private cell(axis: 0 | 1, value: number): number {
    return Math.min(PointIndex.cells - 1, Math.max(0, Math.floor((value - this.low[axis]) / this.size[axis])));
  }

  /** The point nearest to (x, y) within (rx, ry), which count as equally far; and how far it is, 0 to 1. */
  nearest(x: number, y: number, rx: number, ry: number): { index: number; distance: number } | null {
    let best = 1;
    let index = -1;
    const [x0, x1, y0, y1] = [this.cell(0, x - rx), this.cell(0, x + rx), this.cell(1, y - ry), this.cell(1, y + ry)];
    for (let row = y0; row <= y1; ++row)
      for (let k = this.starts[row * PointIndex.cells + x0]; k < this.starts[row * PointIndex.cells + x1 + 1]; ++k) {
        const i = this.order[k];
        const distance = ((this.points[2 * i] - x) / rx) ** 2 + ((this.points[2 * i + 1] - y) / ry) ** 2;
        if (distance < best) [best, index] = [distance, i];
      }
    return index < 0 ? null : { index, distance: Math.sqrt(best) };
  }
}

/** A front as a step line: the edge of the region that it dominates, from the toughness axis to the modulus axis. Each
 *  step is a piece of its own, ended by nulls: a chart leaves out short steps of one line, and would slope there. */
export function staircase(front: [number, number][]): ([number, number] | [null, null])[] {
  if (front.length === 0) return [];
  const sorted = [...front].sort((a, b) => a[0] - b[0]);
  const corners: [number, number][] = [[0, sorted[0][1]]];
  sorted.forEach((point, i) => {
    corners.push(point, [point[0], i + 1 < sorted.length ? sorted[i + 1][1] : 0]);
  });
  return corners.slice(1).flatMap((corner, i) => [corners[i], corner, [null, null] as [null, null]]);
}
