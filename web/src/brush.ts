// Which designs of the picture lie within a choice: a box in E and T, ranges of rigid share and mechanism, printed or
// not.

import type { DesignMechanisms, Rounds } from "./api";
import { keyAt, type Gamut } from "./gamut";
import { GPA, MPA } from "./numbers";
import { pixelsOf, SIDE } from "./pattern";
import type { Listed } from "./shortlist";

/** From `low` to `high`, both included; null: no bound. */
export interface Range {
  low: number | null;
  high: number | null;
}

export const MECHANISMS = {
  deflection: "the crack's path is longer than a straight crack",
  branching: "the crack splits, or separate cracks open",
  bridging: "intact ligaments bridge the crack when the test ends",
  soft_arrest: "the tip waits in front of soft material",
  guidance: "the path prefers soft material and interfaces",
} as const;
export type MechanismName = keyof typeof MECHANISMS;

export interface Brush {
  among: "front" | "marked" | "all";
  /** GPa, MPa. */
  modulus: Range;
  toughness: Range;
  /** Share of rigid pixels, 0 to 1. */
  rigid: Range;
  /** Empty: whatever the mechanisms are. */
  mechanism: MechanismName | "";
  amount: Range;
  printed: "" | "printed" | "not printed";
}

const ANY: Range = { low: null, high: null };
export const WHOLE: Brush = {
  among: "front",
  modulus: ANY,
  toughness: ANY,
  rigid: ANY,
  mechanism: "",
  amount: ANY,
  printed: "",
};

const isIn = (value: number | null, { low, high }: Range) =>
  value === null ? low === null && high === null : (low === null || value >= low) && (high === null || value <= high);

/** Bits of the free pixels on the diagonal, of which a unit has four each; of the others it has eight. */
const DIAGONAL = Array.from({ length: 10 }, (_, r) => 1n << BigInt(r * 10 - (r * (r - 1)) / 2)).reduce((a, b) => a | b);
const LOW = 0xffffffffn;
const [DIAGONAL_LOW, DIAGONAL_HIGH] = [Number(DIAGONAL & LOW), Number(DIAGONAL >> 32n)];

function ones(bits: number): number {
  let n = bits - ((bits >>> 1) & 0x55555555);
  n = (n & 0x33333333) + ((n >>> 2) & 0x33333333);
  return (((n + (n >>> 4)) & 0x0f0f0f0f) * 0x01010101) >>> 24;
}

/** Share of rigid pixels of every pattern of a gamut. */
export function rigidShares(patterns: BigUint64Array): Float64Array {
  const halves = new Uint32Array(patterns.buffer, patterns.byteOffset, 2 * patterns.length); // little-endian
  return Float64Array.from({ length: patterns.length }, (_, i) => {
    const [low, high] = [halves[2 * i], halves[2 * i + 1]];
    const diagonal = ones(low & DIAGONAL_LOW) + ones(high & DIAGONAL_HIGH);
    return (8 * (ones(low) + ones(high)) - 4 * diagonal) / (SIDE * SIDE);
  });
}

export function rigidShare(design: string): number | null {
  const pixels = pixelsOf(design);
  return pixels && pixels.reduce((sum, pixel) => sum + pixel, 0) / pixels.length;
}

/** A design of the picture; x in GPa, y in MPa. */
interface Candidate {
  design: string;
  x: number;
  y: number;
  rigid: number | null;
  of: string;
}

/** What was proposed in the rounds that are shown, and what was measured. */
function marked(rounds: Rounds, shown: Set<number>): Candidate[] {
  const measured = rounds.measured.map((m) => ({ ...m, of: `measured in round ${m.round}` }));
  const proposed = rounds.rounds
    .filter((r) => shown.has(r.round))
    .flatMap((r) => r.proposals.map((p) => ({ ...p, of: `proposed in round ${r.round}` })));
  return [...measured, ...proposed].map((d) => ({
    design: d.design,
    x: d.modulus_pa * GPA,
    y: d.toughness_pa * MPA,
    rigid: rigidShare(d.design),
    of: d.of,
  }));
}

/** Patterns of a gamut within the ranges of E, T and rigid share: of its front, or all. */
function within(gamut: Gamut, brush: Brush): Candidate[] {
  const shares = rigidShares(gamut.patterns);
  const indices = brush.among === "front" ? gamut.front : gamut.patterns.keys();
  const chosen: Candidate[] = [];
  for (const i of indices) {
    const [x, y] = [gamut.points[2 * i], gamut.points[2 * i + 1]];
    if (isIn(x, brush.modulus) && isIn(y, brush.toughness) && isIn(shares[i], brush.rigid))
      chosen.push({ design: keyAt(gamut, i), x, y, rigid: shares[i], of: `gamut of round ${gamut.round}` });
  }
  return chosen;
}

/** What the laboratory and the cracks say of designs; a design that is missing is unknown to them. */
export interface Known {
  printed: Set<string>;
  mechanisms: Map<string, DesignMechanisms>;
}

/** The designs within a choice, each once: as measured or proposed where it was, by falling toughness. */
export function brushed(brush: Brush, rounds: Rounds, gamuts: Gamut[], known: Known): Listed[] {
  const shown = new Set(gamuts.map((g) => g.round));
  const marks = marked(rounds, shown).filter(
    (d) => isIn(d.x, brush.modulus) && isIn(d.y, brush.toughness) && isIn(d.rigid, brush.rigid),
  );
  const clouds = brush.among === "marked" ? [] : [...gamuts].reverse().flatMap((g) => within(g, brush));
  const byDesign = new Map<string, Candidate>();
  for (const each of brush.among === "front" ? clouds : [...marks, ...clouds])
    if (!byDesign.has(each.design)) byDesign.set(each.design, each);
  const isWanted = ({ design }: Candidate) => {
    if (brush.printed && known.printed.has(design) !== (brush.printed === "printed")) return false;
    if (!brush.mechanism) return true;
    const amount = known.mechanisms.get(design)?.[brush.mechanism];
    return amount !== undefined && isIn(amount, brush.amount);
  };
  return [...byDesign.values()]
    .filter(isWanted)
    .sort((a, b) => b.y - a.y)
    .map(({ design, x, y, rigid, of }) => ({
      design,
      of,
      rigid_fraction: rigid,
      modulus_pa: x / GPA,
      toughness_pa: y / MPA,
    }));
}
