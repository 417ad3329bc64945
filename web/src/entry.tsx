// One measured specimen, typed in.

import { useEffect, useState } from "preact/hooks";
import type { Laboratory as Work, Order } from "./api";
import { useHandIn } from "./hand_in";
import { typedNumber } from "./numbers";
import { Notice, useDraft } from "./parts";

const EMPTY = {
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

type Form = typeof EMPTY;

const measuredName = (test: string) => (test === "modulus" ? "Young's modulus" : "Toughness");

/** What is wrong with the typed numbers, as a sentence; empty: nothing. */
function faultIn(form: Form): string {
  const typed = {
    [measuredName(form.test)]: form.value,
    Thickness: form.thickness_mm,
    "Strain rate": form.strain_rate_per_s,
  };
  const wrong = Object.entries(typed).find(([, text]) => text.trim() !== "" && typedNumber(text) === null);
  return wrong ? `${wrong[0]}: “${wrong[1]}” is not a number; write it without a unit, such as 0.17.` : "";
}

/** The form as a row of a measurement set, in its units. */
function rowOf({ value, ...rest }: Form) {
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

/** Rows of a curve file below its heading. */
const rowsIn = (csv: string) => csv.split("\n").filter((line) => line.trim() !== "").length - 1;

/** The form, the order that it answers, and what becomes of it. */
function useEntry(work: Work, refresh: () => Promise<void>) {
  const [form, setForm] = useDraft("entry", EMPTY);
  const [fileName, setFileName] = useDraft("entry/file", "");
  const [chosen, setChosen] = useDraft("entry/order", "");
  const [fault, setFault] = useState("");
  const [handedIn, setHandedIn] = useState(0);
  const [files, setFiles] = useState(0); // chosen and let go again
  const [said, busy, handIn] = useHandIn(refresh);
  const set = (name: keyof Form) => (event: { currentTarget: { value: string } }) =>
    setForm({ ...form, [name]: event.currentTarget.value });
  /** The same for what an order asks for: whoever changes that no longer answers the order that was chosen. */
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
  const open = work.orders.filter((o) => !o.complete);
  const orderOf = (id: string) => open.find((o) => o.order === id);
  const nameFor = (order: Order) => nextName(order, new Set(work.specimens.map((s) => s.specimen)));
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
  }, [handedIn]);
  const readCurve = async (file: File | undefined) => {
    setFileName(file?.name ?? "");
    const curve_csv = file ? await file.text() : "";
    setForm((now) => ({ ...now, curve_csv }));
  };
  const submit = async (event: Event) => {
    event.preventDefault();
    const isEmptyFile = fileName !== "" && rowsIn(form.curve_csv) < 1;
    const wrong = isEmptyFile ? `Curve: ${fileName} holds no rows.` : faultIn(form);
    setFault(wrong);
    if (wrong || !(await handIn("/api/measurement", rowOf(form), `${form.specimen} is in the game.`))) return;
    // What was filled in meanwhile stays.
    setForm((now) => ({ ...now, specimen: "", value: "", note: "", valid: true, curve_csv: "" }));
    forget();
    setHandedIn(handedIn + 1);
  };
  return {
    form,
    fileName,
    files,
    open,
    chosen: orderOf(chosen) ? chosen : "",
    said: fault ? { kind: "bad" as const, text: fault } : said,
    busy,
    set,
    setAsked,
    setValid: (valid: boolean) => setForm({ ...form, valid }),
    take,
    readCurve,
    submit,
  };
}

export function Entry({ work, refresh, playing }: { work: Work; refresh: () => Promise<void>; playing: boolean }) {
  const { form, set, setAsked, ...entry } = useEntry(work, refresh);
  const unit = form.test === "modulus" ? "GPa" : "MPa";
  return (
    <section class="panel">
      <h2>Enter a measurement</h2>
      {!playing ? (
        <p class="awaited">Only while the game plays: the validation agent takes measurements.</p>
      ) : (
        <form onSubmit={entry.submit} class="entry">
          {entry.open.length > 0 && (
            <label class="whole">
              From an open order
              <select name="order" value={entry.chosen} onChange={(e) => entry.take(e.currentTarget.value)}>
                <option value="">choose, or fill in by hand</option>
                {entry.open.map((o) => (
                  <option key={o.order} value={o.order}>
                    {o.design.slice(0, 16)} · {o.test}
                    {o.orientation_deg ? " turned" : ""}
                    {o.loading === "monotonic" ? "" : ` (${o.loading})`} · {o.arrived} of {o.replicates} here
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
          <label>
            Pattern{" "}
            <input
              required
              name="pattern"
              maxLength={101}
              spellcheck={false}
              value={form.pattern}
              onInput={setAsked("pattern")}
              placeholder="key, rigid, soft, mix:0.65"
            />
          </label>
          <label>
            Test
            <select name="test" value={form.test} onChange={setAsked("test")}>
              <option>toughness</option>
              <option>modulus</option>
              <option>tensile</option>
            </select>
          </label>
          <label>
            {measuredName(form.test)} / {unit}{" "}
            <input
              name="value"
              inputMode="decimal"
              value={form.value}
              onInput={set("value")}
              placeholder="or from the curve"
            />
          </label>
          <label>
            Batch <input value={form.batch} maxLength={60} onInput={set("batch")} />
          </label>
          <label>
            Orientation{" "}
            <select name="orientation" value={form.orientation_deg} onChange={setAsked("orientation_deg")}>
              <option value="0">upright</option>
              <option value="90">turned by 90°</option>
            </select>
          </label>
          <label>
            Thickness / mm{" "}
            <input
              name="thickness"
              inputMode="decimal"
              value={form.thickness_mm}
              onInput={set("thickness_mm")}
              placeholder="3.2"
            />
          </label>
          <label>
            Strain rate / s⁻¹{" "}
            <input
              name="rate"
              inputMode="decimal"
              value={form.strain_rate_per_s}
              onInput={set("strain_rate_per_s")}
              placeholder="6.17e-4"
            />
          </label>
          <label class="whole">
            Curve{" "}
            <input
              key={entry.files}
              type="file"
              accept=".csv,text/csv"
              onChange={(e) => entry.readCurve(e.currentTarget.files?.[0])}
            />
            <span class="quiet">
              {entry.fileName
                ? `${entry.fileName}, ${rowsIn(form.curve_csv)} rows`
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
              onChange={(e) => entry.setValid(e.currentTarget.checked)}
            />{" "}
            valid
          </label>
          <div class="whole">
            <button type="submit" disabled={entry.busy}>
              Hand in
            </button>
          </div>
        </form>
      )}
      <Notice said={entry.said} />
    </section>
  );
}
