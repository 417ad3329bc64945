// The laboratory's work: approve proposals, enter measurements, review specimens.

import type { DesignState, Families, Group, Laboratory, Rounds, RunInfo } from "./api";
import { ImportFiles } from "./import_files";
import { MeasurementForm } from "./measurement_form";
import { gpa, mpa, percent } from "./numbers";
import { Awaited, DesignChip, Name, Problem, Table, Unit, unusual, useRepeated, useStored } from "./parts";
import { Orders } from "./orders";
import { PrintJobs } from "./print_jobs";
import { offerOf, Proposals } from "./proposals";
import { AGAIN_MS, useResponse } from "./reading";
import { Specimens } from "./review";
import type { Looking } from "./route";
import { SpecimenPage } from "./specimen_story";
import { TERMS } from "./terms";

const stateColumns = (waits: boolean) => [
  {
    ...TERMS.design,
    words: true,
    show: (d: DesignState) => (
      <span class="with-unit">
        <Unit design={d.design} size={22} label={false} />
        <Name design={d.design} />
      </span>
    ),
    value: (d: DesignState) => d.design,
  },
  {
    ...TERMS.designState,
    words: true,
    show: (d: DesignState) => <DesignChip state={d.state} waits={waits} />,
    value: (d: DesignState) => d.state,
  },
  {
    ...TERMS.proposedIn,
    minor: true,
    csv: "proposed_in_round",
    show: (d: DesignState) => d.proposed_in_round ?? "–",
    value: (d: DesignState) => d.proposed_in_round,
  },
  { ...TERMS.ordered, minor: true, show: (d: DesignState) => d.ordered, value: (d: DesignState) => d.ordered },
  { ...TERMS.printed, minor: true, show: (d: DesignState) => d.printed, value: (d: DesignState) => d.printed },
  { ...TERMS.measured, show: (d: DesignState) => d.measured, value: (d: DesignState) => d.measured },
  { ...TERMS.valid, minor: true, show: (d: DesignState) => d.valid, value: (d: DesignState) => d.valid },
  {
    ...TERMS.approval,
    words: true,
    minor: true,
    show: (d: DesignState) => (d.by ? `${d.by}: ${d.why}` : ""),
    order: (d: DesignState) => d.by,
  },
  { heading: "by", value: (d: DesignState) => d.by },
  { heading: "why", value: (d: DesignState) => d.why },
];

const percentOrDash = (share: number | null) => (share === null ? "-" : percent(share));
const inUnit = (g: Group, pa: number | null) =>
  pa === null ? "-" : (g.test === "modulus" ? `${gpa(pa)} GPa` : `${mpa(pa)} MPa`);

/** Green only where nothing is open: outliers that nobody has reviewed spoil a mean. */
function chipOf(g: Group): string {
  if (g.state === "inconsistent") return "rejected";
  return g.state === "complete" && g.proposed_outliers.length === 0 ? "approved" : "pending";
}

function inWords(g: Group): string {
  if (g.state === "inconsistent") return "specimens disagree";
  return g.state === "more needed" ? `${g.wanted} more needed` : g.state;
}

const groupColumns = [
  {
    ...TERMS.design,
    words: true,
    show: (g: Group) => (
      <span class="with-unit">
        <Unit design={g.design} size={22} label={false} />
        <Name design={g.design} />
      </span>
    ),
    value: (g: Group) => g.design,
  },
  {
    ...TERMS.test,
    words: true,
    show: (g: Group) => `${g.test}${unusual(g)}`,
    value: (g: Group) => g.test,
  },
  { heading: "orientation_deg", value: (g: Group) => g.orientation_deg },
  { heading: "strain_rate_per_s", value: (g: Group) => g.strain_rate_per_s },
  { heading: "thickness_mm", value: (g: Group) => g.thickness_mm },
  {
    ...TERMS.groupState,
    words: true,
    show: (g: Group) => (
      <>
        <span class={`chip ${chipOf(g)}`}>{inWords(g)}</span>{" "}
        {g.proposed_outliers.length > 0 && (
          <span class="quiet">
            {g.proposed_outliers.length === 1 ? "1 outlier" : `${g.proposed_outliers.length} outliers`} to review
          </span>
        )}
      </>
    ),
    value: (g: Group) => g.state,
  },
  {
    ...TERMS.validOfTested,
    minor: true,
    csv: "valid",
    show: (g: Group) => `${g.valid.length} of ${g.tested.length}`,
    value: (g: Group) => g.valid.length,
  },
  { heading: "tested", value: (g: Group) => g.tested.length },
  { heading: "wanted", value: (g: Group) => g.wanted },
  {
    ...TERMS.mean,
    csv: "mean_pa",
    show: (g: Group) => inUnit(g, g.mean_pa),
    value: (g: Group) => g.mean_pa,
  },
  { ...TERMS.scatter, minor: true, show: (g: Group) => percentOrDash(g.scatter), value: (g: Group) => g.scatter },
  {
    ...TERMS.withoutOutliers,
    minor: true,
    csv: "mean_without_pa",
    show: (g: Group) =>
      g.proposed_outliers.length > 0
        ? `${inUnit(g, g.mean_without_pa)}, ${percentOrDash(g.scatter_without)}`
        : "",
    value: (g: Group) => g.mean_without_pa,
  },
  { heading: "scatter_without", value: (g: Group) => g.scatter_without },
];

