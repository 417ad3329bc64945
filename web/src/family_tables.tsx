// The families of a run in tables: errors of their models, designs, subfamilies.

import type { Errors, Family, FamilyDesign, Maps } from "./api";
import { showDesignPanel } from "./design_panel";
import { gpa, mpa, percent } from "./numbers";
import { Table, Unit } from "./parts";
import { TERMS, type Term } from "./terms";

const THESIS_GROWTH = 0.045; // Table A.7, the mean of eleven subfamilies

type Kind = "modulus" | "toughness";

const meanError = (e: Errors | null, kind: Kind) => (e && e[`n_${kind}`] > 0 ? e[`${kind}_mean`] : null);

/** Where a family's own model predicts its variants worse than the global one, and no over-fit explains it. */
export function worseThanGlobal(f: Family): string[] {
  const { global, family } = f.errors.chosen;
  const isWorse = (kind: Kind) => (meanError(family, kind) ?? 0) > (meanError(global, kind) ?? Infinity);
  return [isWorse("modulus") ? "E" : "", isWorse("toughness") ? "T" : ""].filter(
    (kind) => kind && !f.over_fits.includes(kind as "E" | "T"),
  );
}

/** What is wrong with a family's own model; empty: nothing. */
function faultsOf(f: Family): string {
  const worse = worseThanGlobal(f);
  return [
    f.over_fits.length > 0 ? `over-fits ${f.over_fits.join(" and ")}` : "",
    worse.length > 0 ? `worse than the global model in ${worse.join(" and ")}` : "",
  ]
    .filter(Boolean)
    .join("; ");
}

/** Why the models of a family cannot be compared in a property; empty: they can. */
function missingFor(f: Family, kind: Kind): string {
  const { seeds, chosen } = f.errors;
  const errors = [seeds.global, seeds.family, chosen.global, chosen.family];
  if (errors.every((e) => meanError(e, kind) !== null)) return "";
  const isMeasured = (isSeed: boolean) =>
    f.designs.some((d) => d.is_seed === isSeed && d.measured[`${kind}_pa`] !== null);
  return isMeasured(true) && isMeasured(false) ? "not simulated" : "not measured";
}

/** Whether a family's own model can be trusted. Where all its variants were rejected, nobody knows. */
function trustIn(f: Family): { text: string; kind: "bad" | "quiet" | "" } {
  const faults = faultsOf(f);
  if (faults) return { text: faults, kind: "bad" };
  if (!f.is_validated) return { text: "not measured yet", kind: "quiet" };
  const [inE, inT] = [missingFor(f, "modulus"), missingFor(f, "toughness")];
  if (inE === inT) return { text: inE || "does not over-fit", kind: inE ? "quiet" : "" };
  const of = (kind: string, missing: string) => (missing ? `${kind} ${missing}` : `does not over-fit ${kind}`);
  return { text: `${of("E", inE)}; ${of("T", inT)}`, kind: "quiet" };
}

export function ErrorTable({ families, which }: { families: Family[]; which: "seeds" | "chosen" }) {
  const column = (term: Term, model: "global" | "family", kind: Kind) => ({
    ...term,
    csv: `${model}_model_${kind}_error`,
    show: (f: Family) => percent(meanError(f.errors[which][model], kind)),
    value: (f: Family) => meanError(f.errors[which][model], kind),
  });
  const familyModel = {
    ...TERMS.familyModel,
    csv: "own_model",
    words: true,
    show: (f: Family) => {
      const { text, kind } = trustIn(f);
      return kind === "bad" ? <strong class="bad">{text}</strong> : <span class={kind}>{text}</span>;
    },
    value: (f: Family) => trustIn(f).text,
  };
  return (
    <Table
      name={which === "seeds" ? "family-errors-seeds" : "family-errors-variants"}
      caption={
        which === "seeds"
          ? "Fit errors on the seeds, which the family's own model was calibrated on"
          : "Prediction errors on the variants, predicted before they were measured"
      }
      rows={families}
      rowKey={(f) => f.name}
      empty=""
      columns={[
        { ...TERMS.family, words: true, show: (f) => f.name, value: (f) => f.name },
        {
          heading: "designs",
          hint: "How many seeds or variants the family has.",
          show: (f) => f.designs.filter((d) => d.is_seed === (which === "seeds")).length,
          value: (f) => f.designs.filter((d) => d.is_seed === (which === "seeds")).length,
        },
        column(TERMS.globalE, "global", "modulus"),
        column(TERMS.familyE, "family", "modulus"),
        column(TERMS.globalT, "global", "toughness"),
        column(TERMS.familyT, "family", "toughness"),
        ...(which === "chosen" ? [familyModel] : []),
      ]}
    />
  );
}

