// A design's 20 x 20 pixels from its name (docs/FORMATS.md, "Layouts, keys, designs").

export const SIDE = 20;
const QUARTER = 10;

/** Bit of the free pixel that pixel (row, column) is an image of. */
export function freeIndex(row: number, column: number): number {
  let r = row < QUARTER ? row : SIDE - 1 - row;
  let c = column < QUARTER ? column : SIDE - 1 - column;
  if (r > c) [r, c] = [c, r];
  return r * QUARTER - (r * (r - 1)) / 2 + (c - r);
}

/** Rigid (1) or soft (0), rows from the top; null for a design without pixels (a mixture). */
export function pixelsOf(design: string): Uint8Array | null {
  const pixels = new Uint8Array(SIDE * SIDE);
  if (/^[0-9a-f]{14}$/.test(design)) {
    const bits = BigInt(`0x${design}`);
    for (let row = 0; row < SIDE; ++row)
      for (let column = 0; column < SIDE; ++column)
        pixels[row * SIDE + column] = Number((bits >> BigInt(freeIndex(row, column))) & 1n);
    return pixels;
  }
  if (/^L[0-9a-f]{100}$/.test(design)) {
    for (let i = 0; i < pixels.length; ++i) pixels[i] = (parseInt(design[1 + (i >> 2)], 16) >> (3 - (i & 3))) & 1;
    return pixels;
  }
  return null;
}

/** Rigid pixels as one SVG path in a 20 x 20 view box: runs along rows, so that it stays short. */
export function rigidPath(pixels: Uint8Array): string {
  let path = "";
  for (let row = 0; row < SIDE; ++row)
    for (let column = 0; column < SIDE;) {
      let length = 0;
      while (column + length < SIDE && pixels[row * SIDE + column + length]) ++length;
      if (length > 0) path += `M${column} ${row}h${length}v1h-${length}z`;
      column += Math.max(length, 1);
    }
  return path;
}

export function keyOfBits(bits: bigint): string {
  return bits.toString(16).padStart(14, "0");
}

/** The key of the symmetric pattern whose upper left eighth these pixels have. */
export function keyOfPixels(pixels: Uint8Array): string {
  let bits = 0n;
  for (let row = 0; row < QUARTER; ++row)
    for (let column = row; column < QUARTER; ++column)
      if (pixels[row * SIDE + column]) bits |= 1n << BigInt(freeIndex(row, column));
  return keyOfBits(bits);
}

/** The pattern with a pixel and all its images rigid or soft. */
export function withPixel(key: string, row: number, column: number, isRigid: boolean): string {
  const bit = 1n << BigInt(freeIndex(row, column));
  const bits = BigInt(`0x${key}`);
  return keyOfBits(isRigid ? bits | bit : bits & ~bit);
}

/** Rigid and soft exchanged. */
export const inverted = (key: string) => keyOfBits(BigInt(`0x${key}`) ^ ((1n << 55n) - 1n));