export function LaboratoryView({
  info,
  rounds,
  playing,
  isOver,
  looking: { at },
}: {
  info: RunInfo;
  rounds: Rounds;
  playing: boolean;
  isOver: boolean;
  looking: Looking;
}) {
  const families = useResponse<Families>("/api/families");
  const book = useResponse<Laboratory>("/api/laboratory");
  const [by, setBy] = useStored("by", info.user);
  const refresh = async () => {
    await families.read();
    await book.read();
  };
  const problem = book.problem || families.problem;
  useRepeated(refresh, playing ? 2000 : problem ? AGAIN_MS : 30_000);
  const laboratory = book.value;
  if (!laboratory) return <Awaited problem={book.problem} what="reading the measurements …" />;
  const specimens = (shown: Laboratory) => (
    <Specimens
      laboratory={shown}
      by={by}
      refresh={refresh}
      playing={playing}
      isOver={isOver}
      chosen={at.specimen}
    />
  );
  const chosen = laboratory.specimens.find((s) => s.specimen === at.specimen);
  if (chosen)
    return (
      <>
        <Problem text={problem} />
        <SpecimenPage specimen={chosen} laboratory={laboratory}>
          {specimens({ ...laboratory, specimens: [chosen] })}
        </SpecimenPage>
      </>
    );
  const lastRound = rounds.rounds.find((r) => r.summary?.last)?.round ?? info.rounds;
  return (
    <>
      <Problem text={problem} />
      {at.specimen && (
        <Problem text={`This run has no specimen “${at.specimen}”${isOver ? "" : " yet"}.`} />
      )}
      {playing && (
        <div class="row who">
          <label>
            You are <input value={by} maxLength={60} onInput={(e) => setBy(e.currentTarget.value)} />
          </label>
          <span class="quiet">
            {by ? "kept with your approvals and reviews" : "approvals and reviews need a name"}
          </span>
        </div>
      )}
      {families.value && ( // only the stage tells whether a proposal is still open
        <Proposals
          laboratory={laboratory}
          offer={offerOf(laboratory, families.value.stage, lastRound)}
          by={by}
          refresh={refresh}
          playing={playing}
          approval={info.approval}
          hasPrice={!info.virtual_lab}
          isOver={isOver}
        />
      )}
      {playing && <Orders laboratory={laboratory} by={by} refresh={refresh} />}
      {playing && !info.virtual_lab && <PrintJobs laboratory={laboratory} by={by} refresh={refresh} />}
      <ImportFiles laboratory={laboratory} refresh={refresh} playing={playing} />
      <MeasurementForm laboratory={laboratory} refresh={refresh} playing={playing} />
      {specimens(laboratory)}
      <section class="panel">
        <Table
          name="replicates"
          caption="Replicates: a mean is reliable once as many are tested as the game orders, and enough of them agree"
          rows={laboratory.groups}
          rowKey={(g) => g.tested[0]}
          empty={isOver ? "Nothing was measured." : "Nothing has been measured yet."}
          columns={groupColumns}
        />
      </section>
      <section class="panel">
        <Table
          name="designs"
          caption="Designs"
          rows={laboratory.designs}
          rowKey={(d) => d.design}
          empty="There is no design yet."
          columns={stateColumns(info.approval && playing)}
        />
      </section>
    </>
  );
}
