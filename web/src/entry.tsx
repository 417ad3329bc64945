// One measured specimen, typed in.

import { useState } from "preact/hooks";
import type { Laboratory as Work, Order } from "./api";
import { useHandIn } from "./hand_in";
import { Notice } from "./parts";

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

export function Entry({ work, refresh, playing }: { work: Work; refresh: () => Promise<void>; playing: boolean }) {
  const [form, setForm] = useState(EMPTY);
  const [fileName, setFileName] = useState("");
  const [said, busy, handIn] = useHandIn(refresh);
  const set = (name: keyof typeof EMPTY) => (event: { currentTarget: { value: string } }) =>
    setForm({ ...form, [name]: event.currentTarget.value });
  const open = work.orders.filter((o) => !o.complete);
  const take = (order: Order | undefined) =>
    order &&
    setForm({
      ...form,
      pattern: order.design,
      test: order.test,
      batch: order.batch,
      orientation_deg: String(order.orientation_deg),
      strain_rate_per_s: String(order.strain_rate_per_s),
      thickness_mm: String(order.thickness_mm),
      specimen: `${order.batch || "hand"}-${order.design.slice(0, 6)}-${order.test[0]}${order.arrived + 1}`,
    });
  const unit = form.test === "modulus" ? "GPa" : "MPa";
  const submit = async (event: Event) => {
    event.preventDefault();
    const { value, ...rest } = form;
    const measured =
      value.trim() === ""
        ? {}
        : form.test === "modulus"
          ? { modulus_pa: Number(value.replace(",", ".")) * 1e9 }
          : { toughness_pa: Number(value.replace(",", ".")) * 1e6 };
    if (await handIn("/api/measurement", { ...rest, ...measured }, `${form.specimen} is in the game.`)) {
      setForm({ ...EMPTY, test: form.test, pattern: form.pattern, batch: form.batch });
      setFileName("");
    }
  };
  return (
    <section class="panel">
      <h2>Enter a measurement</h2>
      {!playing ? (
        <p class="awaited">Only while the game plays: the validation agent takes measurements.</p>
      ) : (
        <form onSubmit={submit} class="entry">
          {open.length > 0 && (
            <label class="whole">
              From an open order
              <select onChange={(e) => take(open.find((o) => o.order === e.currentTarget.value))}>
                <option value="">choose, or fill in by hand</option>
                {open.map((o) => (
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
              onInput={set("pattern")}
              placeholder="key, rigid, soft, mix:0.65"
            />
          </label>
          <label>
            Test
            <select name="test" value={form.test} onChange={set("test")}>
              <option>toughness</option>
              <option>modulus</option>
              <option>tensile</option>
            </select>
          </label>
          <label>
            {form.test === "modulus" ? "Young's modulus" : "Toughness"} / {unit}{" "}
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
            <select value={form.orientation_deg} onChange={set("orientation_deg")}>
              <option value="0">upright</option>
              <option value="90">turned by 90°</option>
            </select>
          </label>
          <label>
            Thickness / mm{" "}
            <input inputMode="decimal" value={form.thickness_mm} onInput={set("thickness_mm")} placeholder="3.2" />
          </label>
          <label>
            Strain rate / s⁻¹{" "}
            <input
              inputMode="decimal"
              value={form.strain_rate_per_s}
              onInput={set("strain_rate_per_s")}
              placeholder="6.17e-4"
            />
          </label>
          <label class="whole">
            Curve{" "}
            <input
              type="file"
              accept=".csv,text/csv"
              onChange={async (e) => {
                const file = e.currentTarget.files?.[0];
                setFileName(file?.name ?? "");
                setForm({ ...form, curve_csv: file ? await file.text() : "" });
              }}
            />
            <span class="quiet">
              {fileName
                ? `${fileName}, ${form.curve_csv.split("\n").length - 1} rows`
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
              onChange={(e) => setForm({ ...form, valid: e.currentTarget.checked })}
            />{" "}
            valid
          </label>
          <div class="whole">
            <button type="submit" disabled={busy}>
              Hand in
            </button>
          </div>
        </form>
      )}
      <Notice said={said} />
    </section>
  );
}
