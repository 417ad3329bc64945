// ECharts in the page: theme, size, and the picture as a file.

import { LineChart, ScatterChart } from "echarts/charts";
import {
  DataZoomInsideComponent,
  GraphicComponent,
  GridComponent,
  LegendPlainComponent,
  MarkAreaComponent,
  MarkLineComponent,
  TitleComponent,
} from "echarts/components";
import * as echarts from "echarts/core";
import { CanvasRenderer, SVGRenderer } from "echarts/renderers";
import { createContext, type ComponentChildren } from "preact";
import { useContext, useLayoutEffect, useRef } from "preact/hooks";
import { scaleColour, themeColour } from "./colour";
import { figure } from "./numbers";
import { save, saveCsv, saveSvg, titleOf } from "./save";

echarts.use([
  LineChart,
  ScatterChart,
  GridComponent,
  DataZoomInsideComponent,
  GraphicComponent,
  LegendPlainComponent,
  MarkLineComponent,
  MarkAreaComponent,
  TitleComponent,
  CanvasRenderer,
  SVGRenderer,
]);

export type Chart = echarts.ECharts;
export type Option = Record<string, unknown>;

/** Changes when the page turns dark or light, so that charts are drawn again. */
export const ThemeContext = createContext<"light" | "dark">("light");

/** An axis in the page's colours. */
export function axis(name: string, more: Option = {}): Option {
  const quiet = themeColour("quiet");
  return {
    type: "value",
    name,
    nameLocation: "middle",
    nameGap: 28,
    nameTextStyle: { color: quiet, fontSize: 12 },
    axisLabel: { color: quiet, fontSize: 11, hideOverlap: true },
    axisLine: { show: true, lineStyle: { color: themeColour("rule") } },
    axisTick: { show: false },
    splitLine: { lineStyle: { color: themeColour("grid") } },
    ...more,
  };
}

/** The options that all charts share. */
export function basis(more: Option = {}): Option {
  return {
    animation: false,
    backgroundColor: "transparent",
    // Apostrophes, since a saved picture holds the names within quotation marks.
    textStyle: { fontFamily: getComputedStyle(document.body).fontFamily.replaceAll('"', "'") },
    grid: { left: 56, right: 16, top: 14, bottom: 46 },
    ...more,
  };
}

/** The meaning of a chart's colours: scaleColour() from `low` to `high`, in `unit`. */
export interface ColourScale {
  name: string;
  low: number;
  high: number;
  unit: string;
}

const RAMP = Array.from({ length: 9 }, (_, i) => scaleColour(i / 8));

interface Props {
  /** Name of its files, without the run's. */
  name: string;
  /** What the chart shows: for screen readers, and the title of its pictures. */
  label: string;
  /** Why there is nothing to see, where there is nothing. */
  empty: string;
  option: Option;
  height: number | string;
  table?: () => { heading: string[]; rows: unknown[][] };
  onReady?: (chart: Chart) => void;
  tools?: ComponentChildren;
  scale?: ColourScale;
  children?: ComponentChildren;
}

/** The font family of a chart. */
const familyOf = (option: Option) => (option.textStyle as { fontFamily: string }).fontFamily;

/** Tells how wide a text is in a font. */
function measureIn(font: string): (text: string) => number {
  const context = document.createElement("canvas").getContext("2d")!;
  context.font = font;
  return (text) => context.measureText(text).width;
}

/** How many rows the names take in a legend `width` wide. */
function rowsOf(names: string[], width: number, key: number, gap: number, font: string): number {
  const widthOf = measureIn(font);
  let rows = 1;
  let used = 0;
  for (const name of names) {
    const needed = key + widthOf(name);
    if (used > 0 && used + needed > width) [rows, used] = [rows + 1, 0];
    used += needed + gap;
  }
  return rows;
}

/** The option with a legend above it, and by how much the picture grows: the page has its keys outside the chart. */
function withLegend(option: Option, width: number): { legended: Option; grown: number } {
  const series = option.series as { name?: string; symbol?: string; data: ArrayLike<unknown> }[];
  const shown = new Map(series.filter((s) => s.name && s.data.length > 0).map((s) => [s.name!, s]));
  const names = [...shown.keys()];
  if (names.length === 0) return { legended: option, grown: 0 };
  const [itemWidth, itemHeight, itemGap, fontSize, row, padding] = [30, 10, 14, 11, 14, 8];
  const grid = option.grid as { left: number; right: number; top: number };
  const textGap = 5;
  const room = width - grid.left - grid.right;
  const grown =
    padding +
    (row + itemGap) * rowsOf(names, room, itemWidth + textGap, itemGap, `${fontSize}px ${familyOf(option)}`) -
    itemGap;
  const legend = {
    // A line without marks would get one of the palette's.
    data: [...shown.values()].map((s) => ({ name: s.name, itemStyle: s.symbol === "none" ? { opacity: 0 } : {} })),
    left: grid.left,
    top: padding,
    width: room,
    padding: 0,
    itemWidth,
    itemHeight,
    itemGap,
    textStyle: { color: themeColour("quiet"), fontSize },
  };
  return { legended: { ...option, legend, grid: { ...grid, top: grid.top + grown } }, grown };
}

