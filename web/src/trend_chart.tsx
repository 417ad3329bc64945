// Figures by round, as lines.

import { useMemo } from "preact/hooks";
import { axis, basis, ChartBox, type Option } from "./chart";
import { themeColour } from "./colour";
import { tick } from "./numbers";

/** A line over rounds: its name on the screen and in the file, its looks, and what is known of each round. */
export interface Trend {
  name: string;
  csv: string;
  colour: string;
  dashed?: boolean;
  symbol?: string;
  points: { round: number; value: number | null | undefined; error?: number | null }[];
  /** The column of the errors in the file; absent: there are none. */
  csvOfError?: string;
}

type Place = [number, number];

/** The ends of the bars of errors. */
const barsOf = (trend: Trend): [Place, Place][] =>
  trend.points.flatMap(({ round, value, error }): [Place, Place][] =>
    value && error ? [[[round, value - error], [round, value + error]]] : [],
  );

function seriesOf(trend: Trend, logarithmic: boolean): Option[] {
  const lineStyle = { color: trend.colour, width: 2, type: trend.dashed ? "dashed" : "solid" };
  const isShown = (value: unknown) => value !== null && value !== undefined && (!logarithmic || (value as number) > 0);
  return [
    {
      type: "line",
      name: trend.name,
      data: trend.points.filter((p) => isShown(p.value)).map((p) => [p.round, p.value]),
      symbol: trend.symbol ?? "circle",
      symbolSize: !trend.symbol || trend.symbol === "circle" ? 7 : 9,
      itemStyle: { color: trend.colour },
      lineStyle,
    },
    ...barsOf(trend).map((data) => ({
      type: "line",
      data,
      symbol: "none",
      silent: true,
      lineStyle: { color: trend.colour, width: 1.2, opacity: 0.7 },
    })),
  ];
}

export function TrendChart({
  title,
  name,
  unit,
  rounds,
  trends,
  hint,
  empty,
  logarithmic = false,
  note = "",
  keys = true,
}: {
  title: string;
  /** What the values mean, as a tooltip. */
  hint: string;
  /** Why there is no value, where there is none. */
  empty: string;
  name: string;
  unit: string;
  /** Those that are complete. */
  rounds: number[];
  trends: Trend[];
  logarithmic?: boolean;
  /** What is missing from a picture that shows something. */
  note?: string;
  /** Whether the lines are named above the picture. */
  keys?: boolean;
}) {
  const option = useMemo<Option>(
    () => ({
      ...basis({ grid: { left: 52, right: 14, top: 12, bottom: 40 } }),
      xAxis: axis("round", { min: 0, max: Math.max(1, ...rounds), minInterval: 1, nameGap: 24 }),
      // Errors of the first rounds are many times those of the last.
      yAxis: axis(unit, {
        ...(logarithmic ? { type: "log", logBase: 10 } : { min: 0 }),
        nameGap: 38,
        axisLabel: {
          color: themeColour("quiet"),
          fontSize: 11,
          formatter: (v: number) => tick(logarithmic ? 100 * v : v),
        },
      }),
      series: trends.flatMap((trend) => seriesOf(trend, logarithmic)),
    }),
    [rounds, trends],
  );
  return (
    <section class="panel trend">
      <h3>
        <span class="term" title={hint}>
          {title}
        </span>
      </h3>
      {keys && (
        <ul class="keys">
          {trends.map((t) => (
            <li key={t.name}>
              <span class={t.dashed ? "line dashed" : "line"} style={{ color: t.colour }} />
              {t.name}
            </li>
          ))}
        </ul>
      )}
      {rounds.length === 0 ? (
        <p class="awaited">No round is complete yet.</p>
      ) : (
        <ChartBox
          name={name}
          label={`${title} by round`}
          empty={empty}
          option={option}
          height={190}
          table={() => ({
            heading: ["round", ...trends.flatMap((t) => (t.csvOfError ? [t.csv, t.csvOfError] : [t.csv]))],
            rows: rounds.map((round) => [
              round,
              ...trends.flatMap((t) => {
                const at = t.points.find((p) => p.round === round);
                return t.csvOfError ? [at?.value, at?.error] : [at?.value];
              }),
            ]),
          })}
        />
      )}
      {note && <p class="quiet">{note}</p>}
    </section>
  );
}
