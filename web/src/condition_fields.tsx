// What was measured, of what and how: the fields of a measurement that is entered or amended.

import type { Ref } from "preact";
import { measuredName, unitOf, type Form } from "./measurement_form";

type Field = "pattern" | "test" | "value" | "orientation_deg" | "thickness_mm" | "strain_rate_per_s";
type Typed = (event: { currentTarget: { value: string } }) => void;

export function ConditionFields({
  form,
  set,
  isFaulty = () => undefined,
  hints = {},
  first,
}: {
  form: Form;
  set: (field: Field) => Typed;
  isFaulty?: (field: Field) => "true" | undefined;
  /** What an empty field stands for. */
  hints?: Partial<Record<Field, string>>;
  /** The field that is typed in first. */
  first?: Ref<HTMLInputElement>;
}) {
  const number = (name: string, field: Field, ref?: Ref<HTMLInputElement>) => (
    <input
      ref={ref}
      name={name}
      inputMode="decimal"
      value={form[field]}
      onInput={set(field)}
      placeholder={hints[field]}
      aria-invalid={isFaulty(field)}
    />
  );
  return (
    <>
      <label>
        {measuredName(form.test)} / {unitOf(form.test)} {number("value", "value", first)}
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
        Pattern{" "}
        <input
          required
          name="pattern"
          maxLength={101}
          spellcheck={false}
          value={form.pattern}
          onInput={set("pattern")}
          placeholder={hints.pattern}
        />
      </label>
      <label>Thickness / mm {number("thickness", "thickness_mm")}</label>
      <label>Strain rate / s⁻¹ {number("rate", "strain_rate_per_s")}</label>
      <label>
        Orientation{" "}
        <select name="orientation" value={form.orientation_deg} onChange={set("orientation_deg")}>
          <option value="0">upright</option>
          <option value="90">turned by 90°</option>
        </select>
      </label>
    </>
  );
}
