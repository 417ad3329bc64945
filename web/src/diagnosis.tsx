// What the simulation gets wrong, and why: the analyser's word, round by round.

import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import type { Candidate, Diagnosis as Word, Effect, Experiment, Rounds } from "./api";
import { figure, percent, words } from "./numbers";
import { Name, Problem, Table, Unit } from "./parts";
import { useReading } from "./reading";
import { saveCsv } from "./save";

const VERDICTS: Record<string, string> = {
  base_sufficient: "The base model is sufficient",
  named: "A cause is named",
  ambiguous: "Ambiguous: these data cannot tell yet",
  unexplained: "Something is wrong that no known effect explains",
};

const STATUS: Record<string, string> = {
  in_set: "possible",
  excluded: "excluded",
  invisible: "invisible on these data",
  not_applicable: "not applicable",
};

/** A figure of an effect that took part; a dash for one that these specimens cannot show. */
const weighed = (candidate: Candidate, text: string) => (candidate.status === "not_applicable" ? "–" : text);

/** A parameter with its 90 % interval on a scale from 0. */
function Interval({ effect }: { effect: Effect }) {
  const [low, high] = effect.interval90;
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

function Gain({ gain }: { gain: NonNullable<Word["gain"]> }) {
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
      <h3>Gain on designs that were left out</h3>
      {row("base model", before, "before")}
      {row("extended", after, "after")}
      {gain.relative_reduction !== undefined && (
        <p class="quiet">
          {percent(Math.abs(gain.relative_reduction))} {gain.relative_reduction < 0 ? "more" : "less"} error
          {gain.interval90 &&
            `; reduction, 90 % interval ${percent(gain.interval90[0])} to ${percent(gain.interval90[1])}` +
              (gain.interval90[0] > 0 ? "" : ": not established")}
        </p>
      )}
    </>
  );
}

/** What the picture of a verdict shows, as a table. */
function saveWord(word: Word): void {
  const rows: unknown[][] = word.effects.map((e) => [e.name, e.parameter, ...e.interval90, e.unit]);
  if (word.gain) {
    const { held_out_error_before, held_out_error_after, relative_reduction, interval90 } = word.gain;
    rows.push(["held_out_error_before", held_out_error_before], ["held_out_error_after", held_out_error_after]);
    if (relative_reduction !== undefined) rows.push(["relative_reduction", relative_reduction, ...(interval90 ?? [])]);
  }
  saveCsv(`diagnosis-${word.round}`, ["what", "value", "low90", "high90", "unit"], rows);
}

/** What the analyser found, with the size of every effect and what it gained. */
function Verdict({ word }: { word: Word }) {
  return (
    <>
      <h2>{VERDICTS[word.verdict] ?? words(word.verdict)}</h2>
      <p>{word.summary}</p>
      {word.against && <p class="doubt">{word.against}</p>}
      {word.effects.map((e) => (
        <div key={e.name} class="effect">
          <div>
            <strong>{words(e.name)}</strong>
            {e.family && <span class="quiet"> · {e.family}</span>}
            <p class="quiet">{e.explanation}</p>
          </div>
          <div>
            <Interval effect={e} />
            <p>
              {figure(e.parameter)} ({figure(e.interval90[0])} to {figure(e.interval90[1])}) {e.unit}
            </p>
          </div>
        </div>
      ))}
      {word.gain && <Gain gain={word.gain} />}
      {(word.effects.length > 0 || word.gain) && (
        <button type="button" class="quiet" aria-label="effects and gain as CSV" onClick={() => saveWord(word)}>
          CSV
        </button>
      )}
    </>
  );
}

function NextTests({ word }: { word: Word }) {
  return (
    <section class="panel">
      <Table
        name={`next-tests-${word.round}`}
        caption="Tests that would settle what is open"
        rows={word.next_experiments}
        rowKey={(e: Experiment) => JSON.stringify(e)}
        empty="None is asked for."
        columns={[
          {
            heading: "design",
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
            heading: "test",
            words: true,
            show: (e) => `${e.test}${e.orientation_deg ? ", turned" : ""}`,
            value: (e) => e.test,
          },
          { heading: "orientation_deg", value: (e) => e.orientation_deg },
          { heading: "strain_rate_per_s", value: (e) => e.strain_rate_per_s },
          { heading: "thickness_mm", value: (e) => e.thickness_mm },
          { heading: "loading", value: (e) => e.loading },
          { heading: "replicates", show: (e) => e.replicates, value: (e) => e.replicates },
          { heading: "why", words: true, show: (e) => e.reason, value: (e) => e.reason },
        ]}
      />
    </section>
  );
}

function Candidates({ word }: { word: Word }) {
  return (
    <section class="panel">
      <Table
        name={`candidates-${word.round}`}
        caption="Every effect that was weighed"
        rows={[...word.candidates].sort((a, b) => b.statistic - a.statistic)}
        rowKey={(c: Candidate) => c.name}
        empty="No effect was weighed."
        columns={[
          {
            heading: "effect",
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
            heading: "status",
            words: true,
            show: (c) => (
              <span class={`chip ${c.status === "in_set" ? "pending" : ""}`}>{STATUS[c.status] ?? c.status}</span>
            ),
            value: (c) => c.status,
          },
          {
            heading: "drop of χ²",
            csv: "statistic",
            show: (c) => weighed(c, figure(c.statistic)),
            value: (c) => c.statistic,
          },
          {
            heading: "p, family-wise",
            csv: "p_family_wise",
            show: (c) => weighed(c, figure(c.p_family_wise, 2)),
            value: (c) => c.p_family_wise,
          },
          {
            heading: "absorbed by the base",
            csv: "absorption",
            show: (c) => weighed(c, percent(c.absorption, 0)),
            value: (c) => c.absorption,
          },
        ]}
      />
    </section>
  );
}

/** The word on one round; while another round is read, nothing of the one before. */
function WordOn({ round, rounds, tabs }: { round: number; rounds: Rounds; tabs: ComponentChildren }) {
  const { value: word, problem } = useReading<Word>("/api/diagnosis", { round }, rounds);
  return (
    <>
      <section class={`panel verdict ${word?.verdict ?? ""}`}>
        <div class="panel-head">
          <p class="eyebrow">diagnosis</p>
          {tabs}
        </div>
        <Problem text={problem} />
        {word ? <Verdict word={word} /> : !problem && <p class="awaited">reading …</p>}
      </section>
      {word && <NextTests word={word} />}
      {word && <Candidates word={word} />}
    </>
  );
}

export function Diagnosis({ rounds }: { rounds: Rounds }) {
  const diagnosed = rounds.rounds.filter((r) => r.verdict).map((r) => r.round);
  const [picked, setPicked] = useState<number | null>(null);
  const round = picked ?? diagnosed.at(-1);
  if (round === undefined)
    return <p class="awaited wait">No diagnosis yet: the first one follows the first measurements of proposals.</p>;
  const tabs = (
    <div class="tabs small" role="group" aria-label="round">
      {diagnosed.map((r) => (
        <button type="button" key={r} aria-pressed={r === round} onClick={() => setPicked(r)}>
          round {r}
        </button>
      ))}
    </div>
  );
  return <WordOn round={round} rounds={rounds} tabs={tabs} />;
}
