// The families of a run in tables: errors of their models, designs, subfamilies.

import type { Errors, Family, FamilyDesign, Maps } from "./api";
import { showDesignPanel } from "./design_panel";
import { gpa, mpa, percent } from "./numbers";
import { Table, Unit } from "./parts";

const THESIS_GROWTH = 0.045; // Table A.7, the mean of eleven subfamilies

type Kind = "modulus" | "toughness";

const meanError = (e: Errors | null, kind: Kind) => (e && e[`${kind}_count`] > 0 ? e[`${kind}_mean`] : null);

/** Where a family's own model foretells its variants worse than the global one, and no over-fit explains it. */
export function worseThanGlobal(f: Family): string[] {
  const { global, family } = f.errors.chosen;
  const isWorse = (kind: Kind) => (meanError(family, kind) ?? 0) > (meanError(global, kind) ?? Infinity);
  return [isWorse("modulus") ? "E" : "", isWorse("toughness") ? "T" : ""].filter(
    (kind) => kind && !f.over_fits.includes(kind as "E" | "T"),
  );
}

/** What speaks against a family's own model; empty: nothing. */
function faultsOf(f: Family): string {
  const worse = worseThanGlobal(f);
  return [
    f.over_fits.length > 0 ? `over-fits ${f.over_fits.join(" and ")}` : "",
    worse.length > 0 ? `worse than the global model in ${worse.join(" and ")}` : "",
  ]
    .filter(Boolean)
    .join("; ");
}

/** What keeps the models of a family from being compared in a property, as the report has it; empty: nothing. */
function missingFor(f: Family, kind: Kind): string {
  const { seeds, chosen } = f.errors;
  const errors = [seeds.global, seeds.family, chosen.global, chosen.family];
  if (errors.every((e) => meanError(e, kind) !== null)) return "";
  const isMeasured = (isSeed: boolean) =>
    f.designs.some((d) => d.is_seed === isSeed && d.measured[`${kind}_pa`] !== null);
  return isMeasured(true) && isMeasured(false) ? "not simulated" : "not measured";
}

/** Whether a family's own model may be trusted. Where all its variants were rejected, nobody knows. */
function standingOf(f: Family): { text: string; kind: "bad" | "quiet" | "" } {
  const faults = faultsOf(f);
  if (faults) return { text: faults, kind: "bad" };
  if (!f.is_validated) return { text: "awaits its measurements", kind: "quiet" };
  const [inE, inT] = [missingFor(f, "modulus"), missingFor(f, "toughness")];
  if (inE === inT) return { text: inE || "does not over-fit", kind: inE ? "quiet" : "" };
  const of = (kind: string, missing: string) => (missing ? `${kind} ${missing}` : `does not over-fit ${kind}`);
  return { text: `${of("E", inE)}; ${of("T", inT)}`, kind: "quiet" };
}

export function ErrorTable({ families, which }: { families: Family[]; which: "seeds" | "chosen" }) {
  const column = (heading: string, model: "global" | "family", kind: Kind) => ({
    heading,
    csv: `${model}_model_${kind}_error`,
    show: (f: Family) => percent(meanError(f.errors[which][model], kind)),
    value: (f: Family) => meanError(f.errors[which][model], kind),
  });
  const verdict = {
    heading: "own model",
    csv: "own_model",
    words: true,
    show: (f: Family) => {
      const { text, kind } = standingOf(f);
      return kind === "bad" ? <strong class="bad">{text}</strong> : <span class={kind}>{text}</span>;
    },
    value: (f: Family) => standingOf(f).text,
  };
  return (
    <Table
      name={which === "seeds" ? "family-errors-seeds" : "family-errors-variants"}
      caption={
        which === "seeds"
          ? "Mean relative errors on the seeds, which the family's own model was calibrated on"
          : "Mean relative errors on variants, foretold before they were measured"
      }
      rows={families}
      rowKey={(f) => f.name}
      empty=""
      columns={[
        { heading: "family", words: true, show: (f) => f.name, value: (f) => f.name },
        {
          heading: "designs",
          show: (f) => f.designs.filter((d) => d.is_seed === (which === "seeds")).length,
          value: (f) => f.designs.filter((d) => d.is_seed === (which === "seeds")).length,
        },
        column("E global", "global", "modulus"),
        column("E own", "family", "modulus"),
        column("T global", "global", "toughness"),
        column("T own", "family", "toughness"),
        ...(which === "chosen" ? [verdict] : []),
      ]}
    />
  );
}

export function DesignTable({ families, open }: { families: Family[]; open: (f: Family, d: FamilyDesign) => void }) {
  const rows = families.flatMap((family) => family.designs.map((design) => ({ family, design })));
  type Row = (typeof rows)[number];
  const values = (heading: string, of: "measured" | "global_model" | "family_model", kind: "E" | "T") => ({
    heading,
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
        { heading: "family", words: true, show: (r) => r.family.name, value: (r) => r.family.name },
        {
          heading: "role",
          words: true,
          show: (r) => (r.design.is_seed ? "seed" : "variant"),
          value: (r) => (r.design.is_seed ? "seed" : "variant"),
        },
        {
          heading: "design",
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
          heading: "rigid",
          csv: "rigid_fraction",
          show: (r) => percent(r.design.rigid_fraction, 0),
          value: (r) => r.design.rigid_fraction,
        },
        values("E measured", "measured", "E"),
        values("E global", "global_model", "E"),
        values("E own", "family_model", "E"),
        values("T measured", "measured", "T"),
        values("T global", "global_model", "T"),
        values("T own", "family_model", "T"),
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
        caption={`Subfamilies: what interpolation adds to the variants around a seed (thesis, Table A.7: ${percent(THESIS_GROWTH)})`}
        rows={rows}
        rowKey={(r) => `${r.family} ${r.seed}`}
        empty=""
        columns={[
          { heading: "family", words: true, show: (r) => r.family, value: (r) => r.family },
          {
            heading: "seed",
            words: true,
            show: (r) => (
              <span class="with-unit">
                <Unit design={r.seed} size={26} label={false} />
                <code class="key">{r.seed}</code>
              </span>
            ),
            value: (r) => r.seed,
          },
          { heading: "sampled", show: (r) => r.sampled, value: (r) => r.sampled },
          { heading: "interpolated", show: (r) => r.interpolated, value: (r) => r.interpolated },
          { heading: "growth", show: (r) => percent(r.growth), value: (r) => r.growth },
          {
            heading: "variance kept by the map",
            csv: "variance_kept",
            show: (r) => percent(1 - r.residual_variance),
            value: (r) => 1 - r.residual_variance,
          },
        ]}
      />
    </section>
  );
}
