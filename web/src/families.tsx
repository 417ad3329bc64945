// The families of a run: near-Pareto designs in groups, the variants of each by its own model, and whether that model was worth it.

import { useMemo, useState } from "preact/hooks";
import type { Errors, Families as Said, Family, FamilyDesign, Maps, Rounds } from "./api";
import type { Option } from "./chart";
import { themeColour } from "./colour";
import { DesignPanel, showDesignPanel, type Chosen } from "./design_panel";
import { MechanismTable } from "./explorer";
import { Grouping } from "./family_grouping";
import { keyAt, type Gamut } from "./gamut";
import { figure, gpa, GPA, MPA, mpa, percent } from "./numbers";
import { Awaited, Problem, Table, Unit, UnitButton } from "./parts";
import { cloudSeries, PointChart, type Spot } from "./point_chart";
import { useGamuts, useReading } from "./reading";
import { newestModel } from "./rounds";

const THESIS_GROWTH = 0.045; // Table A.7, the mean of eleven subfamilies
const COLOURS = 6;

/** Colour of the n-th family, as a custom property of the page. */
const familyVariable = (index: number) => `family-${(index % COLOURS) + 1}`;

/** A family as it is drawn: with its stage, or as seeds alone. */
interface Shown {
  name: string;
  index: number;
  seeds: string[];
  stage: Family | null;
  gamut: Gamut | null;
}

const isKnown = (v: { modulus_pa: number | null; toughness_pa: number | null }) =>
  v.modulus_pa !== null && v.toughness_pa !== null;
const pointOf = (v: { modulus_pa: number | null; toughness_pa: number | null }): [number, number] => [
  v.modulus_pa! * GPA,
  v.toughness_pa! * MPA,
];

function seriesOf(rounds: Rounds, families: Shown[], variants: boolean): Option[] {
  const panel = themeColour("panel");
  const scatter = (name: string, data: unknown[], style: Option, more: Option = {}): Option => ({
    type: "scatter",
    name,
    data,
    silent: true,
    itemStyle: style,
    ...more,
  });
  const measured = new Map(rounds.measured.map((m) => [m.design, [m.modulus_pa * GPA, m.toughness_pa * MPA]]));
  const series: Option[] = [
    scatter("measured", [...measured.values()], { color: themeColour("homo"), opacity: 0.7 }, { symbolSize: 6, z: 3 }),
  ];
  for (const family of families) {
    const colour = themeColour(familyVariable(family.index));
    if (variants && family.gamut) series.push(cloudSeries(`${family.name}, variants`, family.gamut, colour));
    series.push(
      scatter(
        `${family.name}, seeds`,
        family.seeds.map((s) => measured.get(s)).filter(Boolean),
        { color: colour, borderColor: panel, borderWidth: 1 },
        { symbol: "diamond", symbolSize: 15, z: 6 },
      ),
    );
    const chosen = family.stage?.designs.filter((d) => !d.is_seed) ?? [];
    const steps = chosen
      .filter((d) => isKnown(d.measured) && isKnown(d.family_model))
      .flatMap((d) => [pointOf(d.family_model), pointOf(d.measured), [null, null]]);
    series.push(
      {
        type: "line",
        name: `${family.name}, from foretold to measured`,
        data: steps,
        symbol: "none",
        silent: true,
        lineStyle: { color: colour, width: 1.2 },
        z: 5,
      },
      scatter(
        `${family.name}, chosen, foretold`,
        chosen.filter((d) => isKnown(d.family_model)).map((d) => pointOf(d.family_model)),
        { color: "transparent", borderColor: colour, borderWidth: 2 },
        { symbolSize: 11, z: 7 },
      ),
      scatter(
        `${family.name}, chosen, measured`,
        chosen.filter((d) => isKnown(d.measured)).map((d) => pointOf(d.measured)),
        { color: colour, borderColor: panel, borderWidth: 1 },
        { symbolSize: 11, z: 8 },
      ),
    );
  }
  return series;
}

/** A point of a family, or of none, and what it stands for. */
interface FamilySpot extends Spot {
  family: string | null;
  role: string;
}

const FORETOLD = "variant, foretold";

