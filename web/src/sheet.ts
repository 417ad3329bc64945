// The specimens' sheet as cells (docs/FORMATS.md, "Specimen sheets"): read as spreadsheets write it, built from the
// open orders where there is none, and written again for the server.

import type { Laboratory, Order } from "./api";

export interface Sheet {
  name: string;
  delimiter: string;
  heading: string[];
  rows: string[][];
}

/** Columns that name a file and a specimen make a table a sheet. */
const NEEDED = ["file", "specimen"];

/** The text of a file in the encodings of spreadsheets. */
export function decoded(bytes: ArrayBuffer): string {
  const [first, second] = new Uint8Array(bytes, 0, Math.min(2, bytes.byteLength));
  if (first === 0xff && second === 0xfe) return new TextDecoder("utf-16le").decode(bytes);
  if (first === 0xfe && second === 0xff) return new TextDecoder("utf-16be").decode(bytes);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

/** Rows of cells; a quoted cell may hold delimiters and line ends. */
function cellsOf(text: string, delimiter: string): string[][] {
  const rows: string[][] = [];
  let row: string[] = [];
  let cell = "";
  let isQuoted = false;
  const endCell = () => {
    row.push(cell.trim());
    cell = "";
  };
  const endRow = () => {
    endCell();
    if (row.some((c) => c !== "")) rows.push(row);
    row = [];
  };
  for (let i = 0; i < text.length; ++i) {
    const letter = text[i];
    if (isQuoted) {
      if (letter !== '"') cell += letter === "\n" || letter === "\r" ? " " : letter;
      else if (text[i + 1] === '"') cell += text[++i];
      else isQuoted = false;
    } else if (letter === '"' && cell.trim() === "") isQuoted = true;
    else if (letter === delimiter) endCell();
    else if (letter === "\n") endRow();
    else if (letter !== "\r") cell += letter;
  }
  endRow();
  return rows;
}

/** The sheet in a text; null where it is another table. */
export function sheetIn(name: string, text: string): Sheet | null {
  const table = text.replace(/^\s*sep=.\r?\n/, "");
  for (const delimiter of ["\t", ";", ","]) {
    const [heading, ...rows] = cellsOf(table, delimiter);
    if (heading && NEEDED.every((column) => heading.includes(column))) return { name, delimiter, heading, rows };
  }
  return null;
}

export function textOf({ delimiter, heading, rows }: Sheet): string {
  const written = (text: string) =>
    /["\r\n]/.test(text) || text.includes(delimiter) ? `"${text.replaceAll('"', '""')}"` : text;
  const line = (row: string[]) =>
    [...row, ...heading.slice(row.length).fill("")].map(written).join(delimiter); // none is lost
  return [heading, ...rows].map(line).join("\n") + "\n";
}

/** Line of a row in the text. */
export const lineOf = (row: number) => row + 2;

export const cell = (sheet: Sheet, row: number, column: string) =>
  sheet.rows[row]?.[sheet.heading.indexOf(column)] ?? "";

/** The sheet with other cells in a column, which is added where there is none. */
export function withCells(sheet: Sheet, rows: number[], column: string, text: string): Sheet {
  const heading = sheet.heading.includes(column) ? sheet.heading : [...sheet.heading, column];
  const at = heading.indexOf(column);
  return {
    ...sheet,
    heading,
    rows: sheet.rows.map((row, i) => {
      if (!rows.includes(i)) return row;
      const whole = heading.map((_, k) => row[k] ?? "");
      whole[at] = text;
      return whole;
    }),
  };
}

/** The sheet with a row for each of the `count` tests that a row's file holds. */
export function withParts(sheet: Sheet, row: number, count: number): Sheet {
  const whole = withCells(sheet, [row], "part", "");
  const [part, specimen] = ["part", "specimen"].map((column) => whole.heading.indexOf(column));
  const parts = Array.from({ length: count }, (_, i) => {
    const cells = [...whole.rows[row]];
    cells[part] = String(i + 1);
    cells[specimen] = `${cells[specimen]}-${i + 1}`;
    return cells;
  });
  return { ...whole, rows: whole.rows.flatMap((cells, i) => (i === row ? parts : [cells])) };
}

/** The columns of a sheet that the page builds. */
const BUILT = [
  "file", "specimen", "pattern", "test", "width_mm", "thickness_mm", "gauge_mm", "orientation_deg",
  "planned_strain_rate_per_s", "batch", "order_id",
];

/** A specimen that is still to be tested. */
interface Slot {
  label: string;
  order: Order;
}

const plain = (text: string) => text.toLowerCase().replace(/[^a-z0-9]+/g, "-");
const stemOf = (file: string) => file.replace(/\.[^.]*$/, "");
/** Whether a name holds another as a word of its own: `b-1` is in `mts-b-1` and not in `b-12`. */
const holds = (name: string, word: string) => word !== "" && `-${plain(name)}-`.includes(`-${plain(word)}-`);

/** Specimens of open orders that nobody has measured and that are not in the sheet: those with labels, then those that
 *  are not printed yet. */
function slotsOf({ orders, printed, specimens }: Laboratory, sheet: Sheet): Slot[] {
  const places = [...sheet.rows.keys()];
  const measured = new Set([...specimens.map((s) => s.specimen), ...places.map((i) => cell(sheet, i, "specimen"))]);
  return orders
    .filter((order) => !order.complete)
    .flatMap((order) => {
      const labels = printed.filter((p) => p.order === order.order && !measured.has(p.label)).map((p) => p.label);
      const listed = places.filter((i) => cell(sheet, i, "order_id") === order.order).length;
      const others = Math.max(0, order.replicates - order.arrived - labels.length - listed);
      return [...labels, ...Array<string>(others).fill("")].map((label) => ({ label, order }));
    });
}

/** How well a file's name fits a slot: its label, its design and test, or nothing. */
function fit(file: string, { label, order }: Slot): number {
  const stem = stemOf(file);
  if (holds(stem, label)) return 100 + label.length;
  const key = order.design.slice(0, 8);
  if (!holds(stem, order.design) && !plain(stem).includes(key)) return 0;
  const test = /mod|young|e-?test/i.test(stem) ? "modulus" : /tough|notch|tear/i.test(stem) ? "toughness" : order.test;
  return test === order.test ? 10 : 0;
}

const NO_ROWS: Sheet = { name: "specimens.csv", delimiter: ",", heading: BUILT, rows: [] };

/** The sheet with a row for each file that it does not name: the specimen of the open order that the file's name tells,
 *  else of the next one that is free. `guessed`: specimens whose order only their place among the files tells. */
export function sheetOfOrders(
  files: string[],
  laboratory: Laboratory,
  before: Sheet | null,
): { sheet: Sheet; guessed: string[] } {
  const sheet = before ?? NO_ROWS;
  const free = slotsOf(laboratory, sheet);
  const listed = new Set(sheet.rows.map((_, i) => cell(sheet, i, "file")));
  const sorted = files.filter((file) => !listed.has(file)).sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
  const taken = new Map<string, Slot>();
  const take = (file: string, slot: Slot | undefined) => {
    if (!slot) return;
    free.splice(free.indexOf(slot), 1);
    taken.set(file, slot);
  };
  for (const file of sorted) {
    const fitting = free.filter((slot) => fit(file, slot) > 0).sort((a, b) => fit(file, b) - fit(file, a));
    take(file, fitting[0]);
  }
  const named = new Set(taken.keys());
  for (const file of sorted) if (!taken.has(file)) take(file, free[0]);
  const rows = sorted.map((file) => {
    const slot = taken.get(file);
    if (!slot) return BUILT.map((column) => (column === "file" ? file : column === "specimen" ? stemOf(file) : ""));
    const { order, label } = slot;
    const specimen = label || stemOf(file);
    return [
      file, specimen, order.design, order.test, order.width_mm, order.thickness_mm, order.gauge_mm,
      order.orientation_deg, order.strain_rate_per_s, order.batch, order.order,
    ].map(String);
  });
  const guessed = rows.filter(([file]) => taken.has(file) && !named.has(file)).map((row) => row[1]);
  const asInSheet = (row: string[]) => sheet.heading.map((column) => row[BUILT.indexOf(column)] ?? "");
  return { sheet: { ...sheet, rows: [...sheet.rows, ...rows.map(asInSheet)] }, guessed };
}
