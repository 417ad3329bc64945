// The curve of one specimen among those of its replicates: looked at before it is judged.

import { useMemo } from "preact/hooks";
import type { Design, LaboratorySpecimen } from "./api";
import { axis, basis, ChartBox, type Option } from "./chart";
import { themeColour } from "./colour";
import { MPA } from "./numbers";
import { Awaited } from "./parts";
import { useReading } from "./reading";

type Tested = Design["specimens"][number];
type Conditions = Pick<Tested, "test" | "orientation_deg" | "strain_rate_per_s" | "thickness_mm" | "standard">;

/** Whether two specimens are tested alike: at the usual rate and thickness both, or at the same. */
function areAlike(a: Conditions, b: Conditions): boolean {
  const isSame = a.strain_rate_per_s === b.strain_rate_per_s && a.thickness_mm === b.thickness_mm;
  return a.test === b.test && a.orientation_deg === b.orientation_deg && ((a.standard && b.standard) || isSame);
}

const pointsOf = ({ strain, stress_pa }: NonNullable<Tested["curve"]>) =>
  strain.map((s, i) => [100 * s, stress_pa[i] * MPA]);

function seriesOf(replicates: Tested[], specimen: string): Option[] {
  const [quiet, meas] = [themeColour("quiet"), themeColour("meas")];
  return replicates.map((each) => {
    const isMeant = each.specimen === specimen;
    const style = { color: isMeant ? meas : quiet, width: isMeant ? 2.4 : 1.1, opacity: isMeant ? 1 : 0.65 };
    return {
      type: "line",
      name: each.specimen,
      data: pointsOf(each.curve!),
      symbol: "none",
      silent: true,
      z: isMeant ? 5 : 3,
      lineStyle: { ...style, type: each.valid ? "solid" : "dotted" },
    };
  });
}

export function ReplicateCurves({ of, version }: { of: LaboratorySpecimen; version: unknown }) {
  const { value, problem } = useReading<Design>("/api/design", { design: of.design }, version);
  const replicates = useMemo(
    () => (value?.specimens ?? []).filter((each) => each.curve && areAlike(each, of)),
    [value, of.specimen],
  );
  const theme = document.documentElement.dataset.theme;
  const option = useMemo<Option>(
    () => ({
      ...basis({ grid: { left: 48, right: 12, top: 10, bottom: 40 } }),
      xAxis: axis("strain / %", { nameGap: 24 }),
      yAxis: axis("stress / MPa", { nameGap: 34 }),
      series: seriesOf(replicates, of.specimen),
    }),
    [replicates, of.specimen, theme],
  );
  if (!value) return <Awaited problem={problem} what="reading the curves …" />;
  if (!replicates.some((each) => each.specimen === of.specimen))
    return <p class="awaited">There is no curve of {of.specimen}: only its value was entered.</p>;
  const others = replicates.length - 1;
  return (
    <ChartBox
      name={`replicates-of-${of.specimen}`}
      label={`Curve of ${of.specimen} among its ${others} replicates`}
      empty=""
      option={option}
      height={220}
      table={() => ({
        heading: ["specimen", "strain", "stress_pa"],
        rows: replicates.flatMap((each) =>
          each.curve!.strain.map((strain, i) => [each.specimen, strain, each.curve!.stress_pa[i]]),
        ),
      })}
      tools={
        <ul class="keys">
          <li>
            <span class="line" style={{ color: "var(--meas)" }} />
            {of.specimen}
          </li>
          <li>
            <span class="line" style={{ color: "var(--quiet)" }} />
            {others === 0 ? "no replicate has a curve" : `${others} ${others === 1 ? "replicate" : "replicates"}`}{" "}
            (dotted: not valid)
          </li>
        </ul>
      }
    />
  );
}
