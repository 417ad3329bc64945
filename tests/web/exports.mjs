// A specimens' sheet and exports of three makers, as a laboratory would drop them on the page.

const TIME_STEP_S = 0.4;
const SPEED_MM_PER_S = 1 / 30;
const GAUGE_MM = 54;
const WIDTH_MM = 52;

/** Time, extension and force of a specimen: straight to its peak, then down to zero. */
function pull({
  modulus_pa, peak_pa, thickness_mm, width_mm = WIDTH_MM, gauge_mm = GAUGE_MM, speed_mm_per_s = SPEED_MM_PER_S,
}) {
  const peakStrain = peak_pa / modulus_pa;
  const step_mm = Math.min(speed_mm_per_s * TIME_STEP_S, (peakStrain * gauge_mm) / 20);
  const rows = [];
  for (let i = 0; ; ++i) {
    const strain = (i * step_mm) / gauge_mm;
    const share = strain <= peakStrain ? strain / peakStrain : 2 - strain / peakStrain;
    rows.push([(i * step_mm) / speed_mm_per_s, i * step_mm, Math.max(0, share) * 1e-6 * peak_pa * width_mm * thickness_mm]);
    if (share < -0.1) return rows;
  }
}

const written = (rows, digits, delimiter, mark = ".") =>
  rows.map((row) => row.map((x, i) => x.toFixed(digits[i]).replace(".", mark)).join(delimiter)).join("\n") + "\n";

/** The export of a specimen by the maker of that number: name and text. */
export function exportOf(specimen, number) {
  const maker = MAKERS[number % MAKERS.length];
  return { name: `${specimen.name}.${maker.extension}`, text: maker.write(pull(specimen)) };
}

const MAKERS = [
  {
    maker: "Instron Bluehill",
    extension: "csv",
    write: (rows) =>
      `"Specimen label : 7"\n\nRaw Data\nTime,Displacement,Force\n(s),(mm),(N)\n${written(rows, [4, 5, 4], ",")}`,
  },
  {
    maker: "MTS",
    extension: "dat",
    write: (rows) =>
      "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A\n\nData Acquisition: Timed\t\t\tTime:\t19.6\tSec\t3/12/2026 10:21:07 AM\n" +
      `Running Time\tAxial Displacement\tAxial Force\nSec\tmm\tN\n${written(rows, [4, 6, 5], "\t")}`,
  },
  {
    maker: "ZwickRoell testXpert",
    extension: "tra",
    write: (rows) =>
      `"Vorkraft"|"1"|"N"\n"Prüfgeschwindigkeit"|"2"|"mm/min"\n"Prüfzeit";"Standardweg";"Standardkraft"\n"s";"mm";"N"\n` +
      written(rows, [3, 6, 5], ";", ","),
  },
];

const DESIGNS = ["577fffe9fffdef", "3ffc9b4ad4d2d9", "rigid", "mix:0.65"];

/** Files with their names and texts: `count` specimens of a few designs, by the makers in turn. The seventh is thin. */
export function laboratoryFiles(count) {
  const specimens = Array.from({ length: count }, (_, i) => ({
    name: `m-${String(i + 1).padStart(2, "0")}`,
    design: DESIGNS[i % DESIGNS.length],
    maker: MAKERS[i % MAKERS.length],
    modulus_pa: (0.8 + 0.01 * (i % 5)) * 1e9,
    peak_pa: 6e6 + 1e4 * i,
    thickness_mm: i === 6 ? 1.5 : 3.2,
  }));
  const heading = "file,specimen,pattern,test,width_mm,thickness_mm,gauge_mm,batch";
  const file = (s) => `${s.name}.${s.maker.extension}`;
  const row = (s) => [file(s), s.name, s.design, "toughness", WIDTH_MM, s.thickness_mm, GAUGE_MM, "a"];
  const files = specimens.map((s) => ({ name: file(s), text: s.maker.write(pull(s)) }));
  return { specimens, sheet: { name: "specimens.csv", text: [heading, ...specimens.map(row)].join("\n") + "\n" }, files };
}