function spotsOf(rounds: Rounds, families: Shown[], newest: number): FamilySpot[] {
  const spots: FamilySpot[] = [];
  const taken = new Set<string>();
  const add = (
    design: string,
    [x, y]: [number, number],
    family: string | null,
    role: string,
    model: number | string,
  ) => spots.push({ x, y, design, family, role, of: family ? `${family}: ${role}` : role, model });
  for (const family of families) {
    const model = family.stage ? family.name : newest;
    for (const d of family.stage?.designs ?? []) {
      if (d.is_seed) continue;
      if (isKnown(d.measured)) add(d.design, pointOf(d.measured), family.name, "variant, measured", model);
      if (isKnown(d.family_model)) add(d.design, pointOf(d.family_model), family.name, FORETOLD, model);
      taken.add(d.design);
    }
    for (const m of rounds.measured) {
      if (!family.seeds.includes(m.design)) continue;
      add(m.design, pointOf(m), family.name, `seed, measured in round ${m.round}`, model);
      taken.add(m.design);
    }
  }
  for (const m of rounds.measured)
    if (!taken.has(m.design)) add(m.design, pointOf(m), null, `measured in round ${m.round}`, newest);
  return spots;
}

type Kind = "modulus" | "toughness";

const meanError = (e: Errors | null, kind: Kind) => (e && e[`${kind}_count`] > 0 ? e[`${kind}_mean`] : null);

