// The laboratory's work: decide on proposals, enter measurements, judge specimens.

import type { DesignState, Families, Group, Laboratory as Work, Rounds, RunInfo } from "./api";
import { Entry } from "./entry";
import { gpa, mpa, percent } from "./numbers";
import { Awaited, Name, Problem, Table, Unit, unusual, useRepeated, useStored } from "./parts";
import { offerOf, Proposals } from "./proposals";
import { AGAIN_MS, useAnswer } from "./reading";
import { Specimens } from "./review";

const stateColumns = [
  {
    heading: "design",
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
    heading: "state",
    words: true,
    show: (d: DesignState) => <span class={`chip ${d.state}`}>{d.state}</span>,
    value: (d: DesignState) => d.state,
  },
  {
    heading: "proposed",
    csv: "proposed_in_round",
    show: (d: DesignState) => d.proposed_in_round ?? "–",
    value: (d: DesignState) => d.proposed_in_round,
  },
  { heading: "ordered", show: (d: DesignState) => d.ordered, value: (d: DesignState) => d.ordered },
  { heading: "printed", show: (d: DesignState) => d.printed, value: (d: DesignState) => d.printed },
  { heading: "measured", show: (d: DesignState) => d.measured, value: (d: DesignState) => d.measured },
  { heading: "valid", show: (d: DesignState) => d.valid, value: (d: DesignState) => d.valid },
  {
    heading: "decision",
    words: true,
    show: (d: DesignState) => (d.by ? `${d.by}: ${d.why}` : ""),
  },
  { heading: "by", value: (d: DesignState) => d.by },
  { heading: "why", value: (d: DesignState) => d.why },
];

const inUnit = (g: Group, pa: number) => (g.test === "modulus" ? `${gpa(pa)} GPa` : `${mpa(pa)} MPa`);

/** Green only where nothing is open: outliers that nobody has judged spoil a mean. */
function chipOf(g: Group): string {
  if (g.state === "inconsistent") return "rejected";
  return g.state === "complete" && g.proposed_outliers.length === 0 ? "approved" : "pending";
}

const groupColumns = [
  {
    heading: "design",
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
    heading: "test",
    words: true,
    show: (g: Group) => `${g.test}${unusual(g)}`,
    value: (g: Group) => g.test,
  },
  { heading: "orientation_deg", value: (g: Group) => g.orientation_deg },
  { heading: "strain_rate_per_s", value: (g: Group) => g.strain_rate_per_s },
  { heading: "thickness_mm", value: (g: Group) => g.thickness_mm },
  {
    heading: "state",
    words: true,
    show: (g: Group) => (
      <>
        <span class={`chip ${chipOf(g)}`}>
          {g.state === "more needed" ? `${g.wanted} more for a sure mean` : g.state}
        </span>{" "}
        {g.proposed_outliers.length > 0 && <span class="quiet">{g.proposed_outliers.length} out of line</span>}
      </>
    ),
    value: (g: Group) => g.state,
  },
  {
    heading: "valid of tested",
    csv: "valid",
    show: (g: Group) => `${g.valid.length} of ${g.tested.length}`,
    value: (g: Group) => g.valid.length,
  },
  { heading: "tested", value: (g: Group) => g.tested.length },
  { heading: "wanted", value: (g: Group) => g.wanted },
  {
    heading: "mean",
    csv: "mean_pa",
    show: (g: Group) => inUnit(g, g.mean_pa),
    value: (g: Group) => g.mean_pa,
  },
  { heading: "scatter", show: (g: Group) => percent(g.scatter), value: (g: Group) => g.scatter },
  {
    heading: "without those out of line",
    csv: "mean_without_pa",
    show: (g: Group) =>
      g.proposed_outliers.length > 0 ? `${inUnit(g, g.mean_without_pa)}, ${percent(g.scatter_without)}` : "",
    value: (g: Group) => g.mean_without_pa,
  },
  { heading: "scatter_without", value: (g: Group) => g.scatter_without },
];

export function Laboratory({ info, rounds, playing }: { info: RunInfo; rounds: Rounds; playing: boolean }) {
  const families = useAnswer<Families>("/api/families");
  const book = useAnswer<Work>("/api/laboratory");
  const [by, setBy] = useStored("by", info.user);
  const refresh = async () => {
    await families.read();
    await book.read();
  };
  const problem = book.problem || families.problem;
  useRepeated(refresh, playing ? 2000 : problem ? AGAIN_MS : 30_000);
  const work = book.value;
  if (!work) return <Awaited problem={book.problem} what="reading the laboratory's book …" />;
  const lastRound = rounds.rounds.find((r) => r.summary?.last)?.round ?? info.rounds;
  return (
    <>
      <Problem text={problem} />
      {playing && (
        <div class="row who">
          <label>
            You are <input value={by} maxLength={60} onInput={(e) => setBy(e.currentTarget.value)} />
          </label>
          <span class="quiet">
            {by ? "kept with everything you decide here" : "decisions and judgements need a name"}
          </span>
        </div>
      )}
      {families.value && ( // only the stage tells whether a proposal is still to be decided on
        <Proposals
          work={work}
          offer={offerOf(work, families.value.stage, lastRound)}
          by={by}
          refresh={refresh}
          playing={playing}
          approval={info.approval}
        />
      )}
      <Entry work={work} refresh={refresh} playing={playing} />
      <Specimens work={work} by={by} refresh={refresh} playing={playing} />
      <section class="panel">
        <Table
          name="replicates"
          caption="Replicates: a mean is sure once as many are tested as the game orders, and enough of them agree"
          rows={work.groups}
          rowKey={(g) => g.tested[0]}
          empty="Nothing has been measured yet."
          columns={groupColumns}
        />
      </section>
      <section class="panel">
        <Table
          name="designs"
          caption="Designs"
          rows={work.designs}
          rowKey={(d) => d.design}
          empty="There is no design yet."
          columns={stateColumns}
        />
      </section>
    </>
  );
}
