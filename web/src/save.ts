// Pictures and tables as files. Names and titles begin with the run's name.

import { openedRun } from "./api";

/** A file's name as it is saved: a run's name has no characters that a file's name may not have. */
const fileName = (name: string) => (openedRun() ? `${openedRun()}-${name}` : name);

/** A title with the run's name. */
export const titleOf = (text: string) => (openedRun() ? `${openedRun()}: ${text}` : text);

export function save(name: string, content: Blob | string, type = "text/plain"): void {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = fileName(name);
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

const cell = (value: unknown) => {
  const text = value === null || value === undefined ? "" : String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

function csvOf(heading: string[], rows: unknown[][]): string {
  return [heading, ...rows].map((row) => row.map(cell).join(",")).join("\n") + "\n";
}

export const saveCsv = (name: string, heading: string[], rows: unknown[][]) =>
  save(`${name}.csv`, csvOf(heading, rows), "text/csv");

/** What no XML file may hold, and names from elsewhere might. */
const NOT_XML = /[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g;
const escaped = (text: string) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

/** `title` says what the picture shows. */
export function saveSvg(name: string, svg: string, title: string): void {
  const titled = svg.replace(/<svg[^>]*>/, (opening) => `${opening}<title>${escaped(titleOf(title))}</title>`);
  save(`${name}.svg`, titled.replace(NOT_XML, "\ufffd"), "image/svg+xml");
}

export function saveCanvas(name: string, canvas: HTMLCanvasElement): void {
  canvas.toBlob((blob) => blob && save(`${name}.png`, blob), "image/png");
}
