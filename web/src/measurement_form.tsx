// One measured specimen, typed in.

import { useEffect, useState } from "preact/hooks";
import type { Laboratory, Order } from "./api";
import { ConditionFields } from "./condition_fields";
import { typedNumber } from "./numbers";
import { useDraft } from "./kept_draft";
import { Notice } from "./parts";
import { useSubmit } from "./submit";

export const EMPTY = {
  specimen: "",
  pattern: "",
  test: "toughness",
  value: "",
  batch: "",
  orientation_deg: "0",
  strain_rate_per_s: "",
  thickness_mm: "",
  note: "",
  valid: true,
  curve_csv: "",
};

export type Form = typeof EMPTY;

export const measuredName = (test: string) => (test === "modulus" ? "Young's modulus" : "Toughness");
export const unitOf = (test: string) => (test === "modulus" ? "GPa" : "MPa");

/** The fields by the columns that the server names. */
const FIELDS: Record<string, { label: string; field: keyof Form; unit?: string }> = {
  specimen: { label: "Specimen", field: "specimen" },
  pattern: { label: "Pattern", field: "pattern" },
  test: { label: "Test", field: "test" },
  modulus_pa: { label: "Young's modulus", field: "value", unit: "GPa" },
  toughness_pa: { label: "Toughness", field: "value", unit: "MPa" },
  batch: { label: "Batch", field: "batch" },
  orientation_deg: { label: "Orientation", field: "orientation_deg" },
  thickness_mm: { label: "Thickness", field: "thickness_mm", unit: "mm" },
  strain_rate_per_s: { label: "Strain rate", field: "strain_rate_per_s", unit: "/s" },
  note: { label: "Note", field: "note" },
};

/** The server's sentence about a column in the words of the form: the field's label, and what was typed there. */
export function inWordsOfForm(sentence: string, form: Form): string {
  const [, column, rest] = /^(?:column )?(\w+): ([\s\S]*)$/.exec(sentence) ?? [];
  const known = column ? FIELDS[column] : undefined;
  if (!known) return column === "curve" ? `Curve: ${rest}` : sentence;
  const labelled = Object.entries(FIELDS)
    .filter(([name]) => name.includes("_")) // others are words, too
    .reduce((text, [name, { label }]) => text.replaceAll(name, label), rest);
  const typed = String(form[known.field]).trim();
  const value = typed ? `“${typed}”${known.unit ? ` ${known.unit}` : ""}` : "left empty";
  return `${known.label}, ${value}: ${labelled}`;
}

/** The first field with a number that cannot be read; null: none. */
export function unreadable(form: Form): { field: keyof Form; text: string } | null {
  const labels = { value: measuredName(form.test), thickness_mm: "Thickness", strain_rate_per_s: "Strain rate" };
  for (const field of ["value", "thickness_mm", "strain_rate_per_s"] as const) {
    if (form[field].trim() === "" || typedNumber(form[field]) !== null) continue;
    const text = `${labels[field]}: “${form[field]}” is not a number; write it without a unit, such as 0.17.`;
    return { field, text };
  }
  return null;
}

/** The form as a row of a measurement set, in its units. */
export function rowOf({ value, ...rest }: Form) {
  const measured = typedNumber(value);
  const inPascal = (factor: number) => (measured === null ? null : measured * factor);
  return {
    ...rest,
    thickness_mm: typedNumber(rest.thickness_mm),
    strain_rate_per_s: typedNumber(rest.strain_rate_per_s),
    ...(rest.test === "modulus" ? { modulus_pa: inPascal(1e9) } : { toughness_pa: inPascal(1e6) }),
  };
}

/** A name for the next specimen of an order that no specimen has yet. */
function nextName(order: Order, taken: Set<string>): string {
  const turned = order.orientation_deg ? "-turned" : "";
  const stem = `${order.batch || "hand"}-${order.design.slice(0, 8)}-${order.test}${turned}`;
  let number = order.arrived + 1;
  while (taken.has(`${stem}-${number}`)) ++number;
  return `${stem}-${number}`;
}

/** Fields with another value than the order's: the form no longer belongs to it. */
const ASKED = ["pattern", "test", "orientation_deg"];

/** Rows of a curve file below its heading. */
const rowsIn = (csv: string) => csv.split("\n").filter((line) => line.trim() !== "").length - 1;

