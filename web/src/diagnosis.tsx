// What the simulation gets wrong, and why: the analyser's diagnosis of each round.

import type { ComponentChildren } from "preact";
import type { CandidateEffect, Diagnosis, Effect, Experiment, Revealed, Rounds } from "./api";
import { figure, percent, words } from "./numbers";
import { Awaited, Name, Nowhere, Problem, Table, Unit } from "./parts";
import { useReading } from "./reading";
import { addressOf, type Looking } from "./route";
import { saveCsv } from "./save";
import { TERMS } from "./terms";

const VERDICTS: Record<string, string> = {
  base_sufficient: "Nothing is missing: the base model explains the measurements",
  named: "A missing effect is named",
  ambiguous: "Something is missing: these measurements cannot tell yet what",
  unexplained: "Something is missing that no known effect explains",
  insufficient: "Too little was measured to tell",
};

/** Nothing could be considered. */
const nothingWasWeighed = (d: Diagnosis) => d.verdict === "insufficient" && d.candidates.length === 0;

/** Nothing is missing by the diagnosis, and yet the calibration of the round does not fit. */
const isDoubted = (d: Diagnosis) => d.verdict === "base_sufficient" && d.against !== "";

function headline(d: Diagnosis): string {
  if (isDoubted(d)) return "The diagnosis finds nothing missing, and yet the calibration does not fit";
  return VERDICTS[d.verdict] ?? words(d.verdict);
}

function noNextTest(d: Diagnosis): string {
  if (nothingWasWeighed(d)) return "None is proposed before there are more measurements.";
  return d.verdict === "base_sufficient" ? "No further test is needed." : "No further test is proposed.";
}

/** What a status means. */
const STATUS: Record<string, { text: string; hint: string }> = {
  in_set: { text: "explains it", hint: "With this effect the model agrees with the measurements." },
  excluded: { text: "no sign of it", hint: "It would have shown." },
  noticed: {
    text: "does not explain it",
    hint: "The fit improves with it, but other effects explain more, or none explains enough.",
  },
  invisible: {
    text: "these tests cannot say",
    hint: "Its signature is too weak to be told from noise. It may be there all the same.",
  },
  not_simulated: { text: "not simulated", hint: "It may act. diagnosis.simulations does not pay for telling." },
  not_applicable: { text: "these tests cannot say", hint: "No specimen and test of this set would show it." },
};

/** Chance below which an effect is noticed (Levels::name). */
const NOTICED = 0.003;

function statusOf(c: CandidateEffect) {
  return STATUS[c.status === "excluded" && c.p_family_wise <= NOTICED ? "noticed" : c.status];
}

/** A number of a candidate effect; a dash for one that these specimens cannot show. */
const weighed = (candidate: CandidateEffect, text: string) => (candidate.status.startsWith("not_") ? "–" : text);

/** A parameter with its 90 % interval on a scale from 0. */
function Interval({ effect }: { effect: Effect }) {
  const [low, high] = [effect.interval_low, effect.interval_high];
  const span = Math.max(Math.abs(low), Math.abs(high), Math.abs(effect.parameter)) || 1;
  const least = Math.min(0, low, effect.parameter);
  const x = (v: number) => 4 + (192 * (v - least)) / (span - least || 1);
  return (
    <svg
      viewBox="0 0 200 24"
      width="200"
      height="24"
      role="img"
      aria-label={`${figure(effect.parameter)}, between ${figure(low)} and ${figure(high)}`}
    >
      <line x1={x(0)} x2={x(0)} y1="3" y2="21" class="axis" />
      <line x1={x(low)} x2={x(high)} y1="12" y2="12" class="range" />
      <circle cx={x(effect.parameter)} cy="12" r="4.5" class="value" />
    </svg>
  );
}

function Gain({ gain }: { gain: NonNullable<Diagnosis["gain"]> }) {
  // Errors are of logarithms.
  const before = Math.expm1(gain.held_out_error_before);
  const after = Math.expm1(gain.held_out_error_after);
  const largest = Math.max(before, after);
  const row = (name: string, value: number, cls: string) => (
    <div class="gain">
      <span>{name}</span>
      <span class="track">
        <span class={cls} style={{ width: `${(100 * value) / largest}%` }} />
      </span>
      <span>{percent(value)}</span>
    </div>
  );
  return (
    <>
      <h3>Error on held-out designs: kept back from the fit to test it</h3>
      {row("base model", before, "before")}
      {row("extended", after, "after")}
      <p class="quiet">
        {percent(Math.abs(gain.relative_reduction))} {gain.relative_reduction < 0 ? "more" : "less"} error; reduction,
        90 % interval {percent(gain.reduction_low)} to {percent(gain.reduction_high)}
        {gain.reduction_low > 0 ? "" : ": not established"}
      </p>
    </>
  );
}

