// The families of a run: good designs in groups, the variants of each by its own model, and whether that model predicts
// them better.

import { useMemo, useState } from "preact/hooks";
import type { Families, Family, FamilyDesign, Maps, Rounds } from "./api";
import { chosenInFamilies } from "./chosen";
import { DesignPanel } from "./design_panel";
import { Grouping } from "./family_grouping";
import { familyVariable, PREDICTED, seriesOf, spotsOf, type Shown } from "./family_points";
import { DesignTable, ErrorTable, SubfamilyTable, worseThanGlobal } from "./family_tables";
import { keyAt } from "./gamut";
import { MechanismTable } from "./mechanism_table";
import { figure, GPA, MPA } from "./numbers";
import { Awaited, Problem, UnitButton } from "./parts";
import { PointChart } from "./point_chart";
import { useGamuts, useReading } from "./reading";
import type { Looking } from "./route";
import { newestModel } from "./rounds";

/** What the view shows, and which models not to trust. */
function Explanation({ families }: { families: Families }) {
  const over = families.stage.filter((f) => f.over_fits.length > 0);
  const worse = families.stage.filter((f) => worseThanGlobal(f).length > 0);
  if (families.stage.length === 0)
    return (
      <p class="quiet">
        {families.enabled
          ? "The best designs measured so far, grouped. After the last round each family gets a model of its own, " +
            "which proposes variants to measure."
          : "The best designs measured so far, grouped by pattern and properties. This game has no family stage " +
            "([families] enabled = true adds one); nacre families analyses the groups afterwards."}
      </p>
    );
  return (
    <>
      <p class="quiet">
        Diamonds: measured seeds. Small points: variants within 16 pixels, by the family's own model. Rings: variants
        chosen for the laboratory, as predicted; a line leads to the measured value. Grey: other measured designs.
      </p>
      {over.map((f) => (
        <p key={f.name} class="notice bad" role="status">
          {f.name}: its own model over-fits {f.over_fits.join(" and ")}. It is nearer to the seeds than the global
          model, and farther from the variants: trust the global model.
        </p>
      ))}
      {worse.map((f) => (
        <p key={f.name} class="notice bad" role="status">
          {f.name}: its own model is worse than the global model in {worseThanGlobal(f).join(" and ")} on the variants:
          trust the global model.
        </p>
      ))}
    </>
  );
}

export function FamiliesView({
  rounds,
  data,
  theme,
  run,
  isOver,
  looking: { at, look },
}: {
  rounds: Rounds;
  data: string | null;
  theme: string;
  run: string;
  isOver: boolean;
  looking: Looking;
}) {
  const reading = useReading<Families>("/api/families", {}, data);
  const subfamilies = useReading<Maps>("/api/maps", {}, data);
  const [families, maps] = [reading.value, subfamilies.value];
  const wanted = families?.stage.map((f) => ({ name: f.name, count: f.gamut_count, which: { family: f.name } })) ?? [];
  const { gamuts, problem } = useGamuts(wanted);
  const [hidden, setHidden] = useState<Set<string>>(new Set());
  const [variants, setVariants] = useState(true);
  const all = useMemo<Shown[]>(() => {
    if (!families) return [];
    if (families.stage.length === 0)
      return families.grouping.families.map((g, index) => ({ ...g, index, stage: null, gamut: null }));
    return families.stage.map((stage, index) => ({
      name: stage.name,
      index,
      seeds: stage.designs.filter((d) => d.is_seed).map((d) => d.design),
      stage,
      gamut: gamuts.get(stage.name) ?? null,
    }));
  }, [families, gamuts]);
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
  const chosen = useMemo(
    () => chosenInFamilies(at, spots, gamuts, newest),
    [at.design, at.model, spots, gamuts, newest],
  );
  const choose = ({ design, model }: { design: string; model: number | string }) =>
    look({ design, model: String(model) });
  if (!families) return <Awaited problem={reading.problem} />;
  if (all.length === 0)
    return (
      <p class="awaited wait">
        {isOver
          ? "No pattern was measured in both tests: there are no families."
          : "No pattern has been measured in both tests yet: families of the best designs appear here."}
      </p>
    );
  const open = (family: Family, { design }: FamilyDesign) => choose({ design, model: family.name });
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
                  {families.stage.length > 0 && (
                    <label class="toggle" style={{ "--c": "var(--homo)" } as never}>
                      <input type="checkbox" checked={variants} onChange={() => setVariants(!variants)} />
                      <span>variants</span>
                    </label>
                  )}
                </fieldset>
              </div>
            </div>
            <Problem text={reading.problem || problem} />
            <Explanation families={families} />
            <PointChart
              name="families"
              label="Families: toughness against Young's modulus"
              empty="Every family is switched off: choose one above."
              series={series}
              clouds={clouds}
              spots={spots}
              chosen={chosen}
              choose={choose}
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
          {families.stage.length > 0 && (
            <section class="panel after">
              <ErrorTable families={families.stage} which="chosen" />
              <ErrorTable families={families.stage} which="seeds" />
            </section>
          )}
        </div>
        <DesignPanel chosen={chosen} data={data}>
          <p class="quiet">Click a point, or press Enter on it, to see it break with its family's model.</p>
          {shown.map((family) => {
            const spotsOfIt = spots.filter((s) => s.family === family.name);
            const predicted = spotsOfIt.filter((s) => s.role === PREDICTED);
            return (
              <div key={family.name}>
                <h3>
                  {family.name}: {predicted.length > 0 ? "variants chosen for the laboratory" : "seeds"}
                </h3>
                <ul class="units">
                  {(predicted.length > 0 ? predicted : spotsOfIt).map((s) => (
                    <li key={s.design}>
                      <UnitButton
                        design={s.design}
                        values={[figure(s.x), figure(s.y)]}
                        choose={() => choose(s)}
                      />
                    </li>
                  ))}
                </ul>
              </div>
            );
          })}
        </DesignPanel>
      </div>
      {families.stage.length > 0 && (
        <section class="panel">
          <DesignTable families={families.stage} open={open} />
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
      <Grouping families={families} run={run} refresh={reading.read} colour={familyVariable} />
    </>
  );
}
