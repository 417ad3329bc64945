// All that is known of one specimen: what was ordered, what came, its curve among its replicates, decisions, notes.

import type { ComponentChildren } from "preact";
import type { Group, Laboratory, LaboratorySpecimen, Order, SpecimenStory, ToldMeasurement, ToldReview } from "./api";
import { Notes } from "./notes";
import { figure, gpa, mpa, percent } from "./numbers";
import { Awaited, Name, Table, Unit, unusual, type Column } from "./parts";
import { useReading } from "./reading";
import { ReplicateCurves } from "./replicate_curves";
import { addressOf } from "./route";

type Fact = [heading: string, value: ComponentChildren];

function Facts({ facts }: { facts: Fact[] }) {
  return (
    <dl class="facts-list">
      {facts.map(([heading, value]) => (
        <div key={heading}>
          <dt>{heading}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

/** In the unit of the test. */
const valueOf = (test: string, pa: number | null) => (test === "modulus" ? `${gpa(pa)} GPa` : `${mpa(pa)} MPa`);

function orderFacts(order: Order | undefined, told: ToldMeasurement | undefined): Fact[] {
  if (!order) return [["order", told?.order ? told.order : "nobody ordered it by name"]];
  return [
    ["order", `${order.order}, in round ${order.round}`],
    ["ordered because", order.reason.replaceAll("_", " ")],
    ["replicates", `${order.arrived} of ${order.replicates} are measured, ${order.valid} valid`],
  ];
}

function groupFacts(group: Group | undefined, specimen: LaboratorySpecimen): Fact[] {
  if (!group) return [];
  const doubts = group.proposed_outliers.find((o) => o.specimen === specimen.specimen)?.reasons ?? [];
  const mean = `${valueOf(group.test, group.mean_pa)}, scatter ${percent(group.scatter)}`;
  return [
    ["mean of the replicates", `${mean} (${group.valid.length} valid of ${group.tested.length})`],
    ["doubts", doubts.length > 0 ? <span class="doubt">{doubts.join("; ")}</span> : "none"],
  ];
}

const MEASURED: Column<ToldMeasurement>[] = [
  {
    heading: "revision",
    words: true,
    show: (m) => (m.revision === 0 ? "as first entered" : `${m.revision}, by ${m.by}: ${m.why}`),
    value: (m) => m.revision,
  },
  {
    heading: "value entered",
    show: (m) => {
      const given = m.test === "modulus" ? m.modulus_pa : m.toughness_pa;
      return given === null ? "none" : valueOf(m.test, given);
    },
    value: (m) => m.modulus_pa ?? m.toughness_pa,
  },
  {
    heading: "from the curve",
    show: (m) => {
      const reduced = m.test === "modulus" ? m.modulus_of_curve_pa : m.toughness_of_curve_pa;
      return reduced === null ? "–" : valueOf(m.test, reduced);
    },
    value: (m) => (m.test === "modulus" ? m.modulus_of_curve_pa : m.toughness_of_curve_pa),
  },
  { heading: "points of the curve", minor: true, show: (m) => m.points, value: (m) => m.points },
  {
    heading: "strain rate / s⁻¹",
    minor: true,
    show: (m) => figure(m.strain_rate_per_s),
    value: (m) => m.strain_rate_per_s,
  },
  { heading: "thickness / mm", minor: true, show: (m) => figure(m.thickness_mm), value: (m) => m.thickness_mm },
  { heading: "batch", minor: true, words: true, show: (m) => m.batch || "–", value: (m) => m.batch },
  { heading: "printed as no.", minor: true, show: (m) => m.print_order || "–", value: (m) => m.print_order },
  {
    heading: "entered as",
    words: true,
    minor: true,
    show: (m) => (m.valid ? "valid" : "not valid"),
    value: (m) => m.valid,
  },
  { heading: "note, file and reduction", words: true, show: (m) => m.note || "none", value: (m) => m.note },
];

const DECISIONS: Column<ToldReview>[] = [
  { heading: "revision", show: (r) => r.revision, value: (r) => r.revision },
  {
    heading: "decision",
    words: true,
    show: (r) => <span class={`chip ${r.valid ? "approved" : "rejected"}`}>{r.valid ? "valid" : "not valid"}</span>,
    value: (r) => (r.valid ? "valid" : "not valid"),
  },
  { heading: "by", words: true, show: (r) => r.by, value: (r) => r.by },
  { heading: "why", words: true, show: (r) => r.why, value: (r) => r.why },
];

/** `children`: where the specimen is judged. */
export function SpecimenPage({
  specimen,
  laboratory,
  children,
}: {
  specimen: LaboratorySpecimen;
  laboratory: Laboratory;
  children: ComponentChildren;
}) {
  const version = JSON.stringify(specimen);
  const about = { specimen: specimen.specimen };
  const { value: story, problem } = useReading<SpecimenStory>("/api/specimen", about, version);
  const told = story?.measurements.at(-1);
  const order = laboratory.orders.find((o) => o.order === told?.order);
  const group = laboratory.groups.find((g) => g.tested.includes(specimen.specimen));
  const { design, test } = specimen;
  return (
    <>
      <p class="back">
        <a href={addressOf("laboratory")}>all specimens</a>
      </p>
      <section class="panel">
        <h2>Specimen {specimen.specimen}</h2>
        <div class="design-head">
          <Unit design={design} size={110} />
          <Facts
            facts={[
              [
                "design",
                <a href={addressOf("game", { design })}>
                  <Name design={design} />
                </a>,
              ],
              ["test", `${test}${unusual(specimen)}`],
              ["value", valueOf(test, test === "modulus" ? specimen.modulus_pa : specimen.toughness_pa)],
              ...orderFacts(order, told),
              ...groupFacts(group, specimen),
            ]}
          />
        </div>
        <ReplicateCurves of={specimen} version={version} />
      </section>
      {children}
      <section class="panel">
        {story ? (
          <>
            <Table
              name={`${specimen.specimen}-measured`}
              caption="As it was entered"
              rows={story.measurements}
              rowKey={(m) => JSON.stringify(m)}
              empty="The analyser has not stored it yet."
              columns={MEASURED}
            />
            <Table
              name={`${specimen.specimen}-decisions`}
              caption="Decisions"
              rows={story.reviews}
              rowKey={(r) => String(r.revision) + r.by + r.why}
              empty="Nobody has judged it: it counts as it was entered."
              columns={DECISIONS}
            />
          </>
        ) : (
          <Awaited problem={problem} />
        )}
      </section>
      <section class="panel">
        <Notes about="specimen" name={specimen.specimen} />
      </section>
    </>
  );
}
