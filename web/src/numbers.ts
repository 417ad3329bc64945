// Numbers for people.

export const GPA = 1e-9;
export const MPA = 1e-6;

/** `digits` significant ones, without an exponent where none is needed. */
export function figure(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-4
    ? value.toExponential(digits - 1).replace("e+", "e")
    : value.toLocaleString("en", { minimumSignificantDigits: digits, maximumSignificantDigits: digits });
}

/** Decimals that show `digits` significant ones. */
const decimalsFor = (value: number, digits: number) =>
  value === 0 ? 0 : Math.min(9, Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value)) + 1e-12)));

/** A mean with as many decimals as its error, as the report writes it. */
export function withError(value: number, error: number): string {
  if (!Number.isFinite(value) || !(error > 0)) return figure(value);
  const decimals = Math.min(decimalsFor(error, 2), decimalsFor(value, 4));
  return `${value.toFixed(decimals)} ± ${error.toFixed(decimals)}`;
}

/** A number on an axis: as short as it is exact. */
export const tick = (value: number) => value.toLocaleString("en", { maximumSignificantDigits: 3 });

/** The number in a typed text, with a decimal point or comma; null: there is none. */
export function typedNumber(text: string): number | null {
  const plain = text.trim().replace(",", ".");
  const value = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
  return Number.isFinite(value) ? value : null;
}

export const gpa = (pa: number | null | undefined) => figure(pa === null || pa === undefined ? pa : pa * GPA);
export const mpa = (pa: number | null | undefined) => figure(pa === null || pa === undefined ? pa : pa * MPA);

export function percent(share: number | null | undefined, digits = 1): string {
  return share === null || share === undefined || !Number.isFinite(share)
    ? "–"
    : `${(100 * share).toFixed(Math.abs(share) >= 1 ? 0 : digits)} %`;
}

export function duration(seconds: number | null): string {
  if (seconds === null) return "";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}

export function bytes(count: number): string {
  return count < 1e6 ? `${Math.round(count / 1e3)} kB` : `${(count / 1e6).toFixed(1)} MB`;
}

// Forms of an effect whose names say the form alone; as in lib/material/effect_words.cpp.
const FORMS: Record<string, string> = {
  rate_power_law: "power-law rate dependence",
  rate_prony: "two-branch rate dependence",
  rate_by_phase: "rate dependence by phase",
};
export const words = (name: string) => FORMS[name] ?? name.replaceAll("_", " ");

/** "1 specimen", "3 specimens". */
export const counted = (count: number, noun: string) => `${count} ${noun}${count === 1 ? "" : "s"}`;

/** A clause as a sentence: its first letter is a capital. */
export const sentence = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);
