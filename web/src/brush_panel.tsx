// Choosing designs of the gamut for the shortlist, by numbers or by a box on the chart.

import { useMemo } from "preact/hooks";
import type { Mechanisms, Laboratory, Rounds } from "./api";
import { brushed, MECHANISMS, WHOLE, type Brush, type Known, type MechanismName, type Range } from "./brush";
import type { Box } from "./brush_box";
import type { Gamut } from "./gamut";
import { typedNumber, words } from "./numbers";
import { useDraft } from "./kept_draft";
import { Problem } from "./parts";
import { useReading } from "./reading";
import { MOST_LISTED, useShortlist, type Listed } from "./shortlist";

/** What somebody has typed for a range, kept as it was typed. */
type Typed = Record<"modulus" | "toughness" | "rigid" | "amount", [string, string]>;

interface Choice extends Pick<Brush, "among" | "mechanism" | "printed"> {
  isOpen: boolean;
  isDrawing: boolean;
  typed: Typed;
}

const NOTHING: [string, string] = ["", ""];
const FIRST: Choice = {
  isOpen: false,
  isDrawing: false,
  among: WHOLE.among,
  mechanism: WHOLE.mechanism,
  printed: WHOLE.printed,
  typed: { modulus: NOTHING, toughness: NOTHING, rigid: NOTHING, amount: NOTHING },
};

const rangeOf = ([low, high]: [string, string], scale = 1): Range => {
  const bound = (text: string) => {
    const value = typedNumber(text);
    return value === null ? null : value * scale;
  };
  return { low: bound(low), high: bound(high) };
};

const brushOf = ({ among, mechanism, printed, typed }: Choice): Brush => ({
  among,
  mechanism,
  printed,
  modulus: rangeOf(typed.modulus),
  toughness: rangeOf(typed.toughness),
  rigid: rangeOf(typed.rigid, 0.01),
  amount: rangeOf(typed.amount),
});

interface Brushing {
  choice: Choice;
  setChoice: (next: Choice) => void;
  brush: Brush;
  /** The designs that are chosen; none while nobody chooses. */
  chosen: Listed[];
  problem: string;
  /** Takes a box as the ranges of E and T. */
  draw: (box: Box) => void;
}

const PRINTED = ["printed", "measured"];

/** Keeps what is chosen while other views are looked at. Laboratory and cracks are read only where they matter. */
export function useBrush(rounds: Rounds, gamuts: Gamut[], data: string | null): Brushing {
  const [choice, setChoice] = useDraft<Choice>("brush", FIRST);
  const brush = useMemo(() => brushOf(choice), [choice]);
  const needed = choice.isOpen ? data : null;
  const laboratory = useReading<Laboratory>("/api/laboratory", {}, needed, choice.isOpen && brush.printed !== "");
  const mechanisms = useReading<Mechanisms>("/api/mechanisms", {}, needed, choice.isOpen && brush.mechanism !== "");
  const known = useMemo<Known>(
    () => ({
      printed: new Set(
        (laboratory.value?.designs ?? []).filter((d) => PRINTED.includes(d.state)).map((d) => d.design),
      ),
      mechanisms: new Map((mechanisms.value?.designs ?? []).map((d) => [d.design, d])),
    }),
    [laboratory.value, mechanisms.value],
  );
  const sizes = gamuts.map((g) => `${g.round}:${g.patterns.length}`).join();
  const chosen = useMemo(
    () => (choice.isOpen ? brushed(brush, rounds, gamuts, known) : []),
    [choice.isOpen, brush, rounds, sizes, known],
  );
  const typedOf = ({ low, high }: Range): [string, string] => [String(low ?? ""), String(high ?? "")];
  const draw = ({ modulus, toughness }: Box) =>
    setChoice({
      ...choice,
      isDrawing: false,
      typed: { ...choice.typed, modulus: typedOf(modulus), toughness: typedOf(toughness) },
    });
  return { choice, setChoice, brush, chosen, problem: laboratory.problem || mechanisms.problem, draw };
}

const FIELDS: { name: keyof Typed; label: string; unit: string }[] = [
  { name: "modulus", label: "E", unit: "GPa" },
  { name: "toughness", label: "T", unit: "MPa" },
  { name: "rigid", label: "rigid share", unit: "%" },
];