export function DesignTable({ families, open }: { families: Family[]; open: (f: Family, d: FamilyDesign) => void }) {
  const rows = families.flatMap((family) => family.designs.map((design) => ({ family, design })));
  type Row = (typeof rows)[number];
  const values = (term: Term, of: "measured" | "global_model" | "family_model", kind: "E" | "T") => ({
    ...term,
    csv: `${of}_${kind === "E" ? "modulus_pa" : "toughness_pa"}`,
    show: ({ design }: Row) => (kind === "E" ? gpa(design[of].modulus_pa) : mpa(design[of].toughness_pa)),
    value: ({ design }: Row) => (kind === "E" ? design[of].modulus_pa : design[of].toughness_pa),
  });
  return (
    <Table
      name="family-designs"
      caption="Seeds and chosen variants (E in GPa, T in MPa)"
      rows={rows}
      rowKey={({ family, design }) => `${family.name} ${design.design}`}
      empty=""
      columns={[
        { ...TERMS.family, words: true, show: (r) => r.family.name, value: (r) => r.family.name },
        {
          ...TERMS.role,
          words: true,
          show: (r) => (r.design.is_seed ? "seed" : "variant"),
          value: (r) => (r.design.is_seed ? "seed" : "variant"),
        },
        {
          ...TERMS.design,
          words: true,
          show: (r) => (
            <button
              type="button"
              class="link"
              onClick={() => {
                open(r.family, r.design);
                showDesignPanel();
              }}
            >
              <code class="key">{r.design.design}</code>
            </button>
          ),
          value: (r) => r.design.design,
        },
        {
          ...TERMS.rigid,
          csv: "rigid_fraction",
          show: (r) => percent(r.design.rigid_fraction, 0),
          value: (r) => r.design.rigid_fraction,
        },
        values({ heading: "E, measured", hint: "Mean of the valid specimens." }, "measured", "E"),
        values(TERMS.globalE, "global_model", "E"),
        values(TERMS.familyE, "family_model", "E"),
        values({ heading: "T, measured", hint: "Mean of the valid specimens." }, "measured", "T"),
        values(TERMS.globalT, "global_model", "T"),
        values(TERMS.familyT, "family_model", "T"),
      ]}
    />
  );
}

export function SubfamilyTable({ maps }: { maps: Maps }) {
  const rows = maps.families.flatMap((f) => (f.maps ?? []).map((map) => ({ family: f.name, ...map })));
  if (rows.length === 0) return null;
  return (
    <section class="panel">
      <Table
        name="subfamilies"
        caption={
          "Subfamilies: how far interpolation extends the variants around a seed " +
          `(thesis, Table A.7: ${percent(THESIS_GROWTH)})`
        }
        rows={rows}
        rowKey={(r) => `${r.family} ${r.seed}`}
        empty=""
        columns={[
          { ...TERMS.family, words: true, show: (r) => r.family, value: (r) => r.family },
          {
            ...TERMS.seed,
            words: true,
            show: (r) => (
              <span class="with-unit">
                <Unit design={r.seed} size={26} label={false} />
                <code class="key">{r.seed}</code>
              </span>
            ),
            value: (r) => r.seed,
          },
          { ...TERMS.sampled, show: (r) => r.sampled, value: (r) => r.sampled },
          { ...TERMS.interpolated, show: (r) => r.interpolated, value: (r) => r.interpolated },
          { ...TERMS.growth, show: (r) => percent(r.growth), value: (r) => r.growth },
          {
            ...TERMS.variance,
            csv: "variance_kept",
            show: (r) => percent(1 - r.residual_variance),
            value: (r) => 1 - r.residual_variance,
          },
        ]}
      />
    </section>
  );
}
