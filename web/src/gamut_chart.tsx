// The gamuts of the rounds, their fronts, proposed and measured designs.

import type { ComponentChildren } from "preact";
import { useMemo } from "preact/hooks";
import type { Rounds } from "./api";
import type { Chart, Option } from "./chart";
import { roundColour, themeColour } from "./colour";
import type { Chosen } from "./chosen";
import { keyAt, staircase, type Gamut } from "./gamut";
import { GPA, MPA } from "./numbers";
import { cloudSeries, PointChart, type Spot } from "./point_chart";
import { newestModel } from "./rounds";
import type { Listed } from "./shortlist";

export interface Layers {
  cloud: boolean;
  fronts: boolean;
  proposals: boolean;
  measured: boolean;
  mixtures: boolean;
}

/** The few points that are drawn above the clouds: measured designs and proposals. */
function marks(rounds: Rounds, layers: Layers, shown: Set<number>): Spot[] {
  const newest = newestModel(rounds);
  const proposals = layers.proposals
    ? rounds.rounds
        .filter((r) => shown.has(r.round))
        .flatMap((r) =>
          r.proposals.map((p) => ({
            x: p.modulus_pa * GPA,
            y: p.toughness_pa * MPA,
            design: p.design,
            of: `proposed in round ${r.round}`,
            model: r.round,
          })),
        )
    : [];
  const measured = layers.measured
    ? rounds.measured.map((m) => ({
        x: m.modulus_pa * GPA,
        y: m.toughness_pa * MPA,
        design: m.design,
        of: `measured in round ${m.round}`,
        model: newest,
      }))
    : [];
  return [...measured, ...proposals];
}

const line = (name: string, data: unknown[], colour: string, more: Option = {}): Option => ({
  type: "line",
  name,
  data,
  symbol: "none",
  silent: true,
  connectNulls: false,
  lineStyle: { color: colour, width: 1.8, cap: "square", ...(more.lineStyle as Option) },
  z: 4,
});

function seriesOf(rounds: Rounds, gamuts: Gamut[], layers: Layers): Option[] {
  const newest = Math.max(0, ...rounds.rounds.map((r) => r.round));
  const series: Option[] = [];
  if (layers.cloud)
    for (const gamut of gamuts)
      series.push(cloudSeries(`gamut ${gamut.round}`, gamut, roundColour("sim", gamut.round, newest)));
  const units = (points: [number, number][]) => points.map(([e, t]) => [e * GPA, t * MPA] as [number, number]);
  const byRound = rounds.rounds.filter((r) => gamuts.some((g) => g.round === r.round));
  if (layers.mixtures) {
    const benchmark = [...rounds.rounds].reverse().find((r) => r.benchmark.length > 0)?.benchmark ?? [];
    if (benchmark.length > 0)
      series.push({
        ...line("mixtures", units(benchmark), themeColour("homo"), { lineStyle: { type: "dashed", width: 1.4 } }),
        symbol: "circle",
        symbolSize: 4,
        itemStyle: { color: themeColour("homo") },
      });
  }
  if (layers.fronts) {
    for (const gamut of gamuts)
      series.push(
        line(
          `front of gamut ${gamut.round}`,
          staircase(gamut.front.map((i) => [gamut.points[2 * i], gamut.points[2 * i + 1]])),
          roundColour("sim", gamut.round, newest),
        ),
      );
    if (layers.measured)
      for (const round of byRound)
        if (round.measured_front.length > 0)
          series.push(
            line(
              `measured front ${round.round}`,
              staircase(units(round.measured_front)),
              roundColour("meas", round.round, newest),
            ),
          );
  }
  if (layers.measured) {
    const error = rounds.measured.flatMap((m) => [
      [
        [(m.modulus_pa - m.modulus_sd_pa) * GPA, m.toughness_pa * MPA],
        [(m.modulus_pa + m.modulus_sd_pa) * GPA, m.toughness_pa * MPA],
      ],
      [
        [m.modulus_pa * GPA, (m.toughness_pa - m.toughness_sd_pa) * MPA],
        [m.modulus_pa * GPA, (m.toughness_pa + m.toughness_sd_pa) * MPA],
      ],
    ]);
    const broken = error.flatMap((ends) => [...ends, [null, null]]);
    series.push({
      type: "line",
      name: "spread",
      data: broken,
      symbol: "none",
      silent: true,
      connectNulls: false,
      lineStyle: { color: themeColour("meas"), width: 1, opacity: 0.55 },
      z: 5,
    });
    series.push({
      type: "scatter",
      name: "measured",
      data: rounds.measured.map((m) => [m.modulus_pa * GPA, m.toughness_pa * MPA]),
      silent: true,
      symbolSize: 9,
      itemStyle: { color: themeColour("meas"), borderColor: themeColour("panel"), borderWidth: 1 },
      z: 6,
    });
  }
  if (layers.proposals) {
    const proposals = byRound.flatMap((r) => r.proposals.map((p) => [p.modulus_pa * GPA, p.toughness_pa * MPA]));
    series.push({
      type: "scatter",
      name: "proposals",
      data: proposals,
      silent: true,
      symbolSize: 11,
      symbol: "circle",
      itemStyle: { color: "transparent", borderColor: themeColour("sim"), borderWidth: 2 },
      z: 7,
    });
  }
  return series;
}

const MOST_PICKED = 2000;

/** Rings around what is picked, the toughest of many. */
function pickedSeries(picked: Listed[]): Option[] {
  if (picked.length === 0) return [];
  return [
    {
      type: "scatter",
      name: "picked",
      data: picked.slice(0, MOST_PICKED).map((d) => [(d.modulus_pa ?? NaN) * GPA, (d.toughness_pa ?? NaN) * MPA]),
      silent: true,
      symbolSize: 8,
      itemStyle: { color: "transparent", borderColor: themeColour("good"), borderWidth: 1.5 },
      z: 8,
    },
  ];
}

export function GamutChart({
  rounds,
  gamuts,
  empty,
  layers,
  chosen,
  choose,
  theme,
  picked,
  over,
}: {
  rounds: Rounds;
  gamuts: Gamut[];
  /** Why there is no point, where there is none. */
  empty: string;
  layers: Layers;
  chosen: Chosen | null;
  choose: (spot: Spot) => void;
  theme: string;
  /** Designs that are marked as picked. */
  picked: Listed[];
  over: (chart: Chart) => ComponentChildren;
}) {
  const shown = useMemo(
    () => new Set(gamuts.map((g) => g.round)),
    [gamuts.map((g) => `${g.round}:${g.patterns.length}`).join()],
  );
  const spots = useMemo(() => marks(rounds, layers, shown), [rounds, layers, shown]);
  const series = useMemo(
    () => [...seriesOf(rounds, gamuts, layers), ...pickedSeries(picked)],
    [rounds, shown, layers, theme, picked],
  );
  return (
    <PointChart
      name="gamut"
      label="Gamut: toughness against Young's modulus"
      empty={empty}
      series={series}
      clouds={layers.cloud ? gamuts.map((g) => ({ gamut: g, of: `gamut of round ${g.round}`, model: g.round })) : []}
      spots={spots}
      chosen={chosen}
      choose={choose}
      over={over}
      table={() => ({
        heading: ["round", "pattern", "modulus_pa", "toughness_pa"],
        rows: gamuts.flatMap((g) =>
          Array.from(g.patterns, (_, i) => [g.round, keyAt(g, i), g.points[2 * i] / GPA, g.points[2 * i + 1] / MPA]),
        ),
      })}
    />
  );
}
