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
    : Number(value.toPrecision(digits)).toLocaleString("en", { maximumSignificantDigits: digits });
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

export const words = (name: string) => name.replaceAll("_", " ");
