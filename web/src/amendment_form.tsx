// A measurement that was mistyped, with other values; what it was stays in the run.

import { useEffect, useRef, useState } from "preact/hooks";
import type { LaboratorySpecimen } from "./api";
import { ConditionFields } from "./condition_fields";
import { inWordsOfForm, rowOf, unreadable, EMPTY, type Form } from "./measurement_form";
import { GPA, MPA } from "./numbers";
import type { NoticeText } from "./parts";

/** A number as a person would have typed it. */
const typed = (value: number | null) => (value === null ? "" : String(Number(value.toPrecision(10))));

const valueOf = (s: LaboratorySpecimen) =>
  s.test === "modulus"
    ? typed(s.modulus_pa && s.modulus_pa * GPA)
    : typed(s.toughness_pa && s.toughness_pa * MPA);

const formOf = (s: LaboratorySpecimen): Form => ({
  ...EMPTY,
  specimen: s.specimen,
  pattern: s.design,
  test: s.test,
  value: valueOf(s),
  orientation_deg: String(s.orientation_deg),
  thickness_mm: typed(s.thickness_mm),
  strain_rate_per_s: typed(s.strain_rate_per_s),
});

/** The columns that change, by the names of a measurement set. */
function changesOf(before: Form, now: Form): Record<string, unknown> {
  const row: Record<string, unknown> = rowOf(now);
  const column = (form: Form) => (form.test === "modulus" ? "modulus_pa" : "toughness_pa");
  const changes: Record<string, unknown> = {};
  for (const field of ["pattern", "test", "orientation_deg", "thickness_mm", "strain_rate_per_s"] as const)
    if (now[field] !== before[field]) changes[field] = row[field];
  if (now.test !== before.test) changes[column(before)] = null;
  if (now.value !== before.value || now.test !== before.test) changes[column(now)] = row[column(now)];
  return changes;
}

export function AmendmentForm({
  specimen,
  by,
  busy,
  submit,
  close,
  say,
}: {
  specimen: LaboratorySpecimen;
  by: string;
  busy: boolean;
  submit: (body: unknown, done: string, explain: (sentence: string) => string) => Promise<boolean>;
  close: () => void;
  say: (notice: NoticeText) => void;
}) {
  const before = useRef(formOf(specimen)).current;
  const [form, setForm] = useState(before);
  const [why, setWhy] = useState("");
  const first = useRef<HTMLInputElement>(null);
  useEffect(() => first.current?.focus(), []);
  const set = (field: keyof Form) => (event: { currentTarget: { value: string } }) =>
    setForm({ ...form, [field]: event.currentTarget.value });
  const send = async (event: Event) => {
    event.preventDefault();
    const wrong = unreadable(form);
    if (wrong) return say({ kind: "bad", text: wrong.text });
    const changes = changesOf(before, form);
    if (Object.keys(changes).length === 0) return say({ kind: "bad", text: "Nothing is changed yet." });
    const body = { specimen: specimen.specimen, by, why, ...changes };
    const done = `${specimen.specimen} is amended${specimen.valid ? "" : ", and still not valid: review it"}.`;
    if (await submit(body, done, (sentence) => inWordsOfForm(sentence, form))) close();
  };
  return (
    <form onSubmit={send} class="measurement amendment" aria-label={`amend ${specimen.specimen}`}>
      <p class="whole">
        Amend {specimen.specimen}: the new values count from the next calibration on; the old ones stay in the run.
      </p>
      <ConditionFields
        form={form}
        set={set}
        first={first}
        hints={{ value: specimen.points > 0 ? "from the curve" : "" }}
      />
      <label class="whole">
        Why{" "}
        <input
          required
          name="why"
          value={why}
          maxLength={200}
          onInput={(e) => setWhy(e.currentTarget.value)}
          placeholder="such as: decimal point"
        />
      </label>
      <div class="whole buttons">
        <button type="submit" disabled={busy || !by}>
          Amend
        </button>
        <button type="button" class="quiet" onClick={close}>
          Cancel
        </button>
      </div>
    </form>
  );
}
