// Colours of materials, films and maps, computed as lib/animation/colour.cpp does.

type Three = [number, number, number];

function linearOf([L, a, b]: Three): Three {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

function labOf([r, g, b]: Three): Three {
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

const encoded = (v: number) => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
const decoded = (v: number) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
const clamp = (v: number, low = 0, high = 1) => Math.min(high, Math.max(low, v));

function rgbOfLch(lightness: number, chroma: number, hueDegrees: number): Three {
  const hue = (hueDegrees * Math.PI) / 180;
  for (let c = chroma; ; c -= 0.002) {
    const linear = linearOf([lightness, Math.max(c, 0) * Math.cos(hue), Math.max(c, 0) * Math.sin(hue)]);
    if (c <= 0 || linear.every((v) => v >= -1e-4 && v <= 1 + 1e-4))
      return linear.map((v) => encoded(clamp(v))) as Three;
  }
}

const hexOf = (rgb: Three) =>
  `#${rgb
    .map((v) =>
      Math.round(255 * v)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
const linear = (rgb: Three) => rgb.map(decoded) as Three;

function blend(a: Three, b: Three, share: number): Three {
  const [from, to] = [labOf(linear(a)), labOf(linear(b))];
  return linearOf(from.map((v, i) => v + share * (to[i] - v)) as Three).map((v) => encoded(clamp(v))) as Three;
}

const glow = (share: number) => {
  const t = clamp(share);
  return rgbOfLch(0.3 + 0.66 * t, 0.2 - 0.06 * t * t, -62 + 168 * t);
};

/** The colours of the materials, everywhere and in both themes: those of lib/pattern/phase_colours.hpp. */
export const MATERIAL = {
  soft: "#22262c",
  rigid: "#8d97a6",
  interface: "#525a66",
};

const rgbOf = (hex: string) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255) as Three;

/** Colour of an element: 0xAABBGGRR, as ImageData holds it, by material (soft, rigid, interface) and energy level. */
export function elementColours(levels: number): Uint32Array[] {
  const [begin, full, top] = [0.32, 0.62, 0.92];
  return [MATERIAL.soft, MATERIAL.rigid, MATERIAL.interface].map(rgbOf).map((material) =>
    Uint32Array.from({ length: levels }, (_, level) => {
      const share = level / (levels - 1);
      const rise = clamp((share - begin) / (full - begin));
      const [r, g, b] = blend(material, glow((share - begin) / (top - begin)), rise * rise * (3 - 2 * rise)).map((v) =>
        Math.round(255 * v),
      );
      return (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
    }),
  );
}

export const BREAKING = "#0a9fd6"; // what broke since the frame before
export const BREAKING_POINT = 0xffd69f0a; // the same, as ImageData holds it

/** A scale from dark blue over green to yellow, of even lightness steps. */
export function scaleColour(share: number): string {
  const t = clamp(share);
  return hexOf(rgbOfLch(0.32 + 0.58 * t, 0.13 + 0.03 * Math.sin(Math.PI * t), 280 - 190 * t));
}

/** The value of a custom property of the page, for charts. */
export function themeColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Colour of a round's simulated or measured points: earlier rounds are paler. */
export function roundColour(kind: "sim" | "meas", round: number, newest: number): string {
  const age = newest > 0 ? (newest - round) / newest : 0;
  return hexOf(blend(rgbOf(themeColour(kind)), rgbOf(themeColour("panel")), 0.62 * age));
}
