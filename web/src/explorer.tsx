// Maps of patterns: similar patterns are near, colour is modulus or toughness. A click shows a fracture, a drag goes
// between patterns.

import { useEffect, useMemo, useState } from "preact/hooks";
import { get, problemOf, type Maps, type PatternMap, type Rounds } from "./api";
import { chosenOnMap, type Chosen } from "./chosen";
import { DesignBody } from "./design_panel";
import { MapChart, type Coloured } from "./map_chart";
import { useBetween, type Blend, type Place } from "./map_places";
import { MechanismTable } from "./mechanism_table";
import { percent } from "./numbers";
import { Awaited, MaterialKey, Nowhere, Problem, Unit } from "./parts";
import { AGAIN_MS, useReading } from "./reading";
import { addressOf, type Looking } from "./route";

const LOOK_MS = 400;

interface MapState {
  map: PatternMap | null;
  progress: number | null;
  problem: string;
}

/** A map, requested until it is there. Of another map nothing is known at first. */
function useMap(id: string): MapState {
  const nothing: MapState & { id: string } = { id, map: null, progress: null, problem: "" };
  const [state, setState] = useState(nothing);
  useEffect(() => {
    let dropped = false;
    let timer = 0;
    const look = async () => {
      const next = { ...nothing };
      try {
        const response = await get<{ map?: PatternMap; progress?: number | null }>("/api/map", { id });
        next.map = response.map ?? null;
        next.progress = response.progress ?? null;
      } catch (error) {
        next.problem = problemOf(error);
      }
      if (dropped) return;
      setState(next);
      if (!next.map) timer = window.setTimeout(look, next.problem ? AGAIN_MS : LOOK_MS);
    };
    void look();
    return () => {
      dropped = true;
      clearTimeout(timer);
    };
  }, [id]);
  return state.id === id ? state : nothing;
}

/** Which map, and what its colour shows. */
function Choices({
  maps,
  id,
  pick,
  coloured,
  setColoured,
}: {
  maps: Maps;
  id: string;
  pick: (id: string) => void;
  coloured: Coloured;
  setColoured: (c: Coloured) => void;
}) {
  return (
    <div class="toggles">
      <label>
        map{" "}
        <select value={id} onChange={(e) => pick(e.currentTarget.value)}>
          {maps.families
            .flatMap((f) => f.map_ids)
            .map((each) => (
              <option key={each} value={each}>
                {each.replace("/", ", around ")}
              </option>
            ))}
          {maps.gamuts.map((each) => (
            <option key={each} value={each}>
              best patterns of round {each.split("/")[1]}
            </option>
          ))}
        </select>
      </label>
      <fieldset>
        <legend>colour</legend>
        {(["toughness", "modulus"] as const).map((c) => (
          <label key={c} class="toggle">
            <input type="radio" name="colour" checked={coloured === c} onChange={() => setColoured(c)} />
            <span title={c === "modulus" ? "Young's modulus: how stiff" : "toughness: how tough"}>
              {c === "modulus" ? "E" : "T"}
            </span>
          </label>
        ))}
      </fieldset>
    </div>
  );
}

function MapWait({ progress }: { progress: number | null }) {
  return (
    <div class="waiting tall" role="status">
      <span class="spinner" aria-hidden="true" />
      measuring the distances between patterns {progress !== null && percent(progress, 0)}
    </div>
  );
}

/** Patterns around a place, and what lies between them. */
function BlendCard({ blend, open }: { blend: Blend; open: (design: string) => void }) {
  const { map, corners, weights, between, problem } = blend;
  return (
    <>
      <div class="blend">
        <div class="sources">
          {corners.map((i, k) => (
            <figure key={i}>
              <Unit design={map.pattern[i]} size={54} />
              <figcaption>{percent(weights[k], 0)}</figcaption>
            </figure>
          ))}
        </div>
        <span aria-hidden="true" class="arrow">
          →
        </span>
        {between?.pattern ? (
          <Unit design={between.pattern} size={96} />
        ) : (
          <span class="quiet">{between?.violation ?? (problem ? "?" : "…")}</span>
        )}
        <div>
          {between?.pattern && (
            <button type="button" onClick={() => open(between.pattern!)}>
              Break it
            </button>
          )}
          {between?.pattern && between.violation && (
            <p class="quiet">outside the design space: {between.violation}</p>
          )}
        </div>
      </div>
      <Problem text={problem} />
    </>
  );
}