/** Where a family's own model foretells its variants worse than the global one, and no over-fit explains it. */
function worseThanGlobal(f: Family): string[] {
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

function ErrorTable({ families, which }: { families: Family[]; which: "seeds" | "chosen" }) {
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

function DesignTable({ families, open }: { families: Family[]; open: (f: Family, d: FamilyDesign) => void }) {
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

function SubfamilyTable({ maps }: { maps: Maps }) {
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

/** What there is to say before, or instead of, a stage. */
function Standing({ said }: { said: Said }) {
  const over = said.stage.filter((f) => f.over_fits.length > 0);
  const worse = said.stage.filter((f) => worseThanGlobal(f).length > 0);
  if (said.stage.length === 0)
    return (
      <p class="quiet">
        {said.enabled
          ? "After the last round the validation agent calibrates a model of each family, chooses variants and has them measured. Until then: the best designs so far, grouped."
          : "The best designs measured so far, grouped by pattern and properties. This game plays no family stage ([families] enabled = true asks for one); nacre families works the groups out afterwards."}
      </p>
    );
  return (
    <>
      <p class="quiet">
        Diamonds: measured seeds. Small points: variants within 16 pixels, by the family's own model. Rings: variants
        chosen for the laboratory, foretold; a line leads to what was measured.
      </p>
      {over.map((f) => (
        <p key={f.name} class="notice bad" role="status">
          {f.name}: its own model over-fits {f.over_fits.join(" and ")} – nearer to the seeds than the global one, farther
          from the variants. Trust the global model there.
        </p>
      ))}
      {worse.map((f) => (
        <p key={f.name} class="notice bad" role="status">
          {f.name}: its own model is worse than the global model in {worseThanGlobal(f).join(" and ")} on the variants.
          Trust the global model there.
        </p>
      ))}
    </>
  );
}

export function Families({
  rounds,
  data,
  theme,
  run,
}: {
  rounds: Rounds;
  data: string | null;
  theme: string;
  run: string;
}) {
  const families = useReading<Said>("/api/families", {}, data);
  const subfamilies = useReading<Maps>("/api/maps", {}, data);
  const [said, maps] = [families.value, subfamilies.value];
  const wanted = said?.stage.map((f) => ({ name: f.name, count: f.gamut_count, which: { family: f.name } })) ?? [];
  const { gamuts, problem } = useGamuts(wanted);
  const [hidden, setHidden] = useState<Set<string>>(new Set());
  const [variants, setVariants] = useState(true);
  const [chosen, setChosen] = useState<Chosen | null>(null);
  const all = useMemo<Shown[]>(() => {
    if (!said) return [];
    if (said.stage.length === 0)
      return said.grouping.families.map((g, index) => ({ ...g, index, stage: null, gamut: null }));
    return said.stage.map((stage, index) => ({
      name: stage.name,
      index,
      seeds: stage.designs.filter((d) => d.is_seed).map((d) => d.design),
      stage,
      gamut: gamuts.get(stage.name) ?? null,
    }));
  }, [said, gamuts]);
  const shown = useMemo(() => all.filter((f) => !hidden.has(f.name)), [all, hidden]);
  const newest = newestModel(rounds);
  const series = useMemo(() => seriesOf(rounds, shown, variants), [rounds, shown, variants, theme]);
  const spots = useMemo(() => spotsOf(rounds, shown, newest), [rounds, shown, newest]);
  const clouds = useMemo(
    () =>
      variants
        ? shown.flatMap((f) => (f.gamut ? [{ gamut: f.gamut, of: `${f.name}: variant`, model: f.name }] : []))
        : [],
    [shown, variants],
  );
  if (!said) return <Awaited problem={families.problem} />;
  if (all.length === 0)
    return (
      <p class="awaited wait">
        No pattern has been measured in both tests yet: the families of the best designs appear here.
      </p>
    );
  const open = (family: Family, design: FamilyDesign) =>
    setChosen({
      design: design.design,
      model: family.name,
      modulus: design.family_model.modulus_pa ?? NaN,
      toughness: design.family_model.toughness_pa ?? NaN,
      of: `${family.name}: ${design.is_seed ? "seed" : "variant"}`,
    });
  const flip = (name: string) => {
    const next = new Set(hidden);
    if (!next.delete(name)) next.add(name);
    setHidden(next);
  };
  return (
    <>
      <div class="split">
        <div class="stack">
          <section class="panel gamut">
            <div class="panel-head">
              <h2>Families</h2>
              <div class="toggles">
                <fieldset>
                  <legend>show</legend>
                  {all.map((f) => (
                    <label key={f.name} class="toggle" style={{ "--c": `var(--${familyVariable(f.index)})` } as never}>
                      <input type="checkbox" checked={!hidden.has(f.name)} onChange={() => flip(f.name)} />
                      <span>{f.name}</span>
                    </label>
                  ))}
                  {said.stage.length > 0 && (
                    <label class="toggle" style={{ "--c": "var(--homo)" } as never}>
                      <input type="checkbox" checked={variants} onChange={() => setVariants(!variants)} />
                      <span>variants</span>
                    </label>
                  )}
                </fieldset>
              </div>
            </div>
            <Problem text={families.problem || problem} />
            <Standing said={said} />
            <PointChart
              name="families"
              label="Families: Young's modulus against toughness"
              series={series}
              clouds={clouds}
              spots={spots}
              chosen={chosen}
              choose={setChosen}
              table={() => ({
                heading: ["family", "what", "pattern", "modulus_pa", "toughness_pa"],
                rows: shown.flatMap((f) => [
                  ...spots
                    .filter((s) => s.family === f.name)
                    .map((s) => [f.name, s.role, s.design, s.x / GPA, s.y / MPA]),
                  ...(f.gamut
                    ? Array.from(f.gamut.patterns, (_, i) => [
                        f.name,
                        "simulated",
                        keyAt(f.gamut!, i),
                        f.gamut!.points[2 * i] / GPA,
                        f.gamut!.points[2 * i + 1] / MPA,
                      ])
                    : []),
                ]),
              })}
            />
          </section>
          {said.stage.length > 0 && (
            <section class="panel after">
              <ErrorTable families={said.stage} which="chosen" />
              <ErrorTable families={said.stage} which="seeds" />
            </section>
          )}
        </div>
        <DesignPanel chosen={chosen} data={data}>
          <p class="quiet">Click a point, or press Enter on it, to see it break by its family's model.</p>
          {shown.map((family) => {
            const spotsOfIt = spots.filter((s) => s.family === family.name);
            const foretold = spotsOfIt.filter((s) => s.role === FORETOLD);
            return (
              <div key={family.name}>
                <h3>
                  {family.name}: {foretold.length > 0 ? "variants chosen for the laboratory" : "seeds"}
                </h3>
                <ul class="units">
                  {(foretold.length > 0 ? foretold : spotsOfIt).map((s) => (
                    <li key={s.design}>
                      <UnitButton
                        design={s.design}
                        values={[figure(s.x), figure(s.y)]}
                        choose={() => setChosen({ ...s, modulus: s.x / GPA, toughness: s.y / MPA })}
                      />
                    </li>
                  ))}
                </ul>
              </div>
            );
          })}
        </DesignPanel>
      </div>
      {said.stage.length > 0 && (
        <section class="panel">
          <DesignTable families={said.stage} open={open} />
        </section>
      )}
      <Problem text={subfamilies.problem} />
      {maps && <SubfamilyTable maps={maps} />}
      {maps?.families
        .filter((f) => f.mechanisms && f.mechanisms.length > 0)
        .map((f) => (
          <section key={f.name} class="panel">
            <MechanismTable family={f.name} mechanisms={f.mechanisms!} />
          </section>
        ))}
      <Grouping said={said} run={run} refresh={families.read} colour={familyVariable} />
    </>
  );
}
