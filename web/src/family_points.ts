// Families as points of toughness against modulus: their series, and what can be pointed at.

import type { Family, Rounds } from "./api";
import type { Option } from "./chart";
import { themeColour } from "./colour";
import type { Gamut } from "./gamut";
import { GPA, MPA } from "./numbers";
import { cloudSeries, type Spot } from "./point_chart";

const COLOURS = 6;

/** Colour of the n-th family, as a custom property of the page. */
export const familyVariable = (index: number) => `family-${(index % COLOURS) + 1}`;

/** A family as it is drawn: with its stage, or as seeds alone. */
export interface Shown {
  name: string;
  index: number;
  seeds: string[];
  stage: Family | null;
  gamut: Gamut | null;
}

const isKnown = (v: { modulus_pa: number | null; toughness_pa: number | null }) =>
  v.modulus_pa !== null && v.toughness_pa !== null;
const pointOf = (v: { modulus_pa: number | null; toughness_pa: number | null }): [number, number] => [
  v.modulus_pa! * GPA,
  v.toughness_pa! * MPA,
];

export function seriesOf(rounds: Rounds, families: Shown[], variants: boolean): Option[] {
  const panel = themeColour("panel");
  const scatter = (name: string, data: unknown[], style: Option, more: Option = {}): Option => ({
    type: "scatter",
    name,
    data,
    silent: true,
    itemStyle: style,
    ...more,
  });
  const measured = new Map(rounds.measured.map((m) => [m.design, [m.modulus_pa * GPA, m.toughness_pa * MPA]]));
  const series: Option[] = [
    scatter("measured", [...measured.values()], { color: themeColour("homo"), opacity: 0.7 }, { symbolSize: 6, z: 3 }),
  ];
  for (const family of families) {
    const colour = themeColour(familyVariable(family.index));
    if (variants && family.gamut) series.push(cloudSeries(`${family.name}, variants`, family.gamut, colour));
    series.push(
      scatter(
        `${family.name}, seeds`,
        family.seeds.map((s) => measured.get(s)).filter(Boolean),
        { color: colour, borderColor: panel, borderWidth: 1 },
        { symbol: "diamond", symbolSize: 15, z: 6 },
      ),
    );
    const chosen = family.stage?.designs.filter((d) => !d.is_seed) ?? [];
    const steps = chosen
      .filter((d) => isKnown(d.measured) && isKnown(d.family_model))
      .flatMap((d) => [pointOf(d.family_model), pointOf(d.measured), [null, null]]);
    series.push(
      {
        type: "line",
        name: `${family.name}, from predicted to measured`,
        data: steps,
        symbol: "none",
        silent: true,
        lineStyle: { color: colour, width: 1.2 },
        z: 5,
      },
      scatter(
        `${family.name}, chosen, predicted`,
        chosen.filter((d) => isKnown(d.family_model)).map((d) => pointOf(d.family_model)),
        { color: "transparent", borderColor: colour, borderWidth: 2 },
        { symbolSize: 11, z: 7 },
      ),
      scatter(
        `${family.name}, chosen, measured`,
        chosen.filter((d) => isKnown(d.measured)).map((d) => pointOf(d.measured)),
        { color: colour, borderColor: panel, borderWidth: 1 },
        { symbolSize: 11, z: 8 },
      ),
    );
  }
  return series;
}

/** A point of a family, or of none, and what it stands for. */
export interface FamilySpot extends Spot {
  family: string | null;
  role: string;
  /** Whether its E and T are of the family's model. */
  isSimulated: boolean;
}

export const PREDICTED = "variant, predicted";

export function spotsOf(rounds: Rounds, families: Shown[], newest: number): FamilySpot[] {
  const spots: FamilySpot[] = [];
  const taken = new Set<string>();
  const add = (
    design: string,
    [x, y]: [number, number],
    family: string | null,
    role: string,
    model: number | string,
  ) => {
    const of = family ? `${family}: ${role}` : role;
    spots.push({ x, y, design, family, role, of, model, isSimulated: role === PREDICTED });
  };
  for (const family of families) {
    const model = family.stage ? family.name : newest;
    for (const d of family.stage?.designs ?? []) {
      if (d.is_seed) continue;
      if (isKnown(d.measured)) add(d.design, pointOf(d.measured), family.name, "variant, measured", model);
      if (isKnown(d.family_model)) add(d.design, pointOf(d.family_model), family.name, PREDICTED, model);
      taken.add(d.design);
    }
    for (const m of rounds.measured) {
      if (!family.seeds.includes(m.design)) continue;
      add(m.design, pointOf(m), family.name, `seed, measured in round ${m.round}`, model);
      taken.add(m.design);
    }
  }
  for (const m of rounds.measured)
    if (!taken.has(m.design)) add(m.design, pointOf(m), null, `measured in round ${m.round}`, newest);
  return spots;
}
