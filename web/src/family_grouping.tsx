// Which designs belong together: proposed by the program, changed by a person.

import type { Families as Said, NamedSeeds } from "./api";
import { useHandIn } from "./hand_in";
import { Notice, Unit, useDraft } from "./parts";

const NONE = -1;

/** A person's grouping that nobody has kept yet, and what the server said when it was begun. */
interface Draft {
  groups: NamedSeeds[];
  from: string;
}

export function Grouping({
  said,
  run,
  refresh,
  colour,
}: {
  said: Said;
  run: string;
  refresh: () => Promise<void>;
  colour: (index: number) => string;
}) {
  const { families, near_pareto: near, from, problem } = said.grouping;
  // Without a draft the groups follow the server; with one they stay a person's.
  const [draft, setDraft] = useDraft<Draft | null>("grouping", null);
  const [notice, busy, handIn] = useHandIn(refresh, "writing …");
  const server = JSON.stringify(families);
  const groups = draft?.groups ?? families;
  const designs = [...new Set([...[...families, ...groups].flatMap((f) => f.seeds), ...near])];
  const changed = JSON.stringify(groups) !== server;
  const isOvertaken = draft !== null && changed && draft.from !== server;
  const setGroups = (next: NamedSeeds[]) =>
    setDraft(JSON.stringify(next) === server ? null : { groups: next, from: draft?.from ?? server });
  const kept = groups.filter((g) => g.seeds.length > 0);
  const fault = kept.some((g) => !/^[A-Za-z0-9_-]{1,64}$/.test(g.name))
    ? "A family's name has letters, digits, - and _, at most 64."
    : kept.some((g) => /^[0-9]+$/.test(g.name))
      ? "A family's name is not of digits alone: numbers name the models of rounds."
      : new Set(kept.map((g) => g.name)).size < kept.length
        ? "Two families have the same name."
        : kept.length === 0
          ? "A grouping has one family at least."
          : "";
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
  const keep = async () => {
    const done =
      said.stage.length === 0 && said.enabled
        ? "Kept: the family stage takes it."
        : `Kept: nacre families --run ${run} works it out.`;
    if (await handIn("/api/grouping", { families: kept }, done))
      setDraft((now) => (now === draft ? null : now)); // what was changed meanwhile is not kept yet
  };
  return (
    <section class="panel">
      <h2>Grouping</h2>
      <p class="quiet">
        {from === "file"
          ? "As families.toml in the run's folder says."
          : "Proposed by pattern and properties: designs of the first ranks, by likeness."}{" "}
        {said.stage.length > 0
          ? "The stage has been played with the families above; another grouping is for nacre families."
          : "Move designs as you see them."}
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
        <button type="button" disabled={!changed || busy || fault !== ""} onClick={keep}>
          Keep this grouping
        </button>
        <button type="button" class="quiet" disabled={!changed} onClick={() => setDraft(null)}>
          {isOvertaken ? "take the new one" : "as it was"}
        </button>
      </div>
      {isOvertaken && (
        <p class="notice doubt" role="status">
          {from === "file" ? "families.toml has" : "The proposal has"} changed since you began: your grouping stays until
          you keep it or take the new one.
        </p>
      )}
      <Notice said={fault ? { kind: "bad", text: fault } : notice} />
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