/** The option, for a picture so high, with a colour scale in `row` pixels more below it. */
function withScale(option: Option, height: number, row: number, scale: ColourScale): Option {
  const grid = option.grid as { left: number; bottom: number };
  const [gap, fontSize, ramp] = [6, 11, { width: 120, height: 10 }];
  const font = `${fontSize}px ${familyOf(option)}`;
  const before = `${scale.name}  ${figure(scale.low)}`;
  const from = grid.left + measureIn(font)(before) + gap;
  const text = (x: number, words: string) => ({
    type: "text",
    x,
    y: height + (row - fontSize) / 2,
    style: { text: words, font, fill: themeColour("quiet") },
  });
  const colorStops = RAMP.map((color, i) => ({ offset: i / (RAMP.length - 1), color }));
  const graphic = [
    text(grid.left, before),
    {
      type: "rect",
      shape: { x: from, y: height + (row - ramp.height) / 2, ...ramp },
      style: { fill: { type: "linear", x: 0, y: 0, x2: 1, y2: 0, colorStops } },
    },
    text(from + ramp.width + gap, `${figure(scale.high)} ${scale.unit}`),
  ];
  return { ...option, graphic, grid: { ...grid, bottom: grid.bottom + row } };
}

const TITLE_ROW = 26;

/** The option with a title above everything, in TITLE_ROW pixels more. */
function withTitle(option: Option, title: string, width: number): Option {
  const { grid, legend } = option as { grid: { left: number; top: number }; legend?: { top: number } };
  const textStyle = { color: themeColour("ink"), fontSize: 12, width: width - grid.left - 8, overflow: "truncate" };
  return {
    ...option,
    title: { text: title, left: grid.left, top: 8, padding: 0, textStyle },
    ...(legend ? { legend: { ...legend, top: legend.top + TITLE_ROW } } : {}),
    grid: { ...grid, top: grid.top + TITLE_ROW },
  };
}

/** The same picture drawn again with title and keys as SVG, or as PNG at twice the size, in the page's colours. */
function picture(
  chart: Chart,
  option: Option,
  kind: "svg" | "png",
  { name, label, scale }: Pick<Props, "name" | "label" | "scale">,
): void {
  const width = chart.getWidth();
  const { legended: untitled, grown } = withLegend(option, width);
  const legended = withTitle(untitled, titleOf(label), width);
  const drawn = chart.getHeight() + grown + TITLE_ROW;
  const row = scale ? 24 : 0;
  const keyed = scale ? withScale(legended, drawn, row, scale) : legended;
  const height = drawn + row;
  const renderer =
    kind === "svg"
      ? { renderer: "svg" as const, ssr: true, width, height }
      : { renderer: "canvas" as const, devicePixelRatio: 2, width, height };
  const host = kind === "svg" ? null : document.createElement("div");
  const copy = echarts.init(host, null, renderer);
  copy.setOption({ ...keyed, backgroundColor: themeColour("panel") });
  const zoom = (chart.getOption() as { dataZoom?: { startValue: number; endValue: number }[] }).dataZoom;
  zoom?.forEach((each, dataZoomIndex) =>
    copy.dispatchAction({ type: "dataZoom", dataZoomIndex, startValue: each.startValue, endValue: each.endValue }),
  );
  if (kind === "svg") saveSvg(name, copy.renderToSVGString(), label);
  else {
    const canvas = copy.renderToCanvas({
      backgroundColor: themeColour("panel"),
      pixelRatio: 2,
    } as never) as HTMLCanvasElement;
    canvas.toBlob((blob) => blob && save(`${name}.png`, blob), "image/png");
  }
  copy.dispose();
}

/** Whether any series has a point. */
const hasPoints = (option: Option) =>
  (option.series as { data?: ArrayLike<unknown> }[]).some((series) => (series.data?.length ?? 0) > 0);

export function ChartBox({ name, label, empty, option, height, table, onReady, tools, scale, children }: Props) {
  const host = useRef<HTMLDivElement>(null);
  const chart = useRef<Chart | undefined>(undefined);
  const theme = useContext(ThemeContext);
  // In the layout effect, so that a key or a pointer that comes with the first frame finds the chart.
  useLayoutEffect(() => {
    const made = echarts.init(host.current!, null, { renderer: "canvas" });
    chart.current = made;
    const observer = new ResizeObserver(() => made.resize());
    observer.observe(host.current!);
    return () => {
      observer.disconnect();
      made.dispose();
    };
  }, []);
  useLayoutEffect(() => {
    chart.current!.setOption(option, { replaceMerge: ["series"] });
    onReady?.(chart.current!);
  }, [option, theme]);
  return (
    <figure class="chart">
      <div class="canvas" style={{ height: typeof height === "number" ? `${height}px` : height }}>
        <div ref={host} class="host" role="img" aria-label={label} />
        {!hasPoints(option) && <p class="awaited nothing">{empty}</p>}
        {children}
      </div>
      <figcaption class="tools">
        {tools}
        {scale && (
          <span class="scale">
            <span>
              {scale.name} {figure(scale.low)}
            </span>
            <span class="ramp" style={{ background: `linear-gradient(to right, ${RAMP.join(", ")})` }} />
            <span>
              {figure(scale.high)} {scale.unit}
            </span>
          </span>
        )}
        <span class="spring" />
        <button
          type="button"
          class="quiet"
          onClick={() => picture(chart.current!, option, "svg", { name, label, scale })}
          aria-label={`${name} as SVG`}
        >
          SVG
        </button>
        <button
          type="button"
          class="quiet"
          onClick={() => picture(chart.current!, option, "png", { name, label, scale })}
          aria-label={`${name} as PNG`}
        >
          PNG
        </button>
        {table && (
          <button
            type="button"
            class="quiet"
            aria-label={`${name} as CSV`}
            onClick={() => {
              const { heading, rows } = table();
              saveCsv(name, heading, rows);
            }}
          >
            CSV
          </button>
        )}
      </figcaption>
    </figure>
  );
}
