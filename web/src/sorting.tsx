// The rows of a table, put in order by a column and narrowed to those that hold what somebody types.

import type { ComponentChildren } from "preact";
import { useMemo, useState } from "preact/hooks";

/** What a column says of a row. */
export interface Sortable<Row> {
  heading: string;
  /** What the heading means, as a tooltip. */
  hint?: string;
  /** What the cell shows; absent: the column is in the file alone. */
  show?: (row: Row) => ComponentChildren;
  /** What the file holds, in SI units; absent: the column is on the screen alone. */
  value?: (row: Row) => unknown;
  /** What the rows are put in order by, where that is not `value`. */
  order?: (row: Row) => unknown;
  words?: boolean;
  /** Not shown where the screen is narrow. */
  minor?: boolean;
}

/** The class of a column's cells. */
export const cellClass = ({ words, minor }: { words?: boolean; minor?: boolean }) =>
  [words && "words", minor && "minor"].filter(Boolean).join(" ");

/** By which column, by its heading; null: as the rows come. */
type Order = { heading: string; descending: boolean } | null;

/** From so many rows on a field finds some of them. */
const FEW_ROWS = 6;

const isUnknown = (value: unknown) =>
  value === null || value === undefined || value === "" || (typeof value === "number" && Number.isNaN(value));

const inWords = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

/** Numbers by size, texts by the alphabet and the numbers in them. */
function compared(a: unknown, b: unknown): number {
  if (typeof a === "number" && typeof b === "number") return a - b;
  return inWords.compare(String(a), String(b));
}

/** The rows in order, unknown values last; rows that do not differ stay as they come. */
export function inOrder<Row>(rows: Row[], valueOf: (row: Row) => unknown, descending: boolean): Row[] {
  const valued = rows.map((row) => ({ row, value: valueOf(row) }));
  const known = valued.filter((each) => !isUnknown(each.value));
  known.sort((a, b) => (descending ? -1 : 1) * compared(a.value, b.value));
  return [...known, ...valued.filter((each) => isUnknown(each.value))].map((each) => each.row);
}

/** All texts of a row, as its cells and its file have them. */
function textOf<Row>(row: Row, columns: Sortable<Row>[]): string {
  const texts = columns.flatMap((c) => [c.show?.(row), c.value?.(row)]);
  return texts.filter((text) => typeof text === "string" || typeof text === "number").join(" ").toLowerCase();
}

/** Rows that hold every word of `find`. */
export function found<Row>(rows: Row[], columns: Sortable<Row>[], find: string): Row[] {
  const words = find.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length === 0) return rows;
  return rows.filter((row) => {
    const text = textOf(row, columns);
    return words.every((word) => text.includes(word));
  });
}

interface Sorting<Row> {
  /** The rows to show. */
  shown: Row[];
  order: Order;
  /** The next order by a column: rising, falling, as the rows come. */
  turn: (heading: string) => void;
  find: string;
  setFind: (find: string) => void;
}

/** Which rows somebody wants to see, and in which order. */
export function useSorting<Row>(rows: Row[], columns: Sortable<Row>[]): Sorting<Row> {
  const [order, setOrder] = useState<Order>(null);
  const [find, setFind] = useState("");
  const shown = useMemo(() => {
    const wanted = found(rows, columns, find);
    const by = order && columns.find((c) => c.heading === order.heading && c.show);
    const valueOf = by?.order ?? by?.value;
    return valueOf ? inOrder(wanted, valueOf, order!.descending) : wanted;
  }, [rows, columns, find, order]);
  const turn = (heading: string) =>
    setOrder((now) =>
      now?.heading !== heading ? { heading, descending: false } : now.descending ? null : { heading, descending: true },
    );
  return { shown, order, turn, find, setFind };
}

/** A column's heading: a button that puts the rows in order, where the column can. */
export function Heading<Row>(
  { column, order, turn }: { column: Sortable<Row> } & Pick<Sorting<Row>, "order" | "turn">,
) {
  const { heading, hint } = column;
  const text = hint ? <span class="term">{heading}</span> : heading;
  const way = order?.heading !== heading ? "none" : order.descending ? "descending" : "ascending";
  const canSort = column.order !== undefined || column.value !== undefined;
  return (
    <th class={cellClass(column)} scope="col" title={hint} aria-sort={canSort ? way : undefined}>
      {canSort ? (
        <button type="button" class="sort" onClick={() => turn(heading)}>
          {text}
        </button>
      ) : (
        text
      )}
    </th>
  );
}

/** The field that finds rows, and how many it has found; nothing of a table that is seen at a glance. */
export function FindRows<Row>(
  { caption, rows, shown, find, setFind }: { caption: string; rows: Row[] } & Omit<Sorting<Row>, "order" | "turn">,
) {
  if (rows.length < FEW_ROWS && find === "") return null;
  return (
    <span class="find">
      <input
        type="search"
        aria-label={`find in ${caption}`}
        placeholder="find"
        value={find}
        onInput={(e) => setFind(e.currentTarget.value)}
      />
      <span class="quiet" role="status">
        {find.trim() !== "" && `${shown.length} of ${rows.length}`}
      </span>
    </span>
  );
}