/** Effects and gain, as a table. */
function saveDiagnosis(diagnosis: Diagnosis): void {
  const rows: unknown[][] = diagnosis.effects.map((e) => [
    e.name,
    e.parameter,
    e.interval_low,
    e.interval_high,
    e.unit,
  ]);
  if (diagnosis.gain) {
    const { held_out_error_before, held_out_error_after, relative_reduction, reduction_low, reduction_high } =
      diagnosis.gain;
    rows.push(["held_out_error_before", held_out_error_before], ["held_out_error_after", held_out_error_after]);
    rows.push(["relative_reduction", relative_reduction, reduction_low, reduction_high]);
  }
  saveCsv(`diagnosis-${diagnosis.round}`, ["what", "value", "low90", "high90", "unit"], rows);
}

/** The verdict, with the size of every effect and what it gains. */
function Verdict({ diagnosis }: { diagnosis: Diagnosis }) {
  return (
    <>
      <h2>{headline(diagnosis)}</h2>
      <p>{diagnosis.summary}</p>
      {diagnosis.against && <p class="doubt">{diagnosis.against}</p>}
      {diagnosis.effects.map((e) => (
        <div key={e.name} class="effect">
          <div>
            <strong>{words(e.name)}</strong>
            {e.family && <span class="quiet"> · {e.family}</span>}
            <p class="quiet">{e.explanation}</p>
          </div>
          <div>
            <Interval effect={e} />
            <p>
              {figure(e.parameter)} ({figure(e.interval_low)} to {figure(e.interval_high)}) {e.unit}
            </p>
          </div>
        </div>
      ))}
      {diagnosis.gain && <Gain gain={diagnosis.gain} />}
      {(diagnosis.effects.length > 0 || diagnosis.gain) && (
        <button
          type="button"
          class="quiet"
          aria-label="effects and gain as CSV"
          onClick={() => saveDiagnosis(diagnosis)}
        >
          CSV
        </button>
      )}
    </>
  );
}

function NextTests({ diagnosis }: { diagnosis: Diagnosis }) {
  return (
    <section class="panel">
      <Table
        name={`next-tests-${diagnosis.round}`}
        caption="Next tests, which would settle what is open"
        rows={diagnosis.next_experiments}
        rowKey={(e: Experiment) => JSON.stringify(e)}
        empty={noNextTest(diagnosis)}
        columns={[
          {
            ...TERMS.design,
            words: true,
            show: (e) => (
              <span class="with-unit">
                <Unit design={e.design} size={34} label={false} />
                <Name design={e.design} />
              </span>
            ),
            value: (e) => e.design,
          },
          {
            ...TERMS.test,
            words: true,
            show: (e) => `${e.test}${e.orientation_deg ? ", turned" : ""}`,
            value: (e) => e.test,
          },
          { heading: "orientation_deg", value: (e) => e.orientation_deg },
          { heading: "strain_rate_per_s", value: (e) => e.strain_rate_per_s },
          { heading: "thickness_mm", value: (e) => e.thickness_mm },
          { heading: "loading", value: (e) => e.loading },
          {
            heading: "replicates",
            hint: "How many specimens to test.",
            show: (e) => e.replicates,
            value: (e) => e.replicates,
          },
          { heading: "why", words: true, show: (e) => e.reason, value: (e) => e.reason },
        ]}
      />
    </section>
  );
}

