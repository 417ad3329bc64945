// Small parts that every view uses.

import { Fragment, type ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { MATERIAL } from "./colour";
import { figure, sentence } from "./numbers";
import { pixelsOf, rigidPath, SIDE } from "./pattern";
import { saveCsv, saveSvg } from "./save";
import { cellClass, FindRows, Heading, useSorting, type Sortable } from "./sorting";

/** One unit of a design, drawn from its name in the colours of the materials; mixtures in their shade. */
export function Unit({ design, size, label = true }: { design: string; size: number; label?: boolean }) {
  const pixels = pixelsOf(design);
  return (
    <svg
      class="unit"
      viewBox={`0 0 ${SIDE} ${SIDE}`}
      width={size}
      height={size}
      role={label ? "img" : undefined}
      aria-label={label ? `pattern ${design}` : undefined}
      aria-hidden={label ? undefined : "true"}
      shape-rendering="crispEdges"
    >
      <rect width={SIDE} height={SIDE} fill={MATERIAL.soft} />
      {pixels ? (
        <path d={rigidPath(pixels)} fill={MATERIAL.rigid} />
      ) : (
        <rect width={SIDE} height={SIDE} fill={MATERIAL.rigid} opacity={mixtureShare(design)} />
      )}
    </svg>
  );
}

/** The colours of the materials, for pictures of patterns. */
export function MaterialKey() {
  return (
    <ul class="keys materials" aria-label="colours of the materials">
      {(["rigid", "soft"] as const).map((material) => (
        <li key={material}>
          <span class="swatch" style={{ "--c": MATERIAL[material] } as never} /> {material}
        </li>
      ))}
    </ul>
  );
}

/** A pattern to choose, with its E in GPa and T in MPa. */
export function UnitButton(
  { design, values, choose }: { design: string; values: [string, string]; choose: () => void },
) {
  return (
    <button type="button" class="unit-button" onClick={choose}>
      <Unit design={design} size={70} />
      <span>
        E {values[0]} GPa
        <br />T {values[1]} MPa
      </span>
    </button>
  );
}

function mixtureShare(design: string): number {
  return { soft: 0, interface: 0.5, rigid: 1 }[design] ?? Number(design.replace("mix:", ""));
}

export function saveUnit(design: string): void {
  const pixels = pixelsOf(design);
  if (!pixels) return;
  saveSvg(
    design,
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${SIDE} ${SIDE}" width="400" height="400" ` +
      `shape-rendering="crispEdges"><rect width="${SIDE}" height="${SIDE}" fill="${MATERIAL.soft}"/>` +
      `<path d="${rigidPath(pixels)}" fill="${MATERIAL.rigid}"/></svg>\n`,
    `pattern ${design}`,
  );
}

/** A design's name as people read it: keys in fixed width, a coupon's shortened. */
export function Name({ design }: { design: string }) {
  const short = design.length > 30 ? `${design.slice(0, 12)}…` : design;
  return (
    <code class="key" title={short === design ? undefined : design}>
      {short}
    </code>
  );
}

/** One column on the screen, in the CSV, or in both. */
export interface Column<Row> extends Sortable<Row> {
  /** The column's name in the file where it is not the heading. */
  csv?: string;
}

/** So many rows are drawn at once: thousands take a browser seconds. */
const MOST_ROWS = 500;

/** A row of its own below another one, brought into sight. */
function Detail({ columns, children }: { columns: number; children: ComponentChildren }) {
  const row = useRef<HTMLTableRowElement>(null);
  useEffect(() => row.current?.scrollIntoView({ block: "nearest" }), [!children]);
  if (!children) return null;
  return (
    <tr class="detail" ref={row}>
      <td class="words" colSpan={columns}>
        {children}
      </td>
    </tr>
  );
}

/** A table that can be put in order and searched, with the CSV of what it shows. */
export function Table<Row>({
  name,
  caption,
  columns,
  rows,
  rowKey,
  empty,
  rowClass,
  chosen,
  detail,
}: {
  name: string;
  caption: string;
  columns: Column<Row>[];
  rows: Row[];
  rowKey: (row: Row) => string;
  empty: string;
  rowClass?: (row: Row) => string;
  /** The key of a row that somebody was led to: it stands out and in sight. */
  chosen?: string;
  /** What is shown below a row; null: nothing. */
  detail?: (row: Row) => ComponentChildren;
}) {
  const [isWhole, setWhole] = useState(false);
  const led = useRef<HTMLTableRowElement>(null);
  useEffect(() => led.current?.scrollIntoView({ block: "center" }), [chosen, rows.length > 0]);
  const sorting = useSorting(rows, columns);
  const wanted = sorting.shown;
  const first = isWhole ? wanted : wanted.slice(0, MOST_ROWS);
  const beyond = chosen === undefined ? undefined : wanted.slice(first.length).find((row) => rowKey(row) === chosen);
  const drawn = beyond === undefined ? first : [beyond, ...first];
  const shown = columns.filter((column) => column.show);
  const stored = columns.filter((column) => column.value);
  return (
    <div class="table">
      <div class="table-head">
        <h3>{caption}</h3>
        <FindRows caption={caption} rows={rows} {...sorting} />
        {rows.length > 0 && stored.length > 0 && (
          <button
            type="button"
            class="quiet"
            aria-label={`${caption} as CSV`}
            onClick={() =>
              saveCsv(
                name,
                stored.map((c) => c.csv ?? c.heading),
                wanted.map((row) => stored.map((c) => c.value!(row))),
              )
            }
          >
            CSV
          </button>
        )}
      </div>
      {rows.length === 0 ? (
        <p class="awaited">{empty}</p>
      ) : (
        <div class="wide" tabIndex={0} role="region" aria-label={caption}>
          <table>
            <thead>
              <tr>
                {shown.map((c) => (
                  <Heading key={c.heading} column={c} {...sorting} />
                ))}
              </tr>
            </thead>
            <tbody>
              {drawn.map((row) => (
                <Fragment key={rowKey(row)}>
                  <tr
                    ref={rowKey(row) === chosen ? led : undefined}
                    class={rowClass?.(row)}
                    aria-current={rowKey(row) === chosen ? "true" : undefined}
                  >
                    {shown.map((c) => (
                      <td key={c.heading} class={cellClass(c)}>
                        {c.show!(row)}
                      </td>
                    ))}
                  </tr>
                  <Detail columns={shown.length}>{detail?.(row)}</Detail>
                </Fragment>
              ))}
            </tbody>
          </table>
        </div>
      )}
      {rows.length > 0 && wanted.length === 0 && <p class="awaited">No row contains “{sorting.find}”.</p>}
      {drawn.length < wanted.length && (
        <button type="button" class="quiet" onClick={() => setWhole(true)}>
          show all {wanted.length.toLocaleString("en")} rows
        </button>
      )}
    </div>
  );
}

/** Why a design is proposed: sentences, the warning among them marked. */
export function Reason({ text, before = "" }: { text: string; before?: string }) {
  const [reason, warning] = text.split("; warning: ");
  return (
    <>
      {(before || reason) && (
        <p class="quiet">
          {before} {reason && `${sentence(reason)}.`}
        </p>
      )}
      {warning && <p class="doubt reason">Warning: {warning}.</p>}
    </>
  );
}

const DESIGN_STATES: Record<string, string> = {
  "waits for approval": "The game asks for a yes or no.",
  proposed: "Proposed, not ordered yet.",
  approved: "Ordered from the laboratory, nothing printed yet.",
  printed: "Printed, not all of it measured yet.",
  measured: "All that was ordered is measured.",
  rejected: "A person said no: it is not measured.",
  withdrawn: "A person said that what is missing cannot be made.",
};

/** How far a design has got, as `nacre designs` calls it; `waits`: the game goes on and asks for approvals. */
export function DesignChip({ state, waits }: { state: string; waits: boolean }) {
  const words = state !== "pending" ? state : waits ? "waits for approval" : "proposed";
  return (
    <span class={`chip ${state}`} title={DESIGN_STATES[words]}>
      {words}
    </span>
  );
}

/** A share from 0 to 1; an unknown one shows as a quiet bar. */
export function Bar({ share, label }: { share: number | null; label: string }) {
  return (
    <div
      class={`bar${share === null ? " unknown" : ""}`}
      role="progressbar"
      aria-label={label}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuenow={share === null ? undefined : Math.round(100 * share)}
    >
      <span style={{ width: `${100 * (share ?? 0)}%` }} />
    </div>
  );
}

export interface NoticeText {
  kind: "good" | "bad" | "busy";
  text: string;
}

/** What came of something submitted; screen readers read it out. */
export function Notice({ notice }: { notice: NoticeText | null }) {
  return (
    <p class={`notice ${notice?.kind ?? ""}`} role="status" aria-live="polite">
      {notice?.text ?? ""}
    </p>
  );
}

/** Why something could not be read from the server; nothing where it could. */
export function Problem({ text }: { text: string }) {
  if (!text) return null;
  return (
    <p class="notice bad" role="status">
      {text}
    </p>
  );
}

/** In place of what an address names and the run has not; `link`: where to go on. */
export function Nowhere({ why, link, words = "Show what there is" }: { why: string; link: string; words?: string }) {
  return (
    <p class="wait" role="status">
      {why} <a href={link}>{words}</a>
    </p>
  );
}

/** The same of a round that is not there. */
export function NoSuchRound({ wanted, rounds, link }: { wanted: string; rounds: number[]; link: string }) {
  const there = rounds.length > 1 ? `rounds ${rounds[0]} to ${rounds.at(-1)}` : `round ${rounds[0]}`;
  const why = rounds.length === 0 ? "has no round yet" : `has ${there}`;
  return <Nowhere why={`There is no round ${wanted} here: this run ${why}.`} link={link} />;
}

/** In place of a view until the server has responded: that it is being read, or why it cannot be. */
export function Awaited({ problem, what = "reading …" }: { problem: string; what?: string }) {
  return (
    <p class={`wait ${problem ? "notice bad" : "awaited"}`} role="status">
      {problem || what}
    </p>
  );
}

/** How a test differs from the standard one of its design; the server says which that is. */
export function unusual(test: {
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard?: boolean;
}): string {
  const turned = test.orientation_deg ? ", turned" : "";
  if (test.standard !== false) return turned;
  return `${turned}, at ${figure(test.strain_rate_per_s)} /s, ${figure(test.thickness_mm)} mm thick`;
}

/** State that lives in the browser's storage, for the name of the person and the theme. */
export function useStored(key: string, initial: string): [string, (value: string) => void] {
  const [value, setValue] = useState(() => localStorage.getItem(`nacre.${key}`) ?? initial);
  return [
    value,
    (next) => {
      localStorage.setItem(`nacre.${key}`, next);
      setValue(next);
    },
  ];
}

/** Calls `task` every `ms` while the page is visible and `active`, never twice at a time. A task reports its own
 *  problems; one that throws is a fault of the page, which goes on all the same. */
export function useRepeated(task: () => Promise<void>, ms: number, active = true): void {
  const latest = useRef(task);
  latest.current = task;
  useEffect(() => {
    if (!active) return;
    let stopped = false;
    let timer = 0;
    const turn = async () => {
      if (!document.hidden) await latest.current().catch(reportError);
      if (!stopped) timer = window.setTimeout(turn, ms);
    };
    void turn();
    return () => {
      stopped = true;
      clearTimeout(timer);
    };
  }, [ms, active]);
}
