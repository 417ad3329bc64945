// The design that an address names, and what the run says of it.

import type { PatternMap, Rounds } from "./api";
import { type Gamut } from "./gamut";
import { GPA, MPA } from "./numbers";
import type { At } from "./route";
import { newestModel } from "./rounds";

/** A design that was chosen. `model`: the round, or the family, whose model simulates it; `map`: of `nacre families`,
 *  which may have another model of that family than the game. */
export interface Chosen {
  design: string;
  model: number | string;
  map?: string;
  /** Where it comes from. */
  of: string;
  /** In Pa, where the picture has it; NaN: nowhere. */
  modulus: number;
  toughness: number;
  /** Whether these are of one simulation by the model. */
  isSimulated: boolean;
}

const NOWHERE = { modulus: NaN, toughness: NaN, isSimulated: false };

/** A model's name as an address has it. */
const modelOf = (text: string) => (/^\d+$/.test(text) ? Number(text) : text);

/** The pattern in a gamut; null: it is not there. */
function inGamut(gamut: Gamut | undefined, design: string): typeof NOWHERE | null {
  const index = gamut && /^[0-9a-f]{14}$/.test(design) ? gamut.patterns.indexOf(BigInt(`0x${design}`)) : -1;
  if (index < 0) return null;
  const [e, t] = [gamut!.points[2 * index], gamut!.points[2 * index + 1]];
  return { modulus: e / GPA, toughness: t / MPA, isSimulated: true };
}

/** In the game: proposed, measured, or a point of a gamut that is shown (by round). */
export function chosenInGame({ design, model: stated }: At, rounds: Rounds, gamuts: Map<string, Gamut>): Chosen | null {
  if (!design) return null;
  const model = stated ? modelOf(stated) : newestModel(rounds);
  const measured = rounds.measured.find((m) => m.design === design);
  const proposed = rounds.rounds.flatMap((r) =>
    r.proposals.filter((p) => p.design === design).map((p) => ({ ...p, round: r.round })),
  );
  const proposal = proposed.find((p) => p.round === model) ?? proposed.at(-1);
  const known = measured ?? proposal;
  if (known) {
    const origins = [
      proposal ? `proposed in round ${proposal.round}` : "",
      measured ? `measured in round ${measured.round}` : "",
    ];
    const of = origins.filter(Boolean).join(", ");
    return { design, model, of, modulus: known.modulus_pa, toughness: known.toughness_pa, isSimulated: false };
  }
  const point = inGamut(gamuts.get(String(model)), design);
  return { design, model, of: point ? `gamut of round ${model}` : "design", ...(point ?? NOWHERE) };
}

/** A point in the picture of the families. */
interface FamilyPoint {
  x: number;
  y: number;
  design: string;
  of: string;
  model: number | string;
  isSimulated: boolean;
}

/** Among the families: a marked point, a variant of a family that is shown (by name), or any other design. */
export function chosenInFamilies(
  { design, model: stated }: At,
  points: FamilyPoint[],
  gamuts: Map<string, Gamut>,
  newest: number,
): Chosen | null {
  if (!design) return null;
  const model = stated ? modelOf(stated) : newest;
  const ofDesign = points.filter((p) => p.design === design);
  const point = ofDesign.find((p) => p.model === model) ?? ofDesign[0];
  if (point) {
    const { x, y, of, isSimulated } = point;
    return { design, model, of, modulus: x / GPA, toughness: y / MPA, isSimulated };
  }
  const variant = inGamut(gamuts.get(String(model)), design);
  return { design, model, of: variant ? `${model}: variant` : "design", ...(variant ?? NOWHERE) };
}

/** On a map: one of its patterns, or what lies between them. */
export function chosenOnMap(
  design: string | undefined,
  map: PatternMap | null,
  whose: Pick<Chosen, "model" | "map">,
): Chosen | null {
  if (!design || !map) return null;
  const index = map.pattern.indexOf(design);
  if (index < 0) return { design, ...whose, of: "between patterns of the map", ...NOWHERE };
  const source = map.source[index];
  return {
    design,
    ...whose,
    of: source === "gamut" ? `gamut of round ${whose.model}` : source,
    modulus: map.modulus_pa[index] ?? NaN,
    toughness: map.toughness_pa[index] ?? NaN,
    isSimulated: map.modulus_pa[index] !== null,
  };
}