function Candidates({ diagnosis }: { diagnosis: Diagnosis }) {
  return (
    <section class="panel">
      <Table
        name={`candidates-${diagnosis.round}`}
        caption="Candidate effects"
        rows={[...diagnosis.candidates].sort((a, b) => b.statistic - a.statistic)}
        rowKey={(c: CandidateEffect) => c.name}
        empty="No effect was considered: there are too few measurements."
        columns={[
          {
            ...TERMS.effect,
            words: true,
            show: (c) => (
              <span title={c.explanation}>
                {words(c.name)}
                <span class="quiet"> {c.family}</span>
              </span>
            ),
            value: (c) => c.name,
          },
          {
            ...TERMS.effectStatus,
            csv: "status",
            words: true,
            show: (c) => (
              <span class={`chip ${c.status === "in_set" ? "approved" : ""}`} title={statusOf(c)?.hint}>
                {statusOf(c)?.text ?? words(c.status)}
              </span>
            ),
            value: (c) => c.status,
          },
          {
            ...TERMS.fitGain,
            csv: "statistic",
            show: (c) => weighed(c, figure(c.statistic)),
            value: (c) => c.statistic,
          },
          {
            ...TERMS.chance,
            csv: "p_family_wise",
            show: (c) => weighed(c, figure(c.p_family_wise, 2)),
            value: (c) => c.p_family_wise,
          },
          {
            ...TERMS.absorption,
            csv: "absorption",
            show: (c) => weighed(c, percent(c.absorption, 0)),
            value: (c) => c.absorption,
          },
        ]}
      />
    </section>
  );
}

/** What a virtual laboratory tells after the last round: beside it the diagnosis is read. */
function Hidden({ revealed }: { revealed: Revealed }) {
  return (
    <section class="panel">
      <p class="eyebrow">what the laboratory had hidden</p>
      {revealed.causes.length === 0 && <p>Nothing: its measurements differ from the base model by noise alone.</p>}
      {revealed.causes.map((cause) => (
        <p key={cause.name}>
          <strong>{words(cause.name)}</strong> {cause.values.map((value) => figure(value)).join(", ")} ({cause.meaning})
          {!cause.in_library &&
            ": the diagnosis has no name for it, the honest answer is that something is unexplained"}
        </p>
      ))}
    </section>
  );
}

/** The diagnosis of one round; while another round is read, nothing of the one before. */
function DiagnosisOf({ round, rounds, tabs }: { round: number; rounds: Rounds; tabs: ComponentChildren }) {
  const { value: diagnosis, problem } = useReading<Diagnosis>("/api/diagnosis", { round }, rounds);
  return (
    <>
      <section class={`panel verdict ${diagnosis && isDoubted(diagnosis) ? "doubted" : (diagnosis?.verdict ?? "")}`}>
        <div class="panel-head">
          <p class="eyebrow">diagnosis</p>
          {tabs}
        </div>
        <Problem text={problem} />
        {diagnosis ? <Verdict diagnosis={diagnosis} /> : !problem && <p class="awaited">reading …</p>}
      </section>
      {diagnosis && <NextTests diagnosis={diagnosis} />}
      {diagnosis && <Candidates diagnosis={diagnosis} />}
    </>
  );
}

/** Why there is none; "yet" only where one may come. */
function whyNone(isOn: boolean, isOver: boolean): string {
  if (!isOn) return "The scenario turns the diagnosis off ([diagnosis] enabled = false).";
  return isOver
    ? "No diagnosis was made: the game ended before proposed designs were measured."
    : "There is no diagnosis yet: the first one follows the first measurements of proposed designs.";
}

export function DiagnosisView({
  rounds,
  isRead,
  isOn,
  isOver,
  looking: { at, look },
}: {
  rounds: Rounds;
  /** Whether the rounds are known. */
  isRead: boolean;
  isOn: boolean;
  isOver: boolean;
  looking: Looking;
}) {
  const diagnosed = rounds.rounds.filter((r) => r.verdict).map((r) => r.round);
  const round = at.round ? Number(at.round) : diagnosed.at(-1);
  if (!isRead) return <Awaited problem="" />;
  if (round === undefined || diagnosed.length === 0) return <p class="awaited wait">{whyNone(isOn, isOver)}</p>;
  if (!diagnosed.includes(round)) {
    const there = diagnosed.length > 1 ? `rounds ${diagnosed.join(", ")}` : `round ${diagnosed[0]}`;
    const why = `Round ${at.round} has no diagnosis: there is one of ${there}.`;
    return <Nowhere why={why} link={addressOf("diagnosis")} />;
  }
  const tabs = (
    <div class="tabs small" role="group" aria-label="round">
      {diagnosed.map((r) => (
        <button type="button" key={r} aria-pressed={r === round} onClick={() => look({ round: String(r) })}>
          round {r}
        </button>
      ))}
    </div>
  );
  return (
    <>
      {rounds.revealed && <Hidden revealed={rounds.revealed} />}
      <DiagnosisOf round={round} rounds={rounds} tabs={tabs} />
    </>
  );
}
