// What is understood of each specimen's file, with its curve, and the cells of its row to correct.

import { Fragment } from "preact";
import { useState } from "preact/hooks";
import type { Laboratory, UnderstoodSpecimen } from "./api";
import { inWords, type Row } from "./import_draft";
import { figure, GPA, mpa, percent, withError } from "./numbers";
import { Name, Unit } from "./parts";
import { cell, type Sheet } from "./sheet";

/** A curve as a picture of a few pixels, from zero to its largest strain and stress. */
function Curve({ one }: { one: UnderstoodSpecimen }) {
  const { strain, stress_pa } = one.curve;
  if (strain.length === 0) return <>–</>;
  const [width, height] = [96, 36];
  const [left, right] = [Math.min(0, ...strain), Math.max(...strain)];
  const [low, high] = [Math.min(0, ...stress_pa), Math.max(...stress_pa)];
  const points = strain.map(
    (x, i) =>
      `${(((x - left) / (right - left || 1)) * width).toFixed(1)},` +
      `${(height - ((stress_pa[i] - low) / (high - low || 1)) * height).toFixed(1)}`,
  );
  return (
    <svg
      class="sparkline"
      viewBox={`-1 -1 ${width + 2} ${height + 2}`}
      role="img"
      aria-label={`${one.specimen}: stress to ${mpa(one.peak_stress_pa)} MPa over strain to ${percent(right)}`}
    >
      <polyline points={points.join(" ")} />
    </svg>
  );
}

/** E with its standard error, where that is large enough to be seen. */
function modulusOf({ modulus_pa, modulus_error_pa }: UnderstoodSpecimen): string {
  const LEAST_SHOWN = 1e-4;
  const error_pa = modulus_error_pa ?? 0;
  const isShown = error_pa >= LEAST_SHOWN * modulus_pa;
  return isShown ? withError(GPA * modulus_pa, GPA * error_pa) : figure(GPA * modulus_pa, 4);
}

/** `Force (kN)`: the column and the unit that were taken. */
function takenColumns({ columns }: UnderstoodSpecimen): string {
  return ["time", "extension", "force", "strain", "stress"]
    .filter((quantity) => columns[`${quantity}_column`] !== undefined)
    .map((quantity) => `${quantity}: ${columns[`${quantity}_column`]} [${columns[`${quantity}_unit`]}]`)
    .join(", ");
}

function stateOf(row: Row, isKnown: boolean): [string, string] {
  if (row.answer && !["accepted", "repeated"].includes(row.answer.answer)) return ["rejected", row.answer.answer];
  if (row.answer || isKnown) return ["measured", "in the run"];
  if (row.isLeftOut) return ["", "left out"];
  if (row.understood.length === 0) return ["rejected", "not read"];
  if (row.isOpen) return ["pending", "asked above"];
  return row.understood.some((one) => !one.valid) ? ["pending", "not valid"] : ["approved", "ready"];
}

/** Columns of a row that are not in its sheet and may be needed. */
const OFTEN_NEEDED = ["part", "unit", "extension_column", "force_column", "note"];

function RowEditor({
  sheet,
  row,
  edit,
}: {
  sheet: Sheet;
  row: Row;
  edit: (rows: number[], column: string, text: string) => void;
}) {
  const columns = [...sheet.heading.filter((c) => c !== ""), ...OFTEN_NEEDED.filter((c) => !sheet.heading.includes(c))];
  return (
    <div class="measurement cells">
      {columns.map((column) => (
        <label key={column}>
          {column}
          <input
            value={cell(sheet, row.index, column)}
            maxLength={200}
            onInput={(e) => edit([row.index], column, e.currentTarget.value)}
          />
        </label>
      ))}
    </div>
  );
}