function RangeFields(
  { label, unit, value, set }: {
    label: string;
    unit: string;
    value: [string, string];
    set: (value: [string, string]) => void;
  },
) {
  const field = (i: 0 | 1) => (
    <input
      inputMode="decimal"
      size={6}
      value={value[i]}
      aria-label={`${label} ${i ? "at most" : "at least"}${unit && `, ${unit}`}`}
      aria-invalid={value[i].trim() !== "" && typedNumber(value[i]) === null}
      placeholder={i ? "to" : "from"}
      onInput={(e) => set(i ? [value[0], e.currentTarget.value] : [e.currentTarget.value, value[1]])}
    />
  );
  return (
    <span class="range-fields">
      {label} {field(0)} {field(1)} {unit}
    </span>
  );
}

function Choices({ brushing }: { brushing: Brushing }) {
  const { choice, setChoice, chosen, problem } = brushing;
  const shortlist = useShortlist();
  const set = (part: Partial<Choice>) => setChoice({ ...choice, ...part });
  const setTyped = (name: keyof Typed, value: [string, string]) =>
    set({ typed: { ...choice.typed, [name]: value } });
  const fresh = chosen.filter((each) => !shortlist.has(each.design));
  const room = MOST_LISTED - shortlist.list.length;
  return (
    <>
      <div class="row">
        <label>
          among{" "}
          <select
            value={choice.among}
            onChange={(e) => set({ among: e.currentTarget.value as Brush["among"] })}
          >
            <option value="front">the fronts that are shown</option>
            <option value="marked">proposed and measured designs</option>
            <option value="all">all points that are shown</option>
          </select>
        </label>
        {FIELDS.map(({ name, label, unit }) => (
          <RangeFields
            key={name}
            label={label}
            unit={unit}
            value={choice.typed[name]}
            set={(value) => setTyped(name, value)}
          />
        ))}
        <button
          type="button"
          class="quiet"
          aria-pressed={choice.isDrawing}
          onClick={() => set({ isDrawing: !choice.isDrawing })}
        >
          {choice.isDrawing ? "end the box" : "draw a box on the chart"}
        </button>
        <label>
          mechanism{" "}
          <select
            value={choice.mechanism}
            title={choice.mechanism && MECHANISMS[choice.mechanism]}
            onChange={(e) => set({ mechanism: e.currentTarget.value as MechanismName | "" })}
          >
            <option value="">any</option>
            {Object.keys(MECHANISMS).map((name) => (
              <option key={name} value={name}>
                {words(name)}
              </option>
            ))}
          </select>
        </label>
        {choice.mechanism && (
          <RangeFields
            label={words(choice.mechanism)}
            unit=""
            value={choice.typed.amount}
            set={(value) => setTyped("amount", value)}
          />
        )}
        <label>
          printed{" "}
          <select
            value={choice.printed}
            onChange={(e) => set({ printed: e.currentTarget.value as Brush["printed"] })}
          >
            <option value="">or not</option>
            <option value="printed">yes</option>
            <option value="not printed">not yet</option>
          </select>
        </label>
      </div>
      {choice.mechanism && (
        <p class="quiet">
          {words(choice.mechanism)}: {MECHANISMS[choice.mechanism]}. Known of designs whose crack the game has:
          proposals, seeds and variants.
        </p>
      )}
      <Problem text={problem} />
      <div class="row">
        <button
          type="button"
          disabled={fresh.length === 0 || room <= 0}
          onClick={() => shortlist.add(chosen)}
        >
          Add {Math.min(fresh.length, Math.max(room, 0))} to the shortlist
        </button>
        <button type="button" class="quiet" onClick={() => setChoice({ ...FIRST, isOpen: true })}>
          choose anew
        </button>
        <span class="quiet" role="status">
          {chosen.length} chosen, {chosen.length - fresh.length} of them on the list
          {fresh.length > room && `; it takes ${MOST_LISTED}: the toughest are added`}
        </span>
      </div>
    </>
  );
}

export function BrushPanel({ brushing }: { brushing: Brushing }) {
  const { choice, setChoice } = brushing;
  const follow = (isOpen: boolean) => isOpen !== choice.isOpen && setChoice({ ...choice, isOpen, isDrawing: false });
  return (
    <details class="brush" open={choice.isOpen} onToggle={(e) => follow(e.currentTarget.open)}>
      <summary>Choose for the shortlist</summary>
      {choice.isOpen && <Choices brushing={brushing} />}
    </details>
  );
}