/** The form, the order that it belongs to, and what came of it. */
function useForm(laboratory: Laboratory, refresh: () => Promise<void>) {
  const [form, setForm] = useDraft("measurement", EMPTY);
  const [fileName, setFileName] = useDraft("measurement/file", "");
  const [chosen, setChosen] = useDraft("measurement/order", "");
  const [fault, setFault] = useState<{ field?: keyof Form; text: string } | null>(null);
  const [count, setCount] = useState(0); // of measurements submitted
  const [files, setFiles] = useState(0); // of files chosen and dropped again
  const [notice, busy, submit] = useSubmit(refresh);
  const set = (name: keyof Form) => (event: { currentTarget: { value: string } }) =>
    setForm({ ...form, [name]: event.currentTarget.value });
  /** The same for what an order asks for: with another value the form no longer belongs to the chosen order. */
  const setAsked = (name: keyof Form) => (event: { currentTarget: { value: string } }) => {
    const order = orderOf(chosen);
    const isNamedByOrder = order !== undefined && form.specimen === nameFor(order);
    setChosen("");
    setForm({
      ...form,
      specimen: isNamedByOrder ? "" : form.specimen,
      value: name === "test" ? "" : form.value, // in another unit
      [name]: event.currentTarget.value,
    });
  };
  const forget = () => {
    setFileName("");
    setFiles(files + 1);
  };
  const open = laboratory.orders.filter((o) => !o.complete && !o.withdrawn);
  const orderOf = (id: string) => open.find((o) => o.order === id);
  const nameFor = (order: Order) => nextName(order, new Set(laboratory.specimens.map((s) => s.specimen)));
  const take = (id: string) => {
    setChosen(id);
    const order = orderOf(id);
    if (!order) return;
    forget();
    setForm({
      ...EMPTY, // what was typed belongs to another specimen
      pattern: order.design,
      test: order.test,
      batch: order.batch,
      orientation_deg: String(order.orientation_deg),
      strain_rate_per_s: String(order.strain_rate_per_s),
      thickness_mm: String(order.thickness_mm),
      specimen: nameFor(order),
    });
  };
  // The next replicate of the order, named once the one before has arrived.
  useEffect(() => {
    const order = orderOf(chosen);
    if (order) setForm((now) => ({ ...now, specimen: nameFor(order) }));
  }, [count]);
  const readCurve = async (file: File | undefined) => {
    setFileName(file?.name ?? "");
    const curve_csv = file ? await file.text() : "";
    setForm((now) => ({ ...now, curve_csv }));
  };
  const send = async (event: Event) => {
    event.preventDefault();
    const isEmptyFile = fileName !== "" && rowsIn(form.curve_csv) < 1;
    const wrong = isEmptyFile ? { text: `Curve: ${fileName} has no rows.` } : unreadable(form);
    setFault(wrong);
    if (wrong) return;
    const done = `${form.specimen} was added to the run.`;
    const explain = (sentence: string) => inWordsOfForm(sentence, form);
    if (!(await submit("/api/measurement", rowOf(form), done, explain))) return;
    // What was filled in meanwhile stays.
    setForm((now) => ({ ...now, specimen: "", value: "", note: "", valid: true, curve_csv: "" }));
    forget();
    setCount(count + 1);
  };
  return {
    form,
    fileName,
    files,
    open,
    chosen: orderOf(chosen) ? chosen : "",
    notice: fault ? { kind: "bad" as const, text: fault.text } : notice,
    isFaulty: (field: keyof Form) => (fault?.field === field ? "true" : undefined),
    busy,
    set,
    setAsked,
    setValid: (valid: boolean) => setForm({ ...form, valid }),
    take,
    readCurve,
    send,
  };
}

export function MeasurementForm({
  laboratory,
  refresh,
  playing,
}: {
  laboratory: Laboratory;
  refresh: () => Promise<void>;
  playing: boolean;
}) {
  const { form, set, setAsked, ...entered } = useForm(laboratory, refresh);
  return (
    <section class="panel">
      <h2>Enter a measurement</h2>
      {!playing ? (
        <p class="awaited">Measurements can be entered while the game is running.</p>
      ) : (
        <form onSubmit={entered.send} class="measurement">
          {entered.open.length > 0 && (
            <label class="whole">
              For an open order
              <select name="order" value={entered.chosen} onChange={(e) => entered.take(e.currentTarget.value)}>
                <option value="">choose, or fill in by hand</option>
                {entered.open.map((o) => (
                  <option key={o.order} value={o.order}>
                    {o.design.slice(0, 16)} · {o.test}
                    {o.orientation_deg ? " turned" : ""}
                    {o.loading === "monotonic" ? "" : ` (${o.loading})`} · {o.arrived} of {o.replicates} measured
                  </option>
                ))}
              </select>
            </label>
          )}
          <label>
            Specimen{" "}
            <input
              required
              name="specimen"
              maxLength={100}
              value={form.specimen}
              onInput={set("specimen")}
              placeholder="a name of its own"
            />
          </label>
          <ConditionFields
            form={form}
            set={(field) => (ASKED.includes(field) ? setAsked : set)(field)}
            isFaulty={entered.isFaulty}
            hints={{
              value: "or from the curve",
              pattern: "key, rigid, soft, mix:0.65",
              thickness_mm: "3.2",
              strain_rate_per_s: "6.17e-4",
            }}
          />
          <label>
            Batch <input value={form.batch} maxLength={60} onInput={set("batch")} />
          </label>
          <label class="whole">
            Curve{" "}
            <input
              key={entered.files}
              type="file"
              accept=".csv,text/csv"
              onChange={(e) => entered.readCurve(e.currentTarget.files?.[0])}
            />
            <span class="quiet">
              {entered.fileName
                ? `${entered.fileName}, ${rowsIn(form.curve_csv)} rows`
                : "CSV with the columns strain,stress_pa"}
            </span>
          </label>
          <label class="whole">
            Note <input value={form.note} maxLength={300} onInput={set("note")} />
          </label>
          <label class="check whole">
            <input
              type="checkbox"
              checked={form.valid}
              onChange={(e) => entered.setValid(e.currentTarget.checked)}
            />{" "}
            valid
          </label>
          <div class="whole">
            <button type="submit" disabled={entered.busy}>
              Add measurement
            </button>
          </div>
        </form>
      )}
      <Notice notice={entered.notice} />
    </section>
  );
}
