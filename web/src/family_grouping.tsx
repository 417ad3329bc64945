// Which designs belong together: proposed by nacre, changed by a person.

import type { Families, NamedSeeds } from "./api";
import { useDraft } from "./kept_draft";
import { MaterialKey, Notice, Unit } from "./parts";
import { useSubmit } from "./submit";

const NONE = -1;

/** A person's grouping that is not saved yet, and the server's grouping when it was begun. */
interface Draft {
  groups: NamedSeeds[];
  from: string;
}

/** What is wrong with the families' names, as a sentence; empty: nothing. */
function faultIn(names: string[]): string {
  const unfit = names.find((name) => !/^[A-Za-z0-9_-]{1,64}$/.test(name));
  if (unfit !== undefined) return `“${unfit}”: a family's name has letters, digits, - and _, at most 64.`;
  const number = names.find((name) => /^[0-9]+$/.test(name));
  if (number !== undefined)
    return `“${number}”: a family's name does not have digits alone, since numbers name the models of rounds.`;
  const twice = names.find((name, i) => names.indexOf(name) < i);
  if (twice !== undefined) return `“${twice}”: two families have this name.`;
  return names.length === 0 ? "A grouping has at least one family." : "";
}

export function Grouping({
  families: { grouping, stage, enabled },
  run,
  refresh,
  colour,
}: {
  families: Families;
  run: string;
  refresh: () => Promise<void>;
  colour: (index: number) => string;
}) {
  const { families, near_pareto: near, from, problem } = grouping;
  // Without a draft the groups follow the server; with one they stay a person's.
  const [draft, setDraft] = useDraft<Draft | null>("grouping", null);
  const [notice, busy, submit] = useSubmit(refresh, "saving …");
  const server = JSON.stringify(families);
  const groups = draft?.groups ?? families;
  const designs = [...new Set([...[...families, ...groups].flatMap((f) => f.seeds), ...near])];
  const changed = JSON.stringify(groups) !== server;
  const isOvertaken = draft !== null && changed && draft.from !== server;
  const setGroups = (next: NamedSeeds[]) =>
    setDraft(JSON.stringify(next) === server ? null : { groups: next, from: draft?.from ?? server });
  const kept = groups.filter((g) => g.seeds.length > 0);
  const fault = faultIn(kept.map((g) => g.name));
  const groupOf = (design: string) => groups.findIndex((g) => g.seeds.includes(design));
  const move = (design: string, to: number) => {
    const next = groups.map((g) => ({ ...g, seeds: g.seeds.filter((s) => s !== design) }));
    if (to === groups.length) {
      let number = groups.length + 1;
      while (groups.some((g) => g.name === `family-${number}`)) ++number;
      next.push({ name: `family-${number}`, seeds: [design] });
    } else if (to !== NONE) {
      // In the order of the designs, so that moving one back is no change.
      next[to].seeds = designs.filter((d) => d === design || next[to].seeds.includes(d));
    }
    setGroups(next);
  };
  const save = async () => {
    const done =
      stage.length === 0 && enabled
        ? "Saved: the family stage will use it."
        : `Saved: nacre families --run ${run} will use it.`;
    if (await submit("/api/grouping", { families: kept }, done))
      setDraft((now) => (now === draft ? null : now)); // what was changed meanwhile is not saved yet
  };
  return (
    <section class="panel">
      <div class="panel-head">
        <h2>Grouping</h2>
        <MaterialKey />
      </div>
      <p class="quiet">
        {from === "file"
          ? "From families.toml in the run's folder."
          : "Proposed by nacre: the best designs, grouped by similar patterns and properties."}{" "}
        {stage.length > 0
          ? "The family stage has used the families above; another grouping is for nacre families."
          : "Move designs to other families as you like."}
      </p>
      {problem && (
        <p class="notice bad" role="status">
          {problem}
        </p>
      )}
      <ul class="cards groups">
        {groups.map((group, index) => (
          <li key={index} class="card">
            <label class="name" style={{ "--c": `var(--${colour(index)})` } as never}>
              <span class="swatch" aria-hidden="true" />
              <input
                value={group.name}
                aria-label={`name of family ${index + 1}`}
                maxLength={64}
                onInput={(e) => {
                  const name = e.currentTarget.value;
                  setGroups(groups.map((g, i) => (i === index ? { ...g, name } : g)));
                }}
              />
            </label>
            <Members designs={group.seeds} groups={groups} groupOf={groupOf} move={move} />
          </li>
        ))}
        {designs.some((d) => groupOf(d) === NONE) && (
          <li class="card">
            <strong>in no family</strong>
            <Members
              designs={designs.filter((d) => groupOf(d) === NONE)}
              groups={groups}
              groupOf={groupOf}
              move={move}
            />
          </li>
        )}
      </ul>
      <div class="buttons">
        <button type="button" disabled={!changed || busy || fault !== ""} onClick={save}>
          Save this grouping
        </button>
        <button type="button" class="quiet" disabled={!changed} onClick={() => setDraft(null)}>
          {isOvertaken ? "use the new one" : "undo"}
        </button>
      </div>
      {isOvertaken && (
        <p class="notice doubt" role="status">
          {from === "file" ? "families.toml has" : "The proposal has"} changed since you began: your grouping stays
          until you save it or use the new one.
        </p>
      )}
      <Notice notice={fault ? { kind: "bad", text: fault } : notice} />
    </section>
  );
}

function Members({
  designs,
  groups,
  groupOf,
  move,
}: {
  designs: string[];
  groups: NamedSeeds[];
  groupOf: (design: string) => number;
  move: (design: string, to: number) => void;
}) {
  return (
    <ul class="units">
      {designs.map((design) => (
        <li key={design} class="member">
          <Unit design={design} size={66} />
          <select
            aria-label={`family of ${design}`}
            value={groupOf(design)}
            onChange={(e) => move(design, Number(e.currentTarget.value))}
          >
            {groups.map((g, i) => (
              <option key={i} value={i}>
                {g.name}
              </option>
            ))}
            <option value={groups.length}>a new family</option>
            <option value={NONE}>no family</option>
          </select>
        </li>
      ))}
    </ul>
  );
}