function Details({ row, sheet, edit }: Parameters<typeof RowEditor>[0]) {
  return (
    <>
      {row.fault && <p class="fault">{inWords(row.fault)}</p>}
      {row.answer?.error && <p class="fault">{row.answer.error}</p>}
      {row.understood.slice(0, 1).map((one) => (
        <div key={one.specimen}>
          <p>
            {takenColumns(one)}; gauge {one.gauge_mm} mm, strain rate {one.strain_rate_per_s} /s ({one.rate_source}),
            peak {mpa(one.peak_stress_pa)} MPa, failure at {percent(one.failure_strain)}, toe{" "}
            {percent(one.toe_strain, 3)}
          </p>
          {[...one.decisions, ...(one.note ? [one.note] : [])].map((text) => (
            <p key={text} class="quiet">
              {text}
            </p>
          ))}
          {one.doubts.map(({ text }) => (
            <p key={text} class="doubt">
              {text}
            </p>
          ))}
        </div>
      ))}
      <RowEditor sheet={sheet} row={row} edit={edit} />
    </>
  );
}

export function ImportTable({
  sheet,
  rows,
  laboratory,
  edit,
  leaveOut,
}: {
  sheet: Sheet;
  rows: Row[];
  laboratory: Laboratory;
  edit: (rows: number[], column: string, text: string) => void;
  leaveOut: (specimen: string, out: boolean) => void;
}) {
  const [opened, setOpened] = useState(-1);
  const known = new Set(laboratory.specimens.map((s) => s.specimen));
  return (
    <div class="wide" tabIndex={0} role="region" aria-label="what is understood of the files">
      <table class="understood">
        <thead>
          <tr>
            <th class="words" scope="col">specimen</th>
            <th scope="col">curve</th>
            <th scope="col">E / GPa</th>
            <th scope="col">T / MPa</th>
            <th class="words" scope="col">state</th>
            <th class="words secondary" scope="col">design</th>
            <th class="words secondary" scope="col">test</th>
            <th class="secondary" scope="col">peak / MPa</th>
            <th class="secondary" scope="col">toe</th>
            <th class="words secondary" scope="col">file</th>
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => {
            const [one] = row.understood;
            const isOpened = opened === row.index;
            const isKnown = row.understood.length > 0 && row.understood.every((s) => known.has(s.specimen));
            const [chip, state] = stateOf(row, isKnown);
            return (
              <Fragment key={row.index}>
                <tr class={row.isLeftOut ? "invalid" : ""}>
                  <td class="words">
                    <input
                      type="checkbox"
                      aria-label={`hand in ${row.specimen}`}
                      checked={!row.isLeftOut}
                      onChange={(e) => leaveOut(row.specimen, !e.currentTarget.checked)}
                    />{" "}
                    <button
                      type="button"
                      class="link"
                      aria-expanded={isOpened}
                      onClick={() => setOpened(isOpened ? -1 : row.index)}
                    >
                      {row.specimen || `row ${row.index + 1}`}
                    </button>
                    {row.understood.length > 1 && ` (${row.understood.length} of a sweep)`}
                  </td>
                  <td>{one ? <Curve one={one} /> : "–"}</td>
                  <td>{one ? modulusOf(one) : "–"}</td>
                  <td>{one && one.test === "toughness" ? mpa(one.toughness_pa) : "–"}</td>
                  <td class="words">
                    <span class={`chip ${chip}`}>{state}</span>
                  </td>
                  <td class="words secondary">
                    <span class="with-unit">
                      <Unit design={one?.pattern ?? cell(sheet, row.index, "pattern")} size={22} label={false} />
                      <Name design={one?.pattern ?? cell(sheet, row.index, "pattern")} />
                    </span>
                  </td>
                  <td class="words secondary">
                    {one?.test ?? cell(sheet, row.index, "test")}
                    {one && one.orientation_deg !== 0 && ", turned"}
                  </td>
                  <td class="secondary">{mpa(one?.peak_stress_pa)}</td>
                  <td class="secondary">{percent(one?.toe_strain, 2)}</td>
                  <td class="words secondary">
                    {cell(sheet, row.index, "file")} <span class="quiet">{one?.maker}</span>
                  </td>
                </tr>
                {isOpened && (
                  <tr>
                    <td class="words details" colSpan={10}>
                      <Details row={row} sheet={sheet} edit={edit} />
                    </td>
                  </tr>
                )}
              </Fragment>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}