/** The place on the map `id` that somebody has gone to; on another one there is none yet. */
function usePlaceOn(id: string): [Place | null, (place: Place | null) => void] {
  const [kept, setKept] = useState<{ id: string; place: Place | null }>({ id, place: null });
  return [kept.id === id ? kept.place : null, (place) => setKept({ id, place })];
}

export function Explorer({
  rounds,
  data,
  theme,
  isOver,
  looking,
}: {
  rounds: Rounds;
  data: string | null;
  theme: string;
  isOver: boolean;
  looking: Looking;
}) {
  const known = rounds.rounds.map((r) => `${r.round}:${r.gamut_count}`).join();
  const { value: maps, problem } = useReading<Maps>("/api/maps", {}, known);
  if (!maps) return <Awaited problem={problem} />;
  const ids = [...maps.families.flatMap((f) => f.map_ids), ...maps.gamuts];
  const newest = maps.families[0]?.map_ids[0] ?? maps.gamuts.at(-1);
  const id = looking.at.map ?? newest;
  if (!id)
    return (
      <p class="awaited wait">
        {isOver
          ? "This game has no gamut, and so no map."
          : "There is no gamut yet: the map of its best patterns appears here."}
      </p>
    );
  if (!ids.includes(id)) return <Nowhere why={`This run has no map “${id}”.`} link={addressOf("explorer")} />;
  return (
    <>
      <Problem text={problem} />
      <MapView maps={maps} id={id} looking={looking} data={data} theme={theme} />
    </>
  );
}

function MapView({
  maps,
  id,
  looking: { at, look },
  data,
  theme,
}: {
  maps: Maps;
  id: string;
  looking: Looking;
  data: string | null;
  theme: string;
}) {
  const [coloured, setColoured] = useState<Coloured>("toughness");
  const [place, setPlace] = usePlaceOn(id);
  const { map, progress, problem } = useMap(id);
  const blend = useBetween(map, place);
  const [of, which] = id.split("/");
  const family = of === "gamut" ? null : of;
  const whose: Pick<Chosen, "model" | "map"> = family ? { model: family, map: id } : { model: Number(which) };
  const chosen = useMemo(() => chosenOnMap(at.design, map, whose), [at.design, map, id]);
  // Who has chosen something stays on the map when the gamut of another round comes.
  const goTo = (next: Place | null) => {
    setPlace(next);
    if (at.map !== id) look({ ...at, map: id });
  };
  const open = (design: string) => look({ map: id, design });
  const isBetween = blend !== null && blend.corners.length > 1;
  const mechanisms = maps.families.find((f) => f.name === family)?.mechanisms ?? [];
  return (
    <>
      <div class="split">
        <section class="panel gamut">
          <div class="panel-head">
            <h2>Explorer</h2>
            <Choices maps={maps} id={id} pick={(map) => look({ map })} coloured={coloured} setColoured={setColoured} />
          </div>
          <p class="quiet">
            Similar patterns lie near each other (earth mover's distance, Isomap). Click one to see it break. Drag
            across the map to go between patterns, and break what you find.
          </p>
          <Problem text={problem} />
          {map ? (
            <MapChart
              key={id}
              map={map}
              coloured={coloured}
              place={place}
              setPlace={goTo}
              blend={blend}
              open={open}
              theme={theme}
            />
          ) : (
            !problem && <MapWait progress={progress} />
          )}
          {map && (
            <p class="quiet">
              {map.pattern.length} patterns
              {map.residual_variance !== null &&
                `; the map keeps ${percent(1 - map.residual_variance, 0)} of the variance of their distances`}
            </p>
          )}
        </section>
        <section class="panel design" aria-label="design">
          <div class="panel-head">
            <h2>{isBetween ? "Between patterns" : "Design"}</h2>
            <MaterialKey />
          </div>
          {isBetween && <BlendCard blend={blend} open={open} />}
          {chosen ? (
            <DesignBody key={`${chosen.design}@${chosen.map ?? chosen.model}`} chosen={chosen} data={data} />
          ) : (
            !blend && <p class="quiet">Nothing chosen yet: click a pattern on the map.</p>
          )}
        </section>
      </div>
      {mechanisms.length > 0 && (
        <section class="panel">
          <MechanismTable family={family!} mechanisms={mechanisms} />
        </section>
      )}
    </>
  );
}
